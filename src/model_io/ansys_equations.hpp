#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: constraint equations (CE), collected and made into rigid links.
namespace twindeck::model_io::ansys {

/// Collects a CE.
void read_equation(Parts& parts, const Command& command);
/// Makes links of what was collected. @throws InputError for equations that together are no rigid link
void add_equations(Builder& builder);

}  // namespace twindeck::model_io::ansys
