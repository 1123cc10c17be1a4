#pragma once

#include "fe/model.hpp"

namespace twindeck::fe {

/// Moduli, densities and sections of all used elements.
void validate_properties(const Model& model);

}  // namespace twindeck::fe
