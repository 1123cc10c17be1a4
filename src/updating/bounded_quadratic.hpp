#pragma once

#include <Eigen/Core>

#include "updating/optimality.hpp"

namespace twindeck::updating {

/// Step s that minimises the linearised problem 1/2 ‖r + J s‖² + 1/2 ridge ‖s‖² with x + s inside the box: the Gauss-Newton
/// step within the bounds. Primal active-set method. It is exact up to rounding and ends in finitely many steps, because the
/// ridge makes the problem strictly convex. It suits tens of parameters, not thousands.
/// @param residual (n_residuals) r at x @param jacobian (n_residuals × n) J at x
/// @param x (n) inside the box @param ridge  above 0, in units of J'J
/// @return (n)
/// Reference: Stark and Parker (1995), Computational Statistics 10, 129-141; Nocedal and Wright (2006), section 16.5.
[[nodiscard]] Eigen::VectorXd bounded_gauss_newton_step(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                                                        const Eigen::VectorXd& x, const Box& box, double ridge);

}  // namespace twindeck::updating
