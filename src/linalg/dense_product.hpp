#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// A' B and A B by the BLAS that serves CHOLMOD, on one thread: for products of tall matrices, where its kernels are made for the
/// machine and Eigen's for every machine of its kind.
/// @param a (n × k), b (n × m) @return (k × m)
[[nodiscard]] Eigen::MatrixXd transposed_times(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                               const Eigen::Ref<const Eigen::MatrixXd>& b);
/// @param a (n × k), b (k × m) @return (n × m)
[[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);
/// c -= A B.
void subtract_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      Eigen::MatrixXd& c);

}  // namespace twindeck::linalg
