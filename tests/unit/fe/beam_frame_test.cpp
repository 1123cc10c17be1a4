// Oracles: the definitions of the axes, Hermite's cubics, derivatives by differences, balance of bending and shear.
#include "fe/beam_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace twindeck::fe {
namespace {

constexpr double kFrame_m = 3.0;

Eigen::Matrix2d shear_of_two_planes() {
  Eigen::Matrix2d phi;
  phi << 0.8, 0.3, 0.2, 1.7;
  return phi;
}

BeamGeometry from_origin_to(const Eigen::Vector3d& end) {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d::Zero(), end};
  return g;
}

// Oracle: S(a) b = a × b.
TEST(BeamFrame, CrossMatrixIsTheCrossProduct) {
  const Eigen::Vector3d a(1.0, -2.0, 3.0), b(0.5, 4.0, -1.0);
  EXPECT_LT((beam::cross_matrix(a) * b - a.cross(b)).norm(), 1e-15);
}

// Oracle: the header. Vertical beams up and down have z = X; one that is 1e-5 off the vertical has global Z as its reference.
TEST(BeamFrame, VerticalBeamsTakeGlobalX) {
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Matrix3d r = beam_axes(from_origin_to({0.0, 0.0, sign * 4.0}));
    EXPECT_LT((r.row(2).transpose() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
    EXPECT_LT((r.row(1).transpose() - sign * -Eigen::Vector3d::UnitY()).norm(), 1e-15);  // y = z × x
    EXPECT_NEAR(r.determinant(), 1.0, 1e-15);
  }
  const Eigen::Matrix3d near = beam_axes(from_origin_to({0.5e-6, 0.0, 1.0})), off = beam_axes(from_origin_to({1e-5, 0.0, 1.0}));
  EXPECT_NEAR(near(2, 0), 1.0, 1e-9);
  EXPECT_NEAR(off(2, 0), -1.0, 1e-9);  // Z less its part along the axis points to -X
}

// Oracle: a rigid turn θ moves an end at node + offset by θ × (x + offset), in local axes.
TEST(BeamFrame, EndsRideOnTheirNodes) {
  BeamGeometry g = from_origin_to({1.0, 2.0, 2.0});
  g.offset_m = {Eigen::Vector3d(0.1, 0.2, -0.3), Eigen::Vector3d(-0.2, 0.1, 0.4)};
  const Eigen::Vector3d turn(0.3, -0.7, 0.5);
  Vector12 u;
  for (int i = 0; i < 2; ++i) {
    u.segment<3>(6 * i) = turn.cross(g.node_m[static_cast<std::size_t>(i)]);
    u.segment<3>(6 * i + 3) = turn;
  }
  const Vector12 ends = beam::end_displacements(g) * u;
  const Eigen::Matrix3d r = beam_axes(g);
  for (int i = 0; i < 2; ++i) {
    const auto end = static_cast<std::size_t>(i);
    EXPECT_LT((ends.segment<3>(6 * i) - r * turn.cross(g.node_m[end] + g.offset_m[end])).norm(), 1e-14);
    EXPECT_LT((ends.segment<3>(6 * i + 3) - r * turn).norm(), 1e-14);
  }
  EXPECT_NEAR(beam_length(g), (Eigen::Vector3d(1.0, 2.0, 2.0) + g.offset_m[1] - g.offset_m[0]).norm(), 1e-15);
}

// Oracle: Hermite's cubics at ξ = 1/4: 27/32, 9/64 L, 5/32, -3/64 L. The slope in the x-z plane is -ry.
TEST(BeamFrame, ShapesWithoutShearAreHermites) {
  const beam::Shape shape = beam::shape_at(0.25, kFrame_m, Eigen::Matrix2d::Zero());
  beam::Matrix2x12 expected = beam::Matrix2x12::Zero();
  expected(0, 1) = expected(1, 2) = 27.0 / 32.0;
  expected(0, 5) = 9.0 / 64.0 * kFrame_m;
  expected(1, 4) = -9.0 / 64.0 * kFrame_m;
  expected(0, 7) = expected(1, 8) = 5.0 / 32.0;
  expected(0, 11) = -3.0 / 64.0 * kFrame_m;
  expected(1, 10) = 3.0 / 64.0 * kFrame_m;
  EXPECT_LT((shape.deflection - expected).norm(), 1e-14);
  EXPECT_LT((shape.section_slope - shape.deflection_slope).norm(), 1e-14);
}

// Oracle: the shapes take the displacements of the ends, and their slope is the derivative (central differences of a cubic err
// by h² = 1e-8 of its third derivative).
TEST(BeamFrame, ShapesMeetTheEndsAndTheirSlopes) {
  const Eigen::Matrix2d phi = shear_of_two_planes();
  for (int end = 0; end < 2; ++end) {
    const beam::Shape at = beam::shape_at(end, kFrame_m, phi);
    EXPECT_LT((at.deflection - beam::deflection_of(end)).norm(), 1e-14);
    EXPECT_LT((at.section_slope - beam::slope_of(end)).norm(), 1e-14);
  }
  const double h = 1e-4, xi = 0.37;
  const beam::Matrix2x12 difference =
      (beam::shape_at(xi + h, kFrame_m, phi).deflection - beam::shape_at(xi - h, kFrame_m, phi).deflection) /
      (2.0 * h * kFrame_m);
  EXPECT_LT((difference - beam::shape_at(xi, kFrame_m, phi).deflection_slope).norm(), 1e-6);
}

// Oracle: balance V = -dM/dx gives γ = w' - ψ = -Φ L²/12 ψ'' in each plane (ψ is a parabola: exact second
// differences).
TEST(BeamFrame, ShearStrainBalancesTheMoment) {
  const Eigen::Matrix2d phi = Eigen::Vector2d(0.8, 1.7).asDiagonal();
  const double h = 0.25;
  const auto at = [&](double xi) { return beam::shape_at(xi, kFrame_m, phi); };
  const beam::Matrix2x12 second =
      (at(0.5 + h).section_slope - 2.0 * at(0.5).section_slope + at(0.5 - h).section_slope) / std::pow(h * kFrame_m, 2);
  for (const double xi : {0.1, 0.9}) {
    const beam::Matrix2x12 strain = at(xi).deflection_slope - at(xi).section_slope;
    EXPECT_LT((strain + kFrame_m * kFrame_m / 12.0 * phi * second).norm(), 1e-13);
  }
}

// Oracle: Φ = 12 E I/(G A_s L²) of each plane, A_y with I_z; zero for a shear area of 0.
TEST(BeamFrame, ShearParameterPairsAreasAndMoments) {
  BeamStiffnessProperties s{200e9, 80e9, 0.01, 4e-5, 1e-5, 0.0, 3e-5, 0.006, 0.0};
  Eigen::Matrix2d phi = beam::shear_parameter(s, kFrame_m);
  EXPECT_NEAR(phi(0, 0), 12.0 * 200e9 * 1e-5 / (80e9 * 0.006 * 9.0), 1e-15);
  EXPECT_EQ(phi(1, 1), 0.0);
  s.shear_area_z_m2 = 0.005;
  phi = beam::shear_parameter(s, kFrame_m);
  EXPECT_NEAR(phi(1, 1), 12.0 * 200e9 * 4e-5 / (80e9 * 0.005 * 9.0), 1e-15);
}

// Oracle: integrals of ξ^p are 1/(p + 1), up to degree 7.
TEST(BeamFrame, GaussPointsAreExactToDegreeSeven) {
  for (int p = 0; p <= 7; ++p) {
    double sum = 0.0;
    for (const beam::GaussPoint& point : beam::gauss_points()) sum += point.weight * std::pow(point.xi, p);
    EXPECT_NEAR(sum, 1.0 / (p + 1), 1e-15) << p;
  }
}

// Oracle: the contract. Offsets may close a beam, and a coordinate may be no number.
TEST(BeamFrame, RefusesBeamsWithoutLengthOrAxes) {
  BeamGeometry g = from_origin_to({1.0, 0.0, 0.0});
  g.offset_m[1] = Eigen::Vector3d(-1.0, 0.0, 0.0);
  EXPECT_THROW((void)beam_length(g), InputError);
  EXPECT_THROW((void)beam_length(from_origin_to({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0})), InputError);
  EXPECT_THROW((void)beam_length(from_origin_to({std::numeric_limits<double>::infinity(), 0.0, 0.0})), InputError);
  g = from_origin_to({1.0, 1.0, 0.0});
  g.orientation = Eigen::Vector3d(-2.0, -2.0, 0.0);
  EXPECT_THROW((void)beam_axes(g), InputError);
}

}  // namespace
}  // namespace twindeck::fe
