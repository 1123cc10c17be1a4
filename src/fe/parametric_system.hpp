#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fe/coefficient.hpp"
#include "fe/model.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::fe {

/// A free degree of freedom of the assembled system, for output and messages.
struct DofLabel {
  std::string node;   ///< node id as text
  int direction = 0;  ///< 0-5 = x y z rx ry rz
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero();
};

/// One term a_g K_g: entries of K_g's lower triangle by position in the common pattern.
struct Term {
  std::string label;  ///< "slab_foot_B membrane", for messages and reports
  Coefficient coefficient;
  std::vector<int> position;  ///< into valuePtr() of the pattern
  std::vector<double> value;
};

/// A structure whose matrices depend on parameters,  K = sum a_g(theta) K_g,  M = sum b_g(theta) M_g, on one sparsity pattern
/// over the free degrees of freedom. FE models and matrix models are both converted to this struct; the layers above treat them
/// alike.
class ParametricSystem {
 public:
  std::vector<Parameter> parameters;
  std::vector<DofLabel> dofs;    ///< (n)
  linalg::SparseMatrix pattern;  ///< lower triangle (n × n), explicit zeros
  std::vector<Term> stiffness_terms, mass_terms;

  [[nodiscard]] Eigen::Index size() const { return pattern.rows(); }
  [[nodiscard]] Eigen::VectorXd initial() const;
  /// Lower triangle of K(theta), M(theta).
  [[nodiscard]] linalg::SparseMatrix stiffness(const Eigen::VectorXd& theta) const;
  [[nodiscard]] linalg::SparseMatrix mass(const Eigen::VectorXd& theta) const;
  /// (dK/dtheta_p) X and (dM/dtheta_p) X.  @param x (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd stiffness_derivative_times(const Eigen::VectorXd& theta, int parameter,
                                                           const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  [[nodiscard]] Eigen::MatrixXd mass_derivative_times(const Eigen::VectorXd& theta, int parameter,
                                                      const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  /// Full displacements (6 × n_nodes columns-major: x y z rx ry rz of node 0, …) of vectors over the free dofs; a matrix model
  /// returns x itself. @param x (n × m)
  [[nodiscard]] Eigen::MatrixXd expand(const Eigen::Ref<const Eigen::MatrixXd>& x) const;

  linalg::SparseMatrix expansion;  ///< (6 n_nodes × n): supports and links; empty for a matrix model
};

}  // namespace twindeck::fe
