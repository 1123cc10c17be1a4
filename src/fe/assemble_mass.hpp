#pragma once

#include <vector>

#include "fe/assembly_terms.hpp"

namespace twindeck::fe {

/// Mass of beams by group, shells by section (translations ~ rho t, rotations ~ rho t³), bars and stays, point masses.
[[nodiscard]] std::vector<TermPlan> plan_mass(const Model& model);

}  // namespace twindeck::fe
