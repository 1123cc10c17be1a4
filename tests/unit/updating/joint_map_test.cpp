// Maximum of a posterior. Oracle: of a linear model it is a system of equations in closed form.
#include "updating/joint_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace twindeck::tests {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(JointMap, OfALinearModelIsTheClosedFormWithFewAndWithManyUnknowns) {
  for (const int unknowns : {5, 40}) {  // fewer and more than rows
    constexpr int kRows = 12;
    const MatrixXd slope = MatrixXd::Random(kRows, unknowns);
    const VectorXd y = VectorXd::Random(kRows);
    const auto predict = [&](const VectorXd& x, VectorXd& g, MatrixXd* jacobian, MatrixXd* scales) {
      g = slope * x;
      if (jacobian != nullptr) *jacobian = slope;
      if (scales != nullptr) scales->resize(kRows, 0);
      return true;
    };
    const updating::Box box{VectorXd::Constant(unknowns, -1e3), VectorXd::Constant(unknowns, 1e3)};
    updating::JointMapOptions options;
    options.tolerance = 1e-16;
    const auto map = updating::joint_map(predict, y, MatrixXd::Identity(kRows, kRows), VectorXd::Zero(unknowns), box, options);
    const MatrixXd normal = slope.transpose() * slope + MatrixXd::Identity(unknowns, unknowns);
    EXPECT_LT((map.x - normal.ldlt().solve(slope.transpose() * y)).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace twindeck::tests
