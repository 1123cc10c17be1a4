#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/eigenmodes.hpp"

namespace twindeck::sensitivity {

/// Derivatives of the mass-normalised shapes at `channels`, c' dphi_i of the solution of Nelson's equations
///   (K - lambda_i M) dphi_i = -(dK - lambda_i dM - dlambda_i M) phi_i,   phi_i' M dphi_i = -1/2 phi_i' dM phi_i.
/// Inside a cluster of equal eigenvalues the shapes are free to rotate. Of that part only what the normalisation fixes is
/// returned: the derivative of the subspace. The adjoint vectors y solve (K - lambda_i M) y = c outside the modes. Then c' dphi
/// = y' f for the force f = -(dK - lambda_i dM) phi_i of any parameter, so the cost hardly depends on the number of parameters.
/// Since c is the same for all modes, one block Krylov space of K⁻¹ M serves all of them: (K - lambda M)⁻¹ c = (1 - lambda K⁻¹
/// M)⁻¹ K⁻¹ c lies in this space for every lambda. The error of the adjoint vectors is 1e-7 in the M norm.
/// @param modes     the lowest modes of `system` at `theta`, none left out
/// @param channels  (n × n_channels), a unit vector where a channel measures one degree of freedom
/// @return (n_parameters) matrices (n_channels × n_modes) per unit of parameter
/// References: Nelson (1976), AIAA Journal 14, 1201-1205; Murthy and Haftka (1988), Int. J. Num. Meth. Eng. 26, 293-311
/// (adjoint form); Frommer and Glässner (1998), SIAM J. Sci. Comput. 19, 15-26 (one Krylov space for many shifts).
[[nodiscard]] std::vector<Eigen::MatrixXd> channel_shape_derivatives(const fe::ParametricSystem& system,
                                                                     const Eigen::VectorXd& theta,
                                                                     const dynamics::EigenModes& modes,
                                                                     const Eigen::Ref<const Eigen::MatrixXd>& channels,
                                                                     double cluster_gap = 1e-8);

}  // namespace twindeck::sensitivity
