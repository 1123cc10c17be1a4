// Oracles: the defining property of a Latin hypercube (one point in each stratum of each parameter); the 10000th number of
// std::mt19937_64 is fixed by the C++ standard, ours are bits of that sequence; end points with known grouping.
#include "updating/multi_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace twindeck::updating {
namespace {

TEST(StartingPoints, FirstIsGivenAndTheRestIsALatinHypercube) {
  const Box box{Eigen::Vector3d(-1.0, 0.0, 10.0), Eigen::Vector3d(1.0, 0.5, 30.0)};
  const Eigen::Vector3d first(0.3, 0.1, 20.0);
  const Eigen::MatrixXd points = starting_points(first, box, 8, 42);
  EXPECT_EQ(points.col(0), first);
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::set<int> strata;
    for (Eigen::Index k = 1; k < 8; ++k) {
      strata.insert(static_cast<int>(7.0 * (points(i, k) - box.lower(i)) / (box.upper(i) - box.lower(i))));
    }
    EXPECT_EQ(strata, (std::set<int>{0, 1, 2, 3, 4, 5, 6}));
  }
}

TEST(StartingPoints, SameSeedSameBytes) {
  const Box box{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
  EXPECT_EQ(starting_points(Eigen::VectorXd::Zero(1), box, 8, 3), starting_points(Eigen::VectorXd::Zero(1), box, 8, 3));
  EXPECT_NE(starting_points(Eigen::VectorXd::Zero(1), box, 8, 3), starting_points(Eigen::VectorXd::Zero(1), box, 8, 4));
  // One drawn point needs no shuffle: it is the first number of the engine, whose sequence the standard fixes.
  std::mt19937_64 engine(3);
  EXPECT_EQ(starting_points(Eigen::VectorXd::Zero(1), box, 2, 3)(0, 1), static_cast<double>(engine() >> 11) * 0x1.0p-53);
}

EndPoint end_point(double x0, double x1, double cost, bool converged = true) {
  EndPoint end{Eigen::Vector2d(x0, x1), cost, converged, Eigen::MatrixXd::Zero(1, 2), Eigen::VectorXd::Zero(1)};
  end.jacobian << 1.0, 0.0;  // residuals do not feel x1
  return end;
}

TEST(DistinctOptima, GroupsByParametersAndCostAndForgivesFlatDirections) {
  const Box box{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};
  const std::vector<int> optimum =
      distinct_optima({end_point(0.2, 0.5, 2e-3), end_point(0.8, 0.5, 1e-3), end_point(0.8, 0.1, 1e-3),
                       end_point(0.2003, 0.5, 2.0000001e-3), end_point(0.5, 0.5, 1e-9, false), end_point(0.6, 0.5, 1e-3)},
                      box);
  EXPECT_EQ(optimum, (std::vector<int>{0, 1, 1, 0, -1, 5}));
}

}  // namespace
}  // namespace twindeck::updating
