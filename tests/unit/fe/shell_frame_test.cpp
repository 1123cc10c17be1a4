// Oracles: squares and warped squares by hand, the properties of bilinear shapes, rigid motions.
#include "fe/shell_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace twindeck::fe {
namespace {

ShellGeometry four(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  return {{a, b, c, d}};
}

ShellGeometry warped_square() { return four({1, 1, 0.1}, {3, 1, -0.1}, {3, 3, 0.1}, {1, 3, -0.1}); }

// Oracle: a square of 2 m with corners 0.1 m above and below its plane in turn.
TEST(ShellFrame, WarpedSquareLiesAboutItsMeanPlane) {
  const shell::Frame frame = shell::frame_of(warped_square());
  EXPECT_LT((frame.axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((frame.corner_m[i] - Eigen::Vector2d(shell::kXi[i], shell::kEta[i])).norm(), 1e-14);
    EXPECT_NEAR(frame.height_m[i], i % 2 == 0 ? 0.1 : -0.1, 1e-14);
  }
}

// Oracle: the right-hand rule: clockwise corners turn the normal down; a wall has a level normal.
TEST(ShellFrame, NormalFollowsTheOrderOfTheCorners) {
  const shell::Frame down = shell::frame_of(four({0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}));
  EXPECT_LT((down.axes.row(2) + Eigen::RowVector3d::UnitZ()).norm(), 1e-14);
  const shell::Frame wall = shell::frame_of(four({0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}));
  EXPECT_LT((wall.axes.row(2) + Eigen::RowVector3d::UnitY()).norm(), 1e-14);
  EXPECT_NEAR(wall.axes.determinant(), 1.0, 1e-14);
}

// Oracle: a rigid turn θ moves the projected corners by R (θ × x), as points of the plane.
TEST(ShellFrame, ProjectedCornersRideOnTheirNodes) {
  const ShellGeometry g = warped_square();
  const shell::Frame frame = shell::frame_of(g);
  const Eigen::Vector3d turn(0.3, -0.7, 0.5);
  Eigen::Matrix<double, 24, 1> u;
  for (int i = 0; i < 4; ++i) {
    u.segment<3>(6 * i) = turn.cross(g.node_m[static_cast<std::size_t>(i)]);
    u.segment<3>(6 * i + 3) = turn;
  }
  const Eigen::Matrix<double, 24, 1> local = shell::corner_displacements(frame) * u;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& x = frame.corner_m[static_cast<std::size_t>(i)];
    const Eigen::Vector3d at(2.0 + x.x(), 2.0 + x.y(), 0.0);
    EXPECT_LT((local.segment<3>(6 * i) - frame.axes * turn.cross(at)).norm(), 1e-14);
    EXPECT_LT((local.segment<3>(6 * i + 3) - frame.axes * turn).norm(), 1e-14);
  }
}

// Oracle: bilinear shapes sum to one and carry linear fields: Σ N x = x(ξ, η), Σ ∇N x = 1. The Jacobian's integral is the area.
TEST(ShellFrame, BilinearShapesCarryLinearFields) {
  const shell::Frame frame = shell::frame_of(four({0, 0, 0}, {3, 0.5, 0}, {2.5, 2, 0}, {-0.5, 1, 0}));
  double sum = 0.0;
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear b = shell::bilinear_at(frame, point.x(), point.y());
    Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
    for (int i = 0; i < 4; ++i) slope += b.gradient.col(i) * frame.corner_m[static_cast<std::size_t>(i)].transpose();
    EXPECT_LT((slope - Eigen::Matrix2d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(b.value.sum(), 1.0, 1e-15);
    EXPECT_LT(b.gradient.rowwise().sum().norm(), 1e-15);
    EXPECT_LT((b.jacobian * b.inverse - Eigen::Matrix2d::Identity()).norm(), 1e-14);
    sum += b.determinant;
  }
  EXPECT_NEAR(sum, 0.5 * std::abs(2.5 * 0.5 - 2.0 * -3.5), 1e-13);  // half the cross product of the diagonals
  for (int i = 0; i < 4; ++i) {
    const auto corner = static_cast<std::size_t>(i);
    EXPECT_LT((shell::bilinear_at(frame, shell::kXi[corner], shell::kEta[corner]).value - Eigen::Vector4d::Unit(i)).norm(),
              1e-15);
  }
}

// Oracle: Hooke: stretching by ε with the sides held gives σ = E ε/(1 - ν²) and ν times that; shear 1/(2 (1 + ν)).
TEST(ShellFrame, PlaneStress) {
  Eigen::Matrix3d expected;
  expected << 16.0 / 15.0, 4.0 / 15.0, 0.0, 4.0 / 15.0, 16.0 / 15.0, 0.0, 0.0, 0.0, 0.4;
  EXPECT_LT((shell::plane_stress(0.25) - expected).norm(), 1e-15);
}

// Oracle: the contract.
TEST(ShellFrame, RefusesWhatIsNoConvexQuadrilateral) {
  EXPECT_THROW((void)shell::frame_of(four({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0})), InputError);      // on a line
  EXPECT_THROW((void)shell::frame_of(four({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0})), InputError);      // a bow tie
  EXPECT_THROW((void)shell::frame_of(four({0, 0, 0}, {2, 0, 0}, {0.3, 0.3, 0}, {0, 2, 0})), InputError);  // an arrow
  EXPECT_THROW((void)shell::frame_of(four({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0})), InputError);      // a corner twice
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)shell::frame_of(four({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, nan, 0})), InputError);
}

}  // namespace
}  // namespace twindeck::fe
