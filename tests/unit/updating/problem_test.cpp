// Bounded dogleg on small functions. Oracles: closed-form optima of Rosenbrock's function with and without an active bound; for
// linear least squares, the enumeration of all 3^n active sets (the convex problem has one KKT point); properties (monotone
// cost, feasibility).
#include "updating/problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace twindeck::updating {
namespace {

bool rosenbrock(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
  residual << 10.0 * (x(1) - x(0) * x(0)), 1.0 - x(0);
  if (jacobian != nullptr) {
    jacobian->resize(2, 2);
    *jacobian << -20.0 * x(0), 10.0, -1.0, 0.0;
  }
  return true;
}

Box box_of(std::initializer_list<double> lower, std::initializer_list<double> upper) {
  Box box{Eigen::VectorXd(static_cast<Eigen::Index>(lower.size())), Eigen::VectorXd(static_cast<Eigen::Index>(upper.size()))};
  std::copy(lower.begin(), lower.end(), box.lower.data());
  std::copy(upper.begin(), upper.end(), box.upper.data());
  return box;
}

TEST(BoundedDogleg, FindsRosenbrockInside) {
  const BoundedResult result = minimise_on_box(rosenbrock, 2, Eigen::Vector2d(-1.2, 1.0), box_of({-3, -3}, {3, 3}), {}, {});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_NEAR((result.x - Eigen::Vector2d(1, 1)).norm(), 0.0, 1e-5);
}

// With x0 <= 0.5 the optimum of 100(x1 - x0²)² + (1 - x0)² is (0.5, 0.25) with cost 1/2·0.25.
TEST(BoundedDogleg, FindsRosenbrockOnABound) {
  const BoundedResult result = minimise_on_box(rosenbrock, 2, Eigen::Vector2d(-1.2, 1.0), box_of({-3, -3}, {0.5, 3}), {}, {});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_DOUBLE_EQ(result.x(0), 0.5);
  EXPECT_NEAR(result.x(1), 0.25, 1e-6);
  EXPECT_NEAR(result.cost, 0.125, 1e-10);
}

TEST(BoundedDogleg, RefusesStepsWhereTheFunctionDoesNotExist) {
  int refused = 0;
  const auto partial = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    if (x(1) > 1.5) return ++refused, false;
    return rosenbrock(x, residual, jacobian);
  };
  const BoundedResult result = minimise_on_box(partial, 2, Eigen::Vector2d(1.1, -2.5), box_of({-3, -3}, {3, 3}), {}, {});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_NEAR((result.x - Eigen::Vector2d(1, 1)).norm(), 0.0, 1e-5);
}

// Best feasible point over all 3^n ways of putting components on a bound: the exact optimum of a convex problem.
double enumerated_optimum(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Box& box) {
  const Eigen::Index n = a.cols();
  double best = std::numeric_limits<double>::infinity();
  const int cases = static_cast<int>(std::lround(std::pow(3.0, static_cast<double>(n))));
  for (int code = 0; code < cases; ++code) {
    Eigen::VectorXd x(n);
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0, rest = code; i < n; ++i, rest /= 3) {
      if (rest % 3 == 0) free.push_back(i);
      x(i) = rest % 3 == 0 ? 0.0 : rest % 3 == 1 ? box.lower(i) : box.upper(i);
    }
    if (!free.empty()) x(free) = a(Eigen::all, free).colPivHouseholderQr().solve(b - a * x);
    const bool feasible = ((x - box.lower).array() >= -1e-12).all() && ((box.upper - x).array() >= -1e-12).all();
    if (feasible) best = std::min(best, 0.5 * (a * x - b).squaredNorm());
  }
  return best;
}

// Correlated columns of unlike size, as sensitivities have: here projected dogleg steps alone stall.
TEST(BoundedDogleg, MeetsEnumeratedOptimumWithSeveralActiveBounds) {
  int with_two_bounds = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    const auto number = [&] { return static_cast<double>(engine() >> 11) * 0x1.0p-52 - 1.0; };
    constexpr Eigen::Index n = 5, m = 7;
    Eigen::MatrixXd a(m, n);
    Eigen::VectorXd b(m), common(m);
    for (Eigen::Index i = 0; i < m; ++i) common(i) = number();
    for (Eigen::Index j = 0; j < n; ++j) {
      const double size = std::pow(10.0, -2.0 * static_cast<double>(j) / n);
      for (Eigen::Index i = 0; i < m; ++i) a(i, j) = size * (common(i) + 0.1 * number());
    }
    for (Eigen::Index i = 0; i < m; ++i) b(i) = 2.0 * number();
    const Box box{Eigen::VectorXd::Constant(n, -0.5), Eigen::VectorXd::Constant(n, 0.7)};
    const auto linear = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
      residual = a * x - b;
      if (jacobian != nullptr) *jacobian = a;
      return true;
    };
    double last = std::numeric_limits<double>::infinity();
    const BoundedResult result =
        minimise_on_box(linear, static_cast<int>(m), Eigen::VectorXd::Zero(n), box, {}, [&](const AcceptedStep& step) {
          EXPECT_LE(step.cost, last);
          EXPECT_TRUE((step.x.array() >= box.lower.array()).all() && (step.x.array() <= box.upper.array()).all());
          last = step.cost;
        });
    EXPECT_TRUE(result.converged) << "seed " << seed << ": " << result.message << " " << result.projected_gradient;
    const double best = enumerated_optimum(a, b, box);
    EXPECT_NEAR(result.cost, best, 1e-7 * (1.0 + best)) << "seed " << seed;
    const std::vector<int> side = on_bound(result.x, box, 1e-6);
    with_two_bounds += std::count_if(side.begin(), side.end(), [](int s) { return s != 0; }) >= 2;
  }
  EXPECT_GE(with_two_bounds, 30);  // the case that this test is for does occur
}

// A parameter that no residual feels, and one that they hardly feel, must neither stop the search nor be thrown about.
TEST(BoundedDogleg, FlatDirectionsDoNotBreakIt) {
  const auto flat = [](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    residual << std::exp(x(0)) - 2.0, x(0) * x(0) + 1e-9 * x(1) - 0.3;
    if (jacobian != nullptr) {
      jacobian->resize(2, 3);
      *jacobian << std::exp(x(0)), 0.0, 0.0, 2.0 * x(0), 1e-9, 0.0;
    }
    return true;
  };
  const BoundedResult result = minimise_on_box(flat, 2, Eigen::Vector3d(0.1, 0.4, 0.6), box_of({0, 0, 0}, {1, 1, 1}), {}, {});
  ASSERT_TRUE(result.converged) << result.message;
  // Oracle: F'(x0) = 0 of the one parameter that is felt, by bisection.
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    const double slope = (std::exp(x) - 2.0) * std::exp(x) + (x * x - 0.3) * 2.0 * x;
    (slope < 0.0 ? low : high) = x;
  }
  EXPECT_NEAR(result.x(0), low, 1e-6);
  EXPECT_DOUBLE_EQ(result.x(2), 0.6);
}

// Computed residuals carry rounding, so that near the optimum the cost says nothing about a step. Rounding is played here by a
// term of 1e-12 that looks random; without it 1e-9 in the gradient is a matter of four steps.
TEST(BoundedDogleg, EndsWhereTheCostIsOnlyRounding) {
  for (int seed = 1; seed <= 40; ++seed) {
    const auto rounded = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
      residual << std::exp(x(0)) - 1.5, x(0) * x(1) - 0.3, x(1) + 0.5;
      for (int i = 0; i < 3; ++i) residual(i) += 1e-12 * std::sin(1e12 * (seed + i) * (x(0) + 0.7 * x(1)));
      if (jacobian != nullptr) {
        jacobian->resize(3, 2);
        *jacobian << std::exp(x(0)), 0.0, x(1), x(0), 0.0, 1.0;
      }
      return true;
    };
    BoundedOptions options;
    options.gradient_tolerance = 1e-9;
    const BoundedResult result = minimise_on_box(rounded, 3, Eigen::Vector2d(0.9, 0.6), box_of({-1, -1}, {1, 1}), options, {});
    EXPECT_TRUE(result.converged) << seed << ": " << result.message << ' ' << result.projected_gradient;
    EXPECT_LE(result.iterations, 30) << seed;
  }
}

// Residuals in small units are large, and so is their gradient: no longer than the way to a bound may a search that has just
// begun be called ended. Oracle: the same problem in units of 1, step by step.
TEST(BoundedDogleg, IsTheSameSearchInAnyUnitOfTheResiduals) {
  const auto history_in = [](double size) {
    const ResidualFunction sized = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
      (void)rosenbrock(x, residual, jacobian);
      residual *= size;
      if (jacobian != nullptr) *jacobian *= size;
      return true;
    };
    BoundedOptions options;
    options.gradient_tolerance = 1e-6 * size * size;
    options.residual_unit = size;
    std::vector<AcceptedStep> steps;
    const BoundedResult result = minimise_on_box(sized, 2, Eigen::Vector2d(-1.2, 1.0), box_of({-3, -3}, {3, 3}), options,
                                                 [&](const AcceptedStep& step) { steps.push_back(step); });
    EXPECT_TRUE(result.converged) << size << ": " << result.message;
    return steps;
  };
  const std::vector<AcceptedStep> plain = history_in(1.0);
  for (const double size : {1e-5, 3e3, 1e6}) {
    const std::vector<AcceptedStep> steps = history_in(size);
    ASSERT_EQ(steps.size(), plain.size()) << size;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_LT((steps[i].x - plain[i].x).norm(), 1e-9) << size << ", step " << i;
      EXPECT_NEAR(steps[i].cost / (size * size), plain[i].cost, 1e-9 * (1.0 + plain[i].cost)) << size << ", step " << i;
    }
  }
}

// The cost is steep, the bounds are near, and the step to them is short: no reason to end. Without units of one's own.
TEST(BoundedDogleg, DoesNotTakeTheWayToABoundForTheGradient) {
  const double size = 1e5;
  const auto steep = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    residual = size * (x - Eigen::Vector2d(0.3, 0.6));
    if (jacobian != nullptr) *jacobian = size * Eigen::Matrix2d::Identity();
    return true;
  };
  BoundedOptions options;
  options.gradient_tolerance = 1e-6 * size * size;
  const BoundedResult result = minimise_on_box(steep, 2, Eigen::Vector2d(0.5, 0.5), box_of({0, 0}, {1, 1}), options, {});
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LT((result.x - Eigen::Vector2d(0.3, 0.6)).norm(), 1e-6);
}

TEST(BoundedDogleg, SaysWhenTheIterationsDoNotSuffice) {
  BoundedOptions options;
  options.max_iterations = 2;
  const BoundedResult result =
      minimise_on_box(rosenbrock, 2, Eigen::Vector2d(-1.2, 1.0), box_of({-3, -3}, {3, 3}), options, {});
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.message.find("iteration limit"), std::string::npos) << result.message;
}

}  // namespace
}  // namespace twindeck::updating
