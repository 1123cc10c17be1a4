// Oracles: residuals whose valleys are known in closed form; points of a plane nearest to a point; hand-made ends.
#include <gtest/gtest.h>

#include <cmath>

#include "updating/valley_walk.hpp"

namespace twindeck::updating {
namespace {

const Sight kSight;

Eigen::MatrixXd flat_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& x, const Box& box,
                        const Eigen::VectorXd& residual) {
  return flat_directions(residual, jacobian, x, box, kSight);
}

// r = x0 + x1 - 1 and nothing of x2: flat are e2 and, in units of the ranges (1, 2), (2, -1)/sqrt(5).
TEST(FlatDirections, AreThoseThatNoResidualFeels) {
  const Box box{Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 2, 3)};
  const Eigen::MatrixXd jacobian = (Eigen::MatrixXd(1, 3) << 1, 1, 0).finished();
  const Eigen::MatrixXd flat = flat_of(jacobian, Eigen::Vector3d(0.5, 0.5, 1), box, Eigen::VectorXd::Zero(1));
  ASSERT_EQ(flat.cols(), 2);
  EXPECT_EQ(flat.col(0), Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(std::abs(flat.col(1).dot(Eigen::Vector3d(2, -1, 0) / std::sqrt(5.0))), 1.0, 1e-12);
}

TEST(FlatDirections, AreNoneWhereEveryParameterIsSeen) {
  const Box box{Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()};
  const Eigen::MatrixXd jacobian = (Eigen::MatrixXd(2, 2) << 1, 1, 1, 1.001).finished();
  EXPECT_EQ(flat_of(jacobian, Eigen::Vector2d(0.5, 0.5), box, Eigen::Vector2d(0.1, 0.1)).cols(), 0);
}

// Both rise along r = x0 + x1 > 0 and rest on their lower bounds: the multipliers hold them, and nothing is flat. With r = 0
// there are no multipliers, and bounds do not make the valley narrower.
TEST(FlatDirections, LeaveOutWhatAMultiplierHolds) {
  const Box box{Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()};
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(1, 2);
  EXPECT_EQ(flat_of(jacobian, Eigen::Vector2d::Zero(), box, Eigen::VectorXd::Constant(1, 0.3)).cols(), 0);
  EXPECT_EQ(flat_of(jacobian, Eigen::Vector2d::Zero(), box, Eigen::VectorXd::Constant(1, 1e-13)).cols(), 1);
}

// To 1e-5: the ridge is 1e-10 of the normal matrix, whose rounding is 1e-16.
// The foot of the perpendicular from (0.5, 0.5) on x0 + x1 = 1.4 is (0.7, 0.7); with x0 <= 0.6 it is (0.6, 0.8).
TEST(NearestInValley, IsTheFootOfThePerpendicularInsideTheBox) {
  const Eigen::MatrixXd jacobian = (Eigen::MatrixXd(1, 3) << 1, 1, 0).finished();
  const Eigen::Vector3d x(0.45, 0.95, 0.1), wanted(0.5, 0.5, 0.3);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  const Box wide{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  EXPECT_LT((nearest_in_valley(none, jacobian, x, wanted, wide, kSight) - Eigen::Vector3d(0.7, 0.7, 0.3)).norm(), 1e-5);
  EXPECT_EQ(nearest_in_valley(none, jacobian, x, wanted, wide, kSight)(2), 0.3);
  const Box narrow{Eigen::Vector3d(-0.4, 0, 0), Eigen::Vector3d(0.6, 1, 1)};  // all ranges 1
  EXPECT_LT((nearest_in_valley(none, jacobian, x, wanted, narrow, kSight) - Eigen::Vector3d(0.6, 0.8, 0.3)).norm(), 1e-5);
}

TEST(NearestInValley, IsTheWantedPointWhereNothingIsSeen) {
  const Box box{Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()};
  const Eigen::Vector2d wanted(0.2, 0.9);
  EXPECT_EQ(
      nearest_in_valley(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, 2), Eigen::Vector2d(0.5, 0.5), wanted, box, kSight),
      wanted);
}

TEST(EqualCost, IsUpToWhatASearchLeaves) {
  EXPECT_TRUE(equal_cost(1e-18, 4e-24, 1e-4));   // exact fits: both are far below a residual of 1e-4
  EXPECT_FALSE(equal_cost(1e-12, 4e-24, 1e-4));  // this one's search ended earlier
  EXPECT_TRUE(equal_cost(5.03254e-3, 5.032541e-3, 1e-4));
  EXPECT_FALSE(equal_cost(5.03e-3, 5.04e-3, 1e-4));
}

EndPoint end_at(double x0, double x1, double cost, double slope1) {
  return {Eigen::Vector2d(x0, x1), cost, true, (Eigen::MatrixXd(2, 2) << 1, 0, 0, slope1).finished(), Eigen::Vector2d::Zero()};
}

int preferred(const std::vector<EndPoint>& ends, const std::vector<int>& optimum, int cheapest) {
  const Box box{Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()};
  return preferred_end(ends, optimum, cheapest, Eigen::Vector2d(0.5, 0.5), box, kSight);
}

TEST(PreferredEnd, IsTheNearestOfAValleyAndOfEqualOptima) {
  EXPECT_EQ(preferred({end_at(0.3, 0.9, 2e-20, 0), end_at(0.3, 0.6, 1e-19, 0), end_at(0.3, 0.1, 1e-23, 0)}, {2, 2, 2}, 2), 1);
  EXPECT_EQ(preferred({end_at(0.2, 0.5, 1e-25, 1), end_at(0.6, 0.5, 1e-20, 1)}, {0, 1}, 0), 1);  // two optima, equal cost
  EXPECT_EQ(preferred({end_at(0.8, 0.2, 2e-20, 1), end_at(0.2, 0.8, 1e-25, 1)}, {0, 1}, 1), 0);  // as near: the earlier start
}

TEST(PreferredEnd, IsTheCheapestWhereTheDataDecide) {
  EXPECT_EQ(preferred({end_at(0.5, 0.5, 2e-2, 1), end_at(0.9, 0.9, 1e-2, 1)}, {0, 1}, 1), 1);
  EXPECT_EQ(preferred({end_at(0.3, 0.2, 1e-2 + 1e-11, 1), end_at(0.3, 0.199999, 1e-2, 1)}, {1, 1}, 1), 1);  // one optimum
}

}  // namespace
}  // namespace twindeck::updating
