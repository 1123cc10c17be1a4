#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <memory>
#include <vector>

#include "diagnosis/reduction/reduced_basis.hpp"

namespace twindeck::diagnosis {

/// Unit forces of a location in reduced coordinates, V' b. The values for the common vectors and for the location's own are
/// kept; those for vectors of other locations are computed where a fit combines causes at both.
class ReducedDirections {
 public:
  ReducedDirections() = default;
  /// @param b        (n × k)
  /// @param for_all  every state uses them: the values for all vectors are kept
  ReducedDirections(Eigen::SparseMatrix<double> b, std::shared_ptr<const ReducedBasis> basis, bool for_all);

  [[nodiscard]] Eigen::Index cols() const { return b_.cols(); }                           ///< k
  [[nodiscard]] bool is_zero(Eigen::Index d) const { return b_.col(d).nonZeros() == 0; }  ///< the location cannot move so
  /// Direction `d` in some coordinates, the common ones first (n_columns).
  [[nodiscard]] Eigen::VectorXd part(Eigen::Index d, const std::vector<int>& columns) const;
  /// Keeps the values for the location's own vectors. @param group  of the basis
  void keep(int group);
  /// Keeps the values for vectors that the basis has got since, where `for_all`.
  void follow_basis();

 private:
  [[nodiscard]] Eigen::MatrixXd at(int group) const { return basis_->vectors(group)->transpose() * b_; }

  Eigen::SparseMatrix<double> b_;
  std::shared_ptr<const ReducedBasis> basis_;
  Eigen::MatrixXd common_;  ///< (c × k)
  bool for_all_ = false;
  int first_ = 0;                      ///< group of the first of `kept_`
  std::vector<Eigen::MatrixXd> kept_;  ///< (count × k) of one group after the other
};

}  // namespace twindeck::diagnosis
