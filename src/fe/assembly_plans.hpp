#pragma once

#include <Eigen/Core>
#include <vector>

#include "fe/assembly_terms.hpp"

namespace twindeck::fe {

/// Elastic stiffness without stays: beams by group and material (the axial part apart where an area is a parameter), bars,
/// shells by section and material (membrane with drilling ~ E t, bending ~ E t³ RMI), springs by group.
[[nodiscard]] std::vector<TermPlan> plan_stiffness(const Model& model);
/// Axial stiffness of stays, one term each: Dischinger's modulus at the cable force, or the full modulus without a force.
[[nodiscard]] std::vector<TermPlan> plan_stays(const Model& model, const Eigen::VectorXd& stay_pull_N);

/// Mass of beams by group, shells by section (translations ~ rho t, rotations ~ rho t³), bars and stays, point masses.
[[nodiscard]] std::vector<TermPlan> plan_mass(const Model& model);

}  // namespace twindeck::fe
