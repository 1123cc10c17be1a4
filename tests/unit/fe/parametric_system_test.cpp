// Oracles: sums of two small matrices by hand, the product rule, Ernst's modulus by hand, central differences.
#include "fe/parametric_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::fe {
namespace {

/// Lower triangle of [[2, -1], [-1, 3]] by theta_0/10 and of [[0, 5], [5, 0]] by (theta_1/2)³, the positions out of order.
ParametricSystem two_terms() {
  ParametricSystem system;
  system.parameters.resize(2);
  system.parameters[0].initial = 10.0;
  system.parameters[1].initial = 2.0;
  system.pattern = Eigen::MatrixXd(Eigen::Matrix2d::Ones().triangularView<Eigen::Lower>()).sparseView();  // (0,0) (1,0) (1,1)
  Term linear, cubed;
  linear.coefficient.factors = {{0, 1.0, 10.0}};
  linear.position = {2, 0, 1};
  linear.value = {3.0, 2.0, -1.0};
  cubed.coefficient.factors = {{1, 3.0, 2.0}};
  cubed.position = {1};
  cubed.value = {5.0};
  system.stiffness_terms = {linear, cubed};
  system.mass_terms = {cubed};
  return system;
}

// Oracle: at theta = (20, 4): 2 [[2, -1], [-1, 3]] + 8 [[0, 5], [5, 0]].
TEST(ParametricSystem, SumsItsTerms) {
  const ParametricSystem system = two_terms();
  EXPECT_EQ(system.size(), 2);
  EXPECT_EQ(Eigen::Vector2d(system.initial()), Eigen::Vector2d(10.0, 2.0));
  Eigen::Matrix2d expected;
  expected << 4.0, 0.0, 38.0, 6.0;
  EXPECT_LT((Eigen::Matrix2d(system.stiffness(Eigen::Vector2d(20.0, 4.0))) - expected).norm(), 1e-13);
  expected << 0.0, 0.0, 40.0, 0.0;
  EXPECT_LT((Eigen::Matrix2d(system.mass(Eigen::Vector2d(20.0, 4.0))) - expected).norm(), 1e-13);
}

// Oracle: d/dtheta_0 = 1/10 [[2, -1], [-1, 3]]; d/dtheta_1 = 3/2 (theta_1/2)² [[0, 5], [5, 0]], both whole matrices.
TEST(ParametricSystem, DerivativesAreThoseOfTheWholeMatrix) {
  const ParametricSystem system = two_terms();
  const Eigen::Vector2d theta(20.0, 4.0);
  Eigen::MatrixXd x(2, 3), linear(2, 2), cubed(2, 2);
  x << 1.0, 0.0, 2.0, 0.0, 1.0, -3.0;
  linear << 0.2, -0.1, -0.1, 0.3;
  cubed << 0.0, 30.0, 30.0, 0.0;
  EXPECT_LT((system.stiffness_derivative_times(theta, 0, x) - linear * x).norm(), 1e-13);
  EXPECT_LT((system.stiffness_derivative_times(theta, 1, x) - cubed * x).norm(), 1e-12);
  EXPECT_LT((system.mass_derivative_times(theta, 1, x) - cubed * x).norm(), 1e-12);
  EXPECT_EQ(system.mass_derivative_times(theta, 0, x).norm(), 0.0);
  EXPECT_THROW((void)system.mass_derivative_times(theta, 0, Eigen::MatrixXd::Zero(3, 1)), InternalError);
}

// Oracle: a spring between two of many unknowns and the dense product, beside a term of every unknown: both ways to multiply.
TEST(ParametricSystem, SmallAndLargeTermsMultiplyAlike) {
  const int n = 60;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n), spring = chain;
  for (int i = 0; i < n; ++i) chain(i, i) = 2.0 + i;
  for (int i = 1; i < n; ++i) chain(i, i - 1) = -1.0 - 0.1 * i;
  spring(40, 40) = spring(41, 41) = 7.0, spring(41, 40) = -7.0;
  ParametricSystem system;
  system.parameters.resize(2);
  system.pattern = chain.sparseView();
  Term all, few;
  all.coefficient.factors = {{0, 1.0, 1.0}};
  few.coefficient.factors = {{1, 1.0, 1.0}};
  int position = 0;
  for (int column = 0; column < n; ++column)
    for (linalg::SparseMatrix::InnerIterator it(system.pattern, column); it; ++it, ++position) {
      all.position.push_back(position), all.value.push_back(it.value());
      const double own = spring(it.row(), column);
      if (own != 0.0) few.position.push_back(position), few.value.push_back(own);
    }
  ASSERT_EQ(few.position.size(), 3U);
  system.stiffness_terms = {all, few};
  const Eigen::MatrixXd x =
      Eigen::MatrixXd::NullaryExpr(n, 4, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + i * 3.7 + j); });
  const Eigen::VectorXd theta = Eigen::VectorXd::Ones(2);
  const Eigen::MatrixXd whole = chain.selfadjointView<Eigen::Lower>(), part = spring.selfadjointView<Eigen::Lower>();
  EXPECT_LT((system.stiffness_derivative_times(theta, 0, x) - whole * x).norm(), 1e-12 * (whole * x).norm());
  EXPECT_LT((system.stiffness_derivative_times(theta, 1, x) - part * x).norm(), 1e-12 * (part * x).norm());
}

// Oracle: full displacements are E q.
TEST(ParametricSystem, ExpandsByItsLinks) {
  ParametricSystem system = two_terms();
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(6, 2);
  e(1, 0) = 1.0, e(4, 1) = -2.0;
  system.expansion = e.sparseView();
  const Eigen::Vector2d x(3.0, 5.0);
  EXPECT_EQ(system.expand(x), e * x);
  EXPECT_THROW((void)system.expand(Eigen::VectorXd::Zero(3)), InternalError);
}

}  // namespace
}  // namespace twindeck::fe
