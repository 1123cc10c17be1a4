// Oracle: first-order (KKT) conditions of the strictly convex problem, which are sufficient; and the unbounded solution where
// no bound is met.
#include "updating/bounded_quadratic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace twindeck::updating {
namespace {

TEST(BoundedQuadratic, SatisfiesKktForIllConditionedColumns) {
  constexpr double ridge = 1e-8;
  int on_bounds = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    const auto number = [&] { return static_cast<double>(engine() >> 11) * 0x1.0p-52 - 1.0; };
    constexpr Eigen::Index n = 9, m = 7;  // fewer residuals than parameters: the ridge alone makes it unique
    Eigen::MatrixXd jacobian(m, n);
    Eigen::VectorXd residual(m), x(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      x(j) = j % 3 == 0 ? -0.3 : j % 3 == 1 ? 0.4 : 0.1;  // on the lower bound, on the upper, inside
      for (Eigen::Index i = 0; i < m; ++i) jacobian(i, j) = std::pow(10.0, -0.5 * static_cast<double>(j)) * (0.5 + number());
    }
    for (Eigen::Index i = 0; i < m; ++i) residual(i) = number();
    const Box box{Eigen::VectorXd::Constant(n, -0.3), Eigen::VectorXd::Constant(n, 0.4)};
    const Eigen::VectorXd s = bounded_gauss_newton_step(residual, jacobian, x, box, ridge);
    const Eigen::VectorXd gradient = jacobian.transpose() * (residual + jacobian * s) + ridge * s;
    ASSERT_TRUE(((x + s - box.lower).array() >= -1e-12).all() && ((box.upper - x - s).array() >= -1e-12).all());
    EXPECT_LT(projected_gradient(x + s, gradient, box, 1e-10).norm(), 1e-11) << "seed " << seed;
    for (const int side : on_bound(x + s, box, 1e-10)) on_bounds += side != 0;
  }
  EXPECT_GT(on_bounds, 400);
}

TEST(BoundedQuadratic, IsTheGaussNewtonStepWhereNoBoundIsMet) {
  Eigen::MatrixXd jacobian(3, 2);
  jacobian << 1.0, 0.2, -0.3, 2.0, 0.5, 0.1;
  const Eigen::Vector3d residual(0.02, -0.01, 0.03);
  const Box box{Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)};
  const Eigen::Matrix2d normal = jacobian.transpose() * jacobian + 1e-8 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d expected = -normal.llt().solve(jacobian.transpose() * residual);
  const Eigen::VectorXd s = bounded_gauss_newton_step(residual, jacobian, Eigen::Vector2d::Zero(), box, 1e-8);
  EXPECT_NEAR((s - expected).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace twindeck::updating
