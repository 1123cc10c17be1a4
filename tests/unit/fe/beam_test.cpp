#include "fe/beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"
#include "fe/bar.hpp"

namespace twindeck::fe {
namespace {

/// An unsymmetric section (an angle, roughly) of a steel-like material, short enough for shear to matter.
BeamStiffnessProperties angle() { return {210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 2.0e-6, 5.0e-8, 1.8e-3, 2.2e-3}; }
BeamStiffnessProperties symmetric() { return {210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 0.0, 5.0e-8, 1.8e-3, 2.2e-3}; }

/// A beam in a general direction with a general orientation.
BeamGeometry skewed() {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d(1.0, -2.0, 0.5), Eigen::Vector3d(2.2, -0.9, 1.4)};
  g.orientation = Eigen::Vector3d(0.2, -0.3, 1.0);
  return g;
}

BeamGeometry along_x(double length) {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d(length, 0.0, 0.0)};
  return g;
}

/// Displacements of node i under the rigid motion of direction d (three translations, three rotations about the origin).
Vector12 rigid_motion(const BeamGeometry& g, int d) {
  Vector12 u = Vector12::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(d % 3);
    if (d < 3) {
      u.segment<3>(at) = e;
    } else {
      u.segment<3>(at) = e.cross(g.node_m[i]);
      u.segment<3>(at + 3) = e;
    }
  }
  return u;
}

int beam_rank(const Matrix12& k) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  return static_cast<int>((values.array() > 1e-10 * values.maxCoeff()).count());
}

// Oracle: the definition of the local axes in the header.
TEST(BeamAxes, DefaultIsGlobalZAndGlobalXForVerticalBeams) {
  EXPECT_TRUE(beam_axes(along_x(3.0)).isApprox(Eigen::Matrix3d::Identity()));
  BeamGeometry mast;
  mast.node_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 0.0, 5.0)};
  Eigen::Matrix3d expected;
  expected << 0, 0, 1, 0, 1, 0, 1, 0, 0;  // z = X, y = z × x = X × Z = -Y
  expected.row(1) = -expected.row(1);
  EXPECT_TRUE(beam_axes(mast).isApprox(expected));
  const Eigen::Matrix3d r = beam_axes(skewed());
  EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(r.determinant(), 1.0, 1e-14);
  EXPECT_NEAR(r.row(1).dot(skewed().orientation), 0.0, 1e-14);  // orientation lies in the local x-z plane
  EXPECT_GT(r.row(2).dot(skewed().orientation), 0.0);
}

// Oracle: the contract on bad input.
TEST(BeamAxes, RefusesNoLengthAndOrientationAlongTheAxis) {
  EXPECT_THROW((void)beam_length(along_x(0.0)), InputError);
  BeamGeometry g = along_x(1.0);
  g.orientation = Eigen::Vector3d(2.0, 0.0, 0.0);
  EXPECT_THROW((void)beam_axes(g), InputError);
}

// Oracle: Timoshenko cantilever under tip loads, w = P L³/(3 E I) + P L/(G A_s), θ = P L²/(2 E I); Hooke; St Venant.
TEST(Beam, CantileverTipWithShear) {
  const double length = 1.5, p = 1000.0;
  const BeamStiffnessProperties s = symmetric();
  const Matrix6 k = beam_stiffness(along_x(length), s).bottomRightCorner<6, 6>();
  const Eigen::Matrix<double, 6, 6> f = Eigen::MatrixXd(k).partialPivLu().inverse();
  const double e = s.youngs_modulus_Pa, g = s.shear_modulus_Pa;
  EXPECT_NEAR(p * f(2, 2) / (p * std::pow(length, 3) / (3 * e * s.inertia_y_m4) + p * length / (g * s.shear_area_z_m2)), 1.0,
              1e-10);
  EXPECT_NEAR(p * f(1, 1) / (p * std::pow(length, 3) / (3 * e * s.inertia_z_m4) + p * length / (g * s.shear_area_y_m2)), 1.0,
              1e-10);
  EXPECT_NEAR(f(4, 2) / (-length * length / (2 * e * s.inertia_y_m4)), 1.0, 1e-10);  // an upward load turns it about -y
  EXPECT_NEAR(f(5, 1) / (length * length / (2 * e * s.inertia_z_m4)), 1.0, 1e-10);
  EXPECT_NEAR(f(0, 0) / (length / (e * s.area_m2)), 1.0, 1e-10);
  EXPECT_NEAR(f(3, 3) / (length / (g * s.torsion_m4)), 1.0, 1e-10);
}

// Oracle: closed form of unsymmetric bending, deflection = L³/(3E) I⁻¹ P + L (G A_s)⁻¹ P with I = ∫ r rᵀ dA, in rotated axes.
TEST(Beam, UnsymmetricCantileverInGeneralDirection) {
  const BeamGeometry g = skewed();
  const BeamStiffnessProperties s = angle();
  const double length = beam_length(g);
  const Eigen::Matrix3d r = beam_axes(g);
  Vector12 load = Vector12::Zero();
  const Eigen::Vector2d p(700.0, -400.0);  // local y, z
  load.segment<3>(6) = r.row(1).transpose() * p.x() + r.row(2).transpose() * p.y();
  const Matrix6 k = beam_stiffness(g, s).bottomRightCorner<6, 6>();
  const Eigen::Matrix<double, 6, 1> u = Eigen::MatrixXd(k).ldlt().solve(Eigen::VectorXd(load.tail<6>()));
  Eigen::Matrix2d inertia;
  inertia << s.inertia_z_m4, s.inertia_yz_m4, s.inertia_yz_m4, s.inertia_y_m4;
  const Eigen::Vector2d shear(p.x() / s.shear_area_y_m2, p.y() / s.shear_area_z_m2);
  const Eigen::Vector2d expected =
      std::pow(length, 3) / (3 * s.youngs_modulus_Pa) * inertia.inverse() * p + length / s.shear_modulus_Pa * shear;
  const Eigen::Vector3d tip = r * u.head<3>();
  EXPECT_NEAR((tip.tail<2>() - expected).norm() / expected.norm(), 0.0, 1e-10);
  EXPECT_NEAR(tip.x() / expected.norm(), 0.0, 1e-10);
}

// Oracle: turning the section by an angle about its axis, with inertias by Mohr's circle, is the same beam as turning
// `orientation`.
TEST(Beam, ProductOfInertiaIsATurnedSection) {
  const double a = 0.4, c = std::cos(a), s = std::sin(a);
  BeamStiffnessProperties principal = symmetric();
  principal.shear_area_y_m2 = principal.shear_area_z_m2 = 2.0e-3;  // isotropic in shear, else the shear area turns too
  BeamGeometry turned = along_x(1.3);
  turned.orientation = Eigen::Vector3d(0.0, -s, c);  // z' at angle a from z; y' = (0, c, s)
  BeamStiffnessProperties mixed = principal;
  // ∫ r rᵀ in the axes of the beam with default orientation: r = Q r', columns of Q are y' and z'.
  Eigen::Matrix2d q, i;
  q << c, -s, s, c;
  i << principal.inertia_z_m4, 0.0, 0.0, principal.inertia_y_m4;
  i = (q * i * q.transpose()).eval();
  mixed.inertia_z_m4 = i(0, 0);
  mixed.inertia_yz_m4 = i(0, 1);
  mixed.inertia_y_m4 = i(1, 1);
  const Matrix12 expected = beam_stiffness(turned, principal);
  EXPECT_NEAR((beam_stiffness(along_x(1.3), mixed) - expected).norm() / expected.norm(), 0.0, 1e-12);
  const Matrix12 mass = beam_mass(turned, principal, 7850.0, true);
  EXPECT_NEAR((beam_mass(along_x(1.3), mixed, 7850.0, true) - mass).norm() / mass.norm(), 0.0, 1e-12);
}

// Oracle: six rigid motions without energy, rank 6, no negative eigenvalue (property), with and without offsets.
TEST(Beam, RigidMotionsHaveNoEnergy) {
  BeamGeometry g = skewed();
  for (const bool offsets : {false, true}) {
    if (offsets) g.offset_m = {Eigen::Vector3d(0.1, 0.2, -0.3), Eigen::Vector3d(-0.2, 0.1, 0.25)};
    const Matrix12 k = beam_stiffness(g, angle());
    EXPECT_NEAR((k - k.transpose()).norm(), 0.0, 1e-9);
    for (int d = 0; d < 6; ++d) EXPECT_NEAR((k * rigid_motion(g, d)).norm() / k.norm(), 0.0, 1e-13) << "motion " << d;
    EXPECT_EQ(beam_rank(k), 6);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().minCoeff(), -1e-10 * k.norm());
  }
}

// Oracle: propped cantilever, tip rotation free: k = 3 E I/L³ (Euler); both ends released about y and z: no bending at all.
TEST(Beam, ReleasesArePins) {
  BeamStiffnessProperties s = symmetric();
  s.shear_area_y_m2 = s.shear_area_z_m2 = 0.0;
  BeamGeometry g = along_x(2.0);
  g.releases = 1U << 10;  // ry of end 2
  Matrix12 k = beam_stiffness(g, s);
  EXPECT_NEAR(k(2, 2) / (3 * s.youngs_modulus_Pa * s.inertia_y_m4 / 8.0), 1.0, 1e-12);
  EXPECT_NEAR(k(4, 4) / (3 * s.youngs_modulus_Pa * s.inertia_y_m4 / 2.0), 1.0, 1e-12);
  EXPECT_NEAR(k.row(10).norm(), 0.0, 1e-6);
  EXPECT_NEAR(k(1, 1) / (12 * s.youngs_modulus_Pa * s.inertia_z_m4 / 8.0), 1.0, 1e-12);  // the other plane is untouched
  g.releases = 1U << 4 | 1U << 5 | 1U << 10 | 1U << 11 | 1U << 9;
  k = beam_stiffness(g, s);
  Matrix6 expected = bar_stiffness(g.node_m, s.youngs_modulus_Pa, s.area_m2);
  Matrix6 translations;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) translations(i, j) = k(i + 3 * (i / 3), j + 3 * (j / 3));
  EXPECT_NEAR((translations - expected).norm() / expected.norm(), 0.0, 1e-13);
  EXPECT_EQ(beam_rank(k), 1);
}

// Oracle: a pinned beam keeps its whole mass when it moves as a rigid body, and its released rotations carry none.
TEST(Beam, ReleasedBeamKeepsItsMass) {
  BeamGeometry g = skewed();
  g.releases = 1U << 4 | 1U << 5 | 1U << 10 | 1U << 11;
  const double mass = 7850.0 * 4.0e-3 * beam_length(g);
  const Matrix12 m = beam_mass(g, symmetric(), 7850.0, false);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(rigid_motion(g, d).dot(m * rigid_motion(g, d)) / mass, 1.0, 1e-12);
  const Eigen::Matrix3d axes = beam_axes(g);
  for (const int row : {1, 2}) {
    Vector12 turn = Vector12::Zero();
    turn.segment<3>(3) = axes.row(row);  // about local y, z: both released at end 1
    EXPECT_NEAR((m * turn).norm() / mass, 0.0, 1e-12);
  }
}

// Oracle: hand-written rigid link u_end = u_node + θ × r applied to the matrices of the beam between the ends.
TEST(Beam, OffsetsAreRigidLinks) {
  BeamGeometry g = skewed();
  const BeamGeometry bare = [&] {
    BeamGeometry ends = g;
    ends.node_m = {g.node_m[0] + Eigen::Vector3d(0.1, 0.2, -0.3), g.node_m[1] + Eigen::Vector3d(0.0, -0.4, 0.2)};
    return ends;
  }();
  g.offset_m = {Eigen::Vector3d(0.1, 0.2, -0.3), Eigen::Vector3d(0.0, -0.4, 0.2)};
  Matrix12 t = Matrix12::Identity();
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& r = g.offset_m[static_cast<std::size_t>(end)];
    for (int axis = 0; axis < 3; ++axis) t.block<3, 1>(6 * end, 6 * end + 3 + axis) = Eigen::Vector3d::Unit(axis).cross(r);
  }
  const auto same = [&t](const Matrix12& offset, const Matrix12& plain) {
    const Matrix12 expected = t.transpose() * plain * t;
    EXPECT_NEAR((offset - expected).norm() / expected.norm(), 0.0, 1e-13);
  };
  same(beam_stiffness(g, angle()), beam_stiffness(bare, angle()));
  same(beam_mass(g, angle(), 7850.0, true), beam_mass(bare, angle(), 7850.0, true));
  same(beam_geometric_stiffness(g, 5e3), beam_geometric_stiffness(bare, 5e3));
}

// Oracle: Newton: uᵀ M u of rigid motions is the mass, and the inertia of the straight rod about its centre, ρ A L³/12 across
// it plus the section's ρ I L (rotary), ρ (Iy + Iz) L about its axis.
TEST(Beam, MassAndInertiaOfRigidMotion) {
  const double length = 2.0, rho = 7850.0;
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d(-1.0, 0.0, 0.0), Eigen::Vector3d(1.0, 0.0, 0.0)};
  for (const BeamStiffnessProperties& s : {symmetric(), angle()}) {
    const Matrix12 m = beam_mass(g, s, rho, true), without = beam_mass(g, s, rho, false);
    const auto energy = [&g](const Matrix12& mass, int d) { return rigid_motion(g, d).dot(mass * rigid_motion(g, d)); };
    const double total = rho * s.area_m2 * length, rod = total * length * length / 12.0;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(energy(m, d) / total, 1.0, 1e-12);
    EXPECT_NEAR(energy(m, 3) / (rho * length * (s.inertia_y_m4 + s.inertia_z_m4)), 1.0, 1e-12);
    EXPECT_NEAR(energy(m, 4) / (rod + rho * length * s.inertia_y_m4), 1.0, 1e-12);
    EXPECT_NEAR(energy(m, 5) / (rod + rho * length * s.inertia_z_m4), 1.0, 1e-12);
    EXPECT_NEAR(energy(without, 4) / rod, 1.0, 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().minCoeff(), 0.0);
  }
}

// Oracle: Przemieniecki (1968) table 11.1, entries of the Euler beam without rotary inertia: 13/35, 11 L/210, 9/70, L²/105.
TEST(Beam, EulerMassEntries) {
  BeamStiffnessProperties s = symmetric();
  s.shear_area_y_m2 = s.shear_area_z_m2 = 0.0;
  const double length = 2.0, total = 7850.0 * s.area_m2 * length;
  const Matrix12 m = beam_mass(along_x(length), s, 7850.0, false) / total;
  EXPECT_NEAR(m(1, 1), 13.0 / 35.0, 1e-13);
  EXPECT_NEAR(m(1, 5), 11.0 * length / 210.0, 1e-13);
  EXPECT_NEAR(m(2, 4), -11.0 * length / 210.0, 1e-13);
  EXPECT_NEAR(m(2, 8), 9.0 / 70.0, 1e-13);
  EXPECT_NEAR(m(1, 11), -13.0 * length / 420.0, 1e-13);
  EXPECT_NEAR(m(5, 5), length * length / 105.0, 1e-13);
}

// Oracle: Przemieniecki (1968) section 15.2, N/L · (6/5, L/10, 2L²/15, -L²/30); a rigid turn by θ does work N θ² L (chord).
TEST(Beam, GeometricStiffnessEntries) {
  const double length = 2.5, n = 3.0e4;
  const Matrix12 k = beam_geometric_stiffness(along_x(length), n) * length / n;
  EXPECT_NEAR(k(1, 1), 1.2, 1e-13);
  EXPECT_NEAR(k(1, 5), length / 10.0, 1e-13);
  EXPECT_NEAR(k(2, 4), -length / 10.0, 1e-13);
  EXPECT_NEAR(k(5, 5), 2.0 * length * length / 15.0, 1e-13);
  EXPECT_NEAR(k(5, 11), -length * length / 30.0, 1e-13);
  const BeamGeometry g = skewed();
  const Vector12 turn = rigid_motion(g, 3);
  const Eigen::Vector3d chord = g.node_m[1] - g.node_m[0];
  const Eigen::Vector3d rise = Eigen::Vector3d::UnitX().cross(chord);  // across the chord by construction
  EXPECT_NEAR(turn.dot(beam_geometric_stiffness(g, n) * turn) / (n * rise.squaredNorm() / chord.norm()), 1.0, 1e-12);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR((beam_geometric_stiffness(g, n) * rigid_motion(g, d)).norm() / n, 0.0, 1e-13);
}

// Oracle: a pinned (all bending releases) member under tension is a string.
TEST(Beam, GeometricStiffnessOfPinnedMemberIsAString) {
  BeamGeometry g = along_x(2.0);
  g.releases = 1U << 4 | 1U << 5 | 1U << 10 | 1U << 11;
  const Matrix12 k = beam_geometric_stiffness(g, 100.0);
  EXPECT_NEAR(k(2, 2), 50.0, 1e-10);
  EXPECT_NEAR(k(2, 8), -50.0, 1e-10);
  EXPECT_NEAR(k(4, 4), 0.0, 1e-10);
}

// Oracle: Hooke on the chord; a rigid motion gives no force; a released end carries none.
TEST(Beam, AxialForce) {
  BeamGeometry g = skewed();
  const BeamStiffnessProperties s = angle();
  const Eigen::Vector3d n = beam_axes(g).row(0);
  Vector12 u = Vector12::Zero();
  u.segment<3>(6) = 1e-3 * n;
  const double expected = s.youngs_modulus_Pa * s.area_m2 * 1e-3 / beam_length(g);
  EXPECT_NEAR(beam_axial_force(g, s, u) / expected, 1.0, 1e-12);
  for (int d = 0; d < 6; ++d) EXPECT_NEAR(beam_axial_force(g, s, rigid_motion(g, d)) / expected, 0.0, 1e-9);
  g.releases = 1U << 6;
  EXPECT_NEAR(beam_axial_force(g, s, u), 0.0, 1e-6);
}

}  // namespace
}  // namespace twindeck::fe
