#include "fe/element_products.hpp"

#include <Eigen/Dense>

namespace twindeck::fe {

namespace {

using Eigen::MatrixXd;
using AnySize = Eigen::Ref<const MatrixXd>;

MatrixXd congruence_of_any_size(const AnySize& t, const AnySize& k, double scale) {
  const MatrixXd turned = scale * (t.transpose() * k * t);
  return 0.5 * (turned + turned.transpose());
}

MatrixXd product(const AnySize& a, const AnySize& b) { return a * b; }

/// The small product with D has its sizes at compile time, the large one with B has not.
template <int strains, int displacements>
auto form(double weight, const Eigen::Matrix<double, strains, displacements>& b,
          const Eigen::Matrix<double, strains, strains>& d) {
  const Eigen::Matrix<double, displacements, strains> stress = weight * b.transpose() * d;
  return product(stress, b);
}

}  // namespace

Matrix12 congruence(const Matrix12& t, const Matrix12& k) { return congruence_of_any_size(t, k, 1.0); }
Matrix18 congruence(const Matrix18& t, const Matrix18& k) { return congruence_of_any_size(t, k, 1.0); }
Matrix24 congruence(const Matrix24& t, const Matrix24& k, double scale) { return congruence_of_any_size(t, k, scale); }

Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 2, 12>& b) { return weight * transposed_product(b, b); }
Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 2, 12>& b, const Eigen::Matrix2d& d) {
  return form(weight, b, d);
}
Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 3, 12>& b, const Eigen::Matrix3d& d) {
  return form(weight, b, d);
}
triangle::Matrix9 quadratic_form(double weight, const Eigen::Matrix<double, 3, 9>& b, const Eigen::Matrix3d& d) {
  return form(weight, b, d);
}

Matrix12 inverse_form(const Eigen::Matrix4d& a, const Eigen::Matrix<double, 4, 12>& b) {
  const Eigen::Matrix<double, 4, 12> solved = a.ldlt().solve(b);
  return transposed_product(b, solved);
}

MatrixXd transposed_product(const AnySize& a, const AnySize& b) { return a.transpose() * b; }

}  // namespace twindeck::fe
