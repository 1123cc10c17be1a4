// Oracles: a permutation of known modes, and the same shapes scaled to another mass (MAC must not change).
#include "matching/mode_following.hpp"

#include <gtest/gtest.h>

namespace twindeck::matching {
namespace {

TEST(ModeFollower, FindsPermutedModesWhateverTheirScale) {
  Eigen::Vector3d m(2.0, 1.0, 4.0);
  linalg::SparseMatrix mass = Eigen::MatrixXd(m.asDiagonal()).sparseView();
  dynamics::EigenModes reference;
  reference.shapes = m.cwiseSqrt().cwiseInverse().asDiagonal();  // mass-normalised unit shapes
  reference.frequency_Hz = reference.eigenvalue = Eigen::Vector3d(1, 2, 3);
  const ModeFollower follower(mass, reference);
  Eigen::MatrixXd moved(3, 3);
  moved << reference.shapes.col(2), -0.5 * reference.shapes.col(0), 3.0 * reference.shapes.col(1);
  const FollowedModes followed = follower.follow(moved);
  EXPECT_EQ(followed.position, (std::vector<int>{1, 2, 0}));
  EXPECT_NEAR((followed.mac - Eigen::Vector3d::Ones()).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace twindeck::matching
