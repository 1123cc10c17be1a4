#pragma once

#include "fe/model.hpp"

namespace twindeck::fe {

/// Parameters refer to existing names; their initial values equal the model's and lie inside the bounds.
void validate_parameters(const Model& model);

}  // namespace twindeck::fe
