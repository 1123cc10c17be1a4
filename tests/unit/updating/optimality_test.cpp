// Oracle: the first-order (KKT) conditions written out for single components.
#include "updating/optimality.hpp"

#include <gtest/gtest.h>

namespace twindeck::updating {
namespace {

const Box unit_box{Eigen::VectorXd::Zero(4), Eigen::VectorXd::Ones(4)};

TEST(ProjectedGradient, KeepsWhatTheBoundsDoNotHold) {
  // on lower with descent outward | on lower with descent inward | on upper with descent outward | inside
  const Eigen::Vector4d x(0.0, 0.0, 1.0, 0.5), gradient(2.0, -3.0, -4.0, 5.0);
  EXPECT_EQ(projected_gradient(x, gradient, unit_box, 1e-6), Eigen::Vector4d(0.0, -3.0, 0.0, 5.0));
  EXPECT_EQ(on_bound(x, unit_box, 1e-6), (std::vector<int>{-1, -1, 1, 0}));
  EXPECT_EQ(held(x, gradient, unit_box, 1e-6), (std::vector<bool>{true, false, true, false}));
}

TEST(ProjectedGradient, ToleranceIsAFractionOfTheRange) {
  const Box wide{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 100.0)};
  EXPECT_EQ(on_bound(Eigen::VectorXd::Constant(1, 9e-5), wide, 1e-6).front(), -1);
  EXPECT_EQ(on_bound(Eigen::VectorXd::Constant(1, 2e-4), wide, 1e-6).front(), 0);
}

TEST(ProjectedGradient, ReferenceHasAFloorForAStartOnTheOptimum) {
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(4, 4);
  EXPECT_DOUBLE_EQ(gradient_reference(Eigen::VectorXd::Zero(4), jacobian), 2e-4);
  EXPECT_DOUBLE_EQ(gradient_reference(Eigen::VectorXd::Ones(4), jacobian), 2.0);
}

}  // namespace
}  // namespace twindeck::updating
