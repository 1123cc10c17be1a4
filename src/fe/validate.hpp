#pragma once

#include "fe/model.hpp"

namespace twindeck::fe {

/// Checks sizes and cross references of a model: every beam has length, every name exists, moduli are positive, every node is
/// connected.
/// @throws InputError that names the source, the part, what was expected and how to mend it
void validate(const Model& model);

}  // namespace twindeck::fe
