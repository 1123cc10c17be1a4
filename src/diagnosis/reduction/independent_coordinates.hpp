#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::diagnosis {

/// Positions of independent coordinates, which span all of them. Coordinates are dependent if locations coincide or if the
/// model has few degrees of freedom. If a support is taken away, a motion may have neither stiffness nor mass. Both matrices
/// are then singular, and their modes would be rounding.
/// @param stiffness,mass  of a state (n × n)
/// @param first           coordinates 0 … first-1 stay in any case
/// @return ascending. All coordinates if the energy is negative in some direction: such a state is unstable anyway.
[[nodiscard]] std::vector<Eigen::Index> independent_coordinates(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                                                Eigen::Index first);

}  // namespace twindeck::diagnosis
