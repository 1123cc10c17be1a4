// Oracles: rigid motions, constant curvature, turned and renumbered triangles.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fe/triangle.hpp"

namespace twindeck::fe::triangle {
namespace {

using Plate9 = Eigen::Matrix<double, 9, 1>;

const Corners kPlate = {Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(1.5, 0.3), Eigen::Vector2d(0.6, 1.1)};

/// w = c + (a x² + 2 b x y + d y²)/2 + slopes, with rx = dw/dy and ry = -dw/dx.
Plate9 deflection(const Corners& corners, const Eigen::Matrix2d& curvature, const Eigen::Vector2d& slope, double height) {
  Plate9 u;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& x = corners[static_cast<std::size_t>(i)];
    const Eigen::Vector2d gradient = curvature * x + slope;
    u.segment<3>(3 * i) << height + slope.dot(x) + 0.5 * x.dot(curvature * x), gradient.y(), -gradient.x();
  }
  return u;
}

// Oracle: heaving and both tilts store nothing; rank 9 - 3 (property).
TEST(TrianglePlate, RigidMotionsStoreNothing) {
  const Matrix9 k = plate_bending(kPlate, 0.3);
  EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(d);
    EXPECT_LT((k * deflection(kPlate, Eigen::Matrix2d::Zero(), e.head<2>(), e.z())).norm(), 1e-13 * k.norm()) << d;
  }
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  EXPECT_LT(std::abs(values[2]), 1e-12 * values[8]);
  EXPECT_GT(values[3], 1e-4 * values[8]);
}

// Oracle: Kirchhoff: u'K u = A/(12 (1 - ν²)) (κx² + κy² + 2 ν κx κy + (1 - ν)/2 (2 κxy)²), here ν = 0.25.
TEST(TrianglePlate, ConstantCurvatureHasItsEnergy) {
  Eigen::Matrix2d bend, twist;
  bend << 0.7, 0.0, 0.0, -0.4;
  twist << 0.0, 0.3, 0.3, 0.0;
  const double d = area(kPlate) / (12.0 * (1.0 - 0.0625));
  const Matrix9 k = plate_bending(kPlate, 0.25);
  const Plate9 u = deflection(kPlate, bend, {0.2, 0.1}, 0.5), v = deflection(kPlate, twist, {0.0, 0.3}, -1.0);
  EXPECT_NEAR(u.dot(k * u) / (d * (0.49 + 0.16 - 0.5 * 0.28)), 1.0, 1e-12);
  EXPECT_NEAR(v.dot(k * v) / (d * 0.375 * 0.36), 1.0, 1e-12);
  EXPECT_NEAR(u.dot(k * v), 0.0, 1e-13);
}

// Oracle: balance: whatever bends it (here w = x³), the forces at the corners and their moments add to nothing.
TEST(TrianglePlate, ForcesBalance) {
  Plate9 u;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& x = kPlate[static_cast<std::size_t>(i)];
    u.segment<3>(3 * i) << x.x() * x.x() * x.x(), 0.0, -3.0 * x.x() * x.x();
  }
  const Plate9 force = plate_bending(kPlate, 0.2) * u;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // force, moments about x and y
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& x = kPlate[static_cast<std::size_t>(i)];
    const double f = force[3 * i];
    sum += Eigen::Vector3d(f, force[3 * i + 1] + x.y() * f, force[3 * i + 2] - x.x() * f);
  }
  EXPECT_GT(force.norm(), 0.1);
  EXPECT_LT(sum.norm(), 1e-13 * force.norm());
}

// Oracle: axes turned by an angle turn rx and ry; corners in another order give the permuted matrix.
TEST(TrianglePlate, NeitherAxesNorNumberingMatter) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  Corners turned, shifted;
  Matrix9 t = Matrix9::Identity(), p = Matrix9::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    turned[i] = turn * kPlate[i] + Eigen::Vector2d(3.0, -4.0);
    shifted[i] = kPlate[(i + 1) % 3];
    t.block<2, 2>(at + 1, at + 1) = turn;
    p.block<3, 3>(at, static_cast<Eigen::Index>(3 * ((i + 1) % 3))).setIdentity();
  }
  const Matrix9 k = plate_bending(kPlate, 0.3);
  EXPECT_LT((plate_bending(turned, 0.3) - t * k * t.transpose()).norm(), 1e-12 * k.norm());
  EXPECT_LT((plate_bending(shifted, 0.3) - p * k * p.transpose()).norm(), 1e-13 * k.norm());
}

}  // namespace
}  // namespace twindeck::fe::triangle
