#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/model.hpp"

/// The parts of `validate`, in the order of their calls. Each part may rely on the checks before it.
namespace twindeck::fe {

/// @param part  what of the model is wrong ("section 'girder'") @throws InputError  always
[[noreturn]] inline void refuse(const Model& model, const std::string& part, const std::string& problem,
                                const std::string& mend) {
  throw InputError({model.source, 0, part}, problem, mend);
}

/// Every reference from elements, springs, links, constraints, masses, supports and prestress conditions exists; node ids are
/// unique.
void validate_references(const Model& model);
/// Beams and bars have length, shells have area, all nodes are connected.
void validate_geometry(const Model& model);

/// Moduli, densities and sections of all used elements.
void validate_properties(const Model& model);

/// What a parameter of this target may name, each once and in order: materials, sections, groups of springs or of point masses.
/// @param target  of a model of elements, none of a matrix
[[nodiscard]] std::vector<std::string> names_of_target(const Model& model, Target target);
/// "material", "section", "group of springs" or "group of point masses". @param target  as above
[[nodiscard]] const char* kind_of(Target target);
/// Units in which a parameter's values may be given, the usual one first: SI, or none ("-") for a factor.
[[nodiscard]] std::vector<std::string> units_of(Target target);
/// Parameters refer to existing names; their initial values equal the model's and lie inside the bounds.
void validate_parameters(const Model& model);

}  // namespace twindeck::fe
