#pragma once

#include <string>

#include "core/error.hpp"
#include "fe/model.hpp"

/// The parts of `validate`, in the order in which they are called: each may rely on what those before it have checked.
namespace twindeck::fe {

/// @param part  what of the model is wrong ("section 'girder'") @throws InputError  always
[[noreturn]] inline void refuse(const Model& model, const std::string& part, const std::string& problem, const std::string& mend) {
  throw InputError({model.source, 0, part}, problem, mend);
}

/// Every reference from elements, springs, links, masses, supports and prestress conditions leads somewhere; node ids are
/// unique.
void validate_references(const Model& model);
/// Moduli, densities and sections of what is used.
void validate_properties(const Model& model);
/// Beams and bars have length, shells have area, nodes are reached.
void validate_geometry(const Model& model);
/// Parameters name what exists, start where the model stands, inside their bounds.
void validate_parameters(const Model& model);

}  // namespace twindeck::fe
