// Oracles: problems of one and two unknowns by hand, normal equations, the conditions of Karush, Kuhn and Tucker.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "fe/prestress.hpp"

namespace twindeck::fe {
namespace {

// Oracle: min (2 x - 6)² is 3, or the bound if that lies above.
TEST(PrestressLeastSquares, OneUnknown) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(1, 1, 2.0);
  const Eigen::VectorXd b = Eigen::VectorXd::Constant(1, 6.0);
  for (const double lower : {-5.0, 0.0, 2.9}) EXPECT_NEAR(solve_bounded_least_squares(a, b, lower).x[0], 3.0, 1e-12) << lower;
  for (const double lower : {3.0, 4.0, 1e6}) EXPECT_EQ(solve_bounded_least_squares(a, b, lower).x[0], lower);
}

// Oracle: min (x + y - 1)² + (x - y - 5)² without bounds is (3, -2). With y >= 0: x = (1 + 5)/2 = 3. With y >= 1: (0 + 6)/2
// = 3. With both >= 4 the slopes at (4, 4), 2 (7 - 5) and 2 (7 + 5), point inwards: both stay.
TEST(PrestressLeastSquares, TwoUnknownsAndTheirBound) {
  Eigen::Matrix2d a;
  a << 1.0, 1.0, 1.0, -1.0;
  const Eigen::Vector2d b(1.0, 5.0);
  const auto solution = [&](double lower) { return Eigen::Vector2d(solve_bounded_least_squares(a, b, lower).x); };
  EXPECT_LT((solution(-10.0) - Eigen::Vector2d(3.0, -2.0)).norm(), 1e-12);
  EXPECT_LT((solution(0.0) - Eigen::Vector2d(3.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((solution(1.0) - Eigen::Vector2d(3.0, 1.0)).norm(), 1e-12);
  EXPECT_EQ(solution(4.0), Eigen::Vector2d(4.0, 4.0));
}

/// Twenty stays and thirty rows of which some are a weak ridge, with columns of unlike size.
struct Stays {
  Eigen::MatrixXd a{50, 20};
  Eigen::VectorXd b{50};
  explicit Stays(unsigned seed) {
    std::mt19937 numbers(seed);
    std::normal_distribution<double> normal;
    a.setZero();
    for (Eigen::Index j = 0; j < 20; ++j) {
      for (Eigen::Index i = 0; i < 30; ++i) a(i, j) = normal(numbers) * (j % 2 == 0 ? 1.0 : 1e-4);
      a(30 + j, j) = 1e-6;
    }
    for (Eigen::Index i = 0; i < 50; ++i) b[i] = i < 30 ? normal(numbers) : 0.0;
  }
};

// Oracle: the conditions at a minimum: no slope where x is off the bound, no descent inwards where it is on it. The problem is
// convex, so they suffice.
TEST(PrestressLeastSquares, MeetsTheConditionsOfAMinimum) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Stays problem(seed);
    const BoundedLeastSquares found = solve_bounded_least_squares(problem.a, problem.b, 0.1);
    ASSERT_TRUE(found.status.converged);
    const Eigen::VectorXd slope = problem.a.transpose() * (problem.a * found.x - problem.b);
    const Eigen::VectorXd size = problem.a.colwise().norm();
    int on_bound = 0;
    for (Eigen::Index i = 0; i < 20; ++i) {
      EXPECT_GE(found.x[i], 0.1);
      on_bound += found.x[i] == 0.1 ? 1 : 0;
      EXPECT_GT(slope[i] / size[i], -1e-10) << i;
      EXPECT_TRUE(found.x[i] == 0.1 || slope[i] / size[i] < 1e-10) << i;
    }
    EXPECT_GT(on_bound, 0);
    EXPECT_LT(on_bound, 20);
  }
}

// Oracle: with a bound far below, the normal equations.
TEST(PrestressLeastSquares, FarBoundLeavesTheNormalEquations) {
  Stays problem(3);
  problem.a.bottomRows(20) *= 1e5;  // a ridge of 0.1, so that the normal equations are well posed
  const Eigen::VectorXd expected = (problem.a.transpose() * problem.a).ldlt().solve(problem.a.transpose() * problem.b);
  const BoundedLeastSquares found = solve_bounded_least_squares(problem.a, problem.b, -1e3);
  EXPECT_TRUE(found.status.converged);
  EXPECT_LT((found.x - expected).norm(), 1e-9 * expected.norm());
}

// Oracle: units. A column in kN instead of N gives a thousandth of its unknown (at the bound of zero).
TEST(PrestressLeastSquares, UnitsOfAColumnDoNotMatter) {
  Stays problem(5);
  problem.a.bottomRows(20) *= 1e3;
  const Eigen::VectorXd x = solve_bounded_least_squares(problem.a, problem.b, 0.0).x;
  problem.a.col(4) *= 1e3;
  Eigen::VectorXd scaled = solve_bounded_least_squares(problem.a, problem.b, 0.0).x;
  scaled[4] *= 1e3;
  EXPECT_LT((scaled - x).norm(), 1e-9 * x.norm());
}

}  // namespace
}  // namespace twindeck::fe
