#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::diagnosis {

/// Positions of coordinates that span the others too. Locations bring the same motion twice where they coincide, and in a model
/// of few degrees of freedom. A support that is taken away leaves motion that nothing holds and that has no mass. With such
/// coordinates both matrices are singular, and which modes they have is rounding.
/// @param stiffness,mass  of a state (n × n)
/// @param first           coordinates 0 … first-1 stay in any case
/// @return ascending. All of them where the energy is negative in some direction: such a state does not stand, whatever is
///         left out.
[[nodiscard]] std::vector<Eigen::Index> independent_coordinates(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                                                Eigen::Index first);

}  // namespace twindeck::diagnosis
