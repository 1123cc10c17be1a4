#pragma once

#include <Eigen/Core>

namespace twindeck::transient {

/// Finds the forces of friction units that are coupled by a flexibility: x = x_free - G F and F = clip(k (x - x_p), ±F_c).
/// Newton's method on the set of stuck units. If its sets come in a circle (springs stiff beside the flexibility, k G > 1), the
/// strictly convex problem of the same forces is solved by active sets, which ends in finitely many steps.
/// @param force  in: a guess; out: the forces @return false if no balance was found
[[nodiscard]] bool balance_friction(const Eigen::Ref<const Eigen::VectorXd>& free_m,
                                    const Eigen::Ref<const Eigen::MatrixXd>& flexibility,
                                    const Eigen::Ref<const Eigen::VectorXd>& stiffness_N_m,
                                    const Eigen::Ref<const Eigen::VectorXd>& threshold_N,
                                    const Eigen::Ref<const Eigen::VectorXd>& plastic_m, Eigen::VectorXd& force_N);

}  // namespace twindeck::transient
