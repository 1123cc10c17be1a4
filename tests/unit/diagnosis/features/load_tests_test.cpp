// Load tests as vectors. Oracle: a beam on two springs, written out by hand, in its own coordinates and in turned ones.
#include "diagnosis/features/load_tests.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace twindeck::tests {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// A rigid bar on a spring of 2 N/m at its left end and one of 3 N/m at its right end; 6 N down on the left third.
diagnosis::LoadTests bar_on_springs() {
  diagnosis::LoadTests tests;
  tests.cases = {"lorry"};
  tests.force = Vector2d(-4.0, -2.0);
  tests.grounds = {{"support:left", -1, Vector2d(2.0, 0.0), VectorXd::Zero(2)},
                   {"support:right", -1, Vector2d(0.0, 3.0), VectorXd::Zero(2)}};
  tests.rotation = tests.strain = MatrixXd::Zero(2, 2);
  tests.forces = {{0, Vector2d(2.0, 0.0), 2.0, VectorXd::Zero(1)}, {1, Vector2d(0.0, 3.0), 3.0, VectorXd::Zero(1)}};
  return tests;
}

TEST(LoadTestVectors, ForcesOfSupportsCarryTheLoadAndFollowTheGround) {
  const diagnosis::LoadTests own = bar_on_springs();
  Eigen::Matrix2d turn;
  turn << 0.8, -0.6, 0.6, 0.8;
  for (const MatrixXd& v : {MatrixXd(MatrixXd::Identity(2, 2)), MatrixXd(turn)}) {
    const diagnosis::LoadTests tests = diagnosis::projected(own, v);
    const MatrixXd stiffness = v.transpose() * Vector2d(2.0, 3.0).asDiagonal() * v;
    const auto forces = [&](const std::vector<diagnosis::GroundState>& ground) {
      const VectorXd q = stiffness.ldlt().solve(diagnosis::load_of(tests, 0, ground));
      return Vector2d(diagnosis::force_of(tests, 0, 0, ground, q), diagnosis::force_of(tests, 1, 0, ground, q));
    };
    // A bar on two springs is statically determinate: what the ground does changes where it lies, not what carries it.
    EXPECT_LT((forces({{}, {}}) - Vector2d(4.0, 2.0)).norm(), 1e-12);
    EXPECT_LT((forces({{1.0, -0.5}, {}}) - Vector2d(4.0, 2.0)).norm(), 1e-12);
    const VectorXd lowered = v * stiffness.ldlt().solve(diagnosis::load_of(tests, 0, {{1.0, -0.5}, {}}));
    EXPECT_LT((lowered - Vector2d(-2.5, -2.0 / 3.0)).norm(), 1e-12);
    EXPECT_EQ(diagnosis::loads_to_answer(tests).cols(), 5);
  }
}

}  // namespace
}  // namespace twindeck::tests
