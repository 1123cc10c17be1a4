// Oracles: rigid motions, constant stress, Felippa's exact energy of pure bending, turned and renumbered triangles.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

#include "fe/triangle.hpp"

namespace twindeck::fe::triangle {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

const Corners kScalene = {Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(1.5, 0.3), Eigen::Vector2d(0.6, 1.1)};

/// u, v, rz of each corner from its place.
Vector9 field(const Corners& x, const std::function<Eigen::Vector3d(double, double)>& at) {
  Vector9 u;
  for (int i = 0; i < 3; ++i) u.segment<3>(3 * i) = at(x[static_cast<std::size_t>(i)].x(), x[static_cast<std::size_t>(i)].y());
  return u;
}

// Oracle: translations and a turn in the plane store nothing, whatever sides are straight.
TEST(TriangleMembrane, RigidMotionsStoreNothing) {
  for (const std::uint8_t sides : {0, 1, 2, 4, 7}) {
    const Matrix9 k = optimal_membrane(kScalene, 0.3, sides);
    EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
    EXPECT_LT((k * field(kScalene, [](double, double) { return Eigen::Vector3d(1.0, 2.0, 0.0); })).norm(), 1e-13 * k.norm());
    EXPECT_LT((k * field(kScalene, [](double x, double y) { return Eigen::Vector3d(-y, x, 1.0); })).norm(), 1e-13 * k.norm());
  }
}

// Oracle: constant strain: u'K u = A ε'D ε with D of plane stress by hand (ν = 0.25: 16/15, 4/15, 0.4). Corners whose both
// sides are straight take no moment.
TEST(TriangleMembrane, ConstantStrainHasItsEnergy) {
  const double exx = 0.7, eyy = -0.3, uy = 0.5, vx = 1.1, shear = uy + vx;
  const double energy = area(kScalene) * (16.0 / 15.0 * (exx * exx + eyy * eyy) + 8.0 / 15.0 * exx * eyy + 0.4 * shear * shear);
  const Vector9 u =
      field(kScalene, [&](double x, double y) { return Eigen::Vector3d(exx * x + uy * y, vx * x + eyy * y, 0.5 * (vx - uy)); });
  for (const std::uint8_t sides : {0, 1, 5, 7}) {
    const Matrix9 k = optimal_membrane(kScalene, 0.25, sides);
    EXPECT_NEAR(u.dot(k * u) / energy, 1.0, 1e-13);
    const Vector9 force = k * u;
    for (int corner = 0; corner < 3; ++corner) {
      const bool straight = (sides >> corner & 1) != 0 && (sides >> ((corner + 2) % 3) & 1) != 0;
      EXPECT_EQ(std::abs(force[3 * corner + 2]) < 1e-13, straight) << int{sides} << ' ' << corner;
    }
  }
}

// Oracle: Felippa (2003), section 5: two triangles that make a rectangle a × b have the energy κ² a b³/12 of pure bending, u =
// -κ x y, v = κ (x² + ν y²)/2, rz = κ x, for either diagonal and any ratio (20 to 1 costs 20⁴ of rounding).
TEST(TriangleMembrane, RectangleOfTwoBendsExactly) {
  for (const double a : {0.1, 1.0, 20.0})
    for (const double nu : {0.0, 0.25}) {
      const double x = 0.5 * a, y = 0.5;
      const Eigen::Vector2d p(-x, -y), q(x, -y), r(x, y), s(-x, y);
      const auto bent = [nu](double px, double py) { return Eigen::Vector3d(-px * py, 0.5 * (px * px + nu * py * py), px); };
      for (const auto& pair :
           {std::array<Corners, 2>{Corners{p, q, r}, Corners{p, r, s}}, {Corners{q, r, s}, Corners{q, s, p}}}) {
        double twice = 0.0;
        for (const Corners& corners : pair) {
          const Vector9 u = field(corners, bent);
          twice += u.dot(optimal_membrane(corners, nu, 0) * u);
        }
        EXPECT_NEAR(twice / (a / 12.0), 1.0, 1e-9) << a << ' ' << nu;
      }
    }
}

// Oracle: axes turned by an angle turn u and v; corners in another order give the permuted matrix, sides with them.
TEST(TriangleMembrane, NeitherAxesNorNumberingMatter) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  Corners turned, shifted;
  Matrix9 t = Matrix9::Identity(), p = Matrix9::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    turned[i] = turn * kScalene[i] + Eigen::Vector2d(3.0, -4.0);
    shifted[i] = kScalene[(i + 1) % 3];
    t.block<2, 2>(at, at) = turn;
    p.block<3, 3>(at, static_cast<Eigen::Index>(3 * ((i + 1) % 3))).setIdentity();
  }
  const Matrix9 k = optimal_membrane(kScalene, 0.3, 0b010);
  EXPECT_LT((optimal_membrane(turned, 0.3, 0b010) - t * k * t.transpose()).norm(), 1e-12 * k.norm());
  EXPECT_LT((optimal_membrane(shifted, 0.3, 0b001) - p * k * p.transpose()).norm(), 1e-13 * k.norm());
}

// Oracle: rank 9 - 3, also where β₀ would vanish (property).
TEST(TriangleMembrane, HasNoFurtherMechanism) {
  for (const double nu : {0.0, 0.3, 0.4999}) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(optimal_membrane(kScalene, nu, 0)).eigenvalues();
    EXPECT_LT(std::abs(values[2]), 1e-12 * values[8]);
    EXPECT_GT(values[3], 1e-4 * values[8]);
  }
}

}  // namespace
}  // namespace twindeck::fe::triangle
