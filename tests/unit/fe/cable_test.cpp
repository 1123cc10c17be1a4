// Oracles: the parabola of a hanging cable, the taut string, Irvine's equation of a shallow cable, and weighted means by hand.
#include "fe/cable.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"

namespace twindeck::fe {
namespace {

/// A stay of 20 kg/m (8000 kg/m3, 0.0025 m2) between two points; gravity is 10 m/s2.
Model cable_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double gravity = 10.0) {
  Model model;
  model.gravity_m_s2 = gravity;
  model.materials.push_back({"rope", 160e9, 60e9, 0.3, 8000.0});
  Section section;
  section.area_m2 = 0.0025;
  model.sections.push_back(section);
  test::add_node(model, from.x(), from.y(), from.z());
  test::add_node(model, to.x(), to.y(), to.z());
  test::add_element(model, ElementType::stay, "stay", 0, 0, {0, 1}).name = "NE8";
  return model;
}

Model level_cable(double gravity = 10.0) { return cable_between({0.0, 0.0, 5.0}, {100.0, 0.0, 5.0}, gravity); }

Cable cable_of(const Model& model, double force_N, int pieces) {
  return cable_beyond_bar(model, model.elements[0], force_N, pieces);
}

double taut_string_Hz(double length_m, double force_N, int n) { return n / (2.0 * length_m) * std::sqrt(force_N / 20.0); }

// Oracle: sag m g L²/(8 T) = 20·10·1e4/8e6 = 0.25 m; 4 xi (1 - xi) of it elsewhere.
TEST(Cable, LevelChainHangsInItsParabola) {
  const Cable cable = cable_of(level_cable(), 1e6, 4);
  ASSERT_EQ(cable.inner_x_m.size(), 3U);
  EXPECT_LT((cable.inner_x_m[0] - Eigen::Vector3d(25.0, 0.0, 5.0 - 0.1875)).norm(), 1e-12);
  EXPECT_LT((cable.inner_x_m[1] - Eigen::Vector3d(50.0, 0.0, 4.75)).norm(), 1e-12);
  EXPECT_LT((cable.inner_x_m[2] - Eigen::Vector3d(75.0, 0.0, 5.0 - 0.1875)).norm(), 1e-12);
}

// Oracle: balance of half of a 3-4-5 cable, L = 50 m, l = 30 m: vertical sag = (m g L) l/(8 H) with H = T l/L, so m g L²/(8 T).
TEST(Cable, InclinedChainHasTheVerticalSagOfItsChord) {
  const Cable cable = cable_of(cable_between({1.0, 2.0, 3.0}, {1.0, 32.0, 43.0}), 2.5e5, 2);
  const double sag = 20.0 * 10.0 * 2500.0 / (8.0 * 2.5e5);
  EXPECT_LT((cable.inner_x_m[0] - Eigen::Vector3d(1.0, 17.0, 23.0 - sag)).norm(), 1e-12);
}

// Oracle: statics. The chain and the bar agree at the ends, so nothing is left there once the inner nodes follow; nodes that
// move alike meet no force.
TEST(Cable, AddsNoStaticStiffnessAtTheEnds) {
  const Cable cable = cable_of(cable_between({0.0, 0.0, 0.0}, {60.0, 10.0, 40.0}), 4e5, 5);
  const Eigen::MatrixXd& k = cable.stiffness;
  ASSERT_EQ(k.rows(), 18);
  EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
  const Eigen::MatrixXd inner = k.bottomRightCorner(12, 12), coupling = k.bottomLeftCorner(12, 6);
  const Eigen::MatrixXd left = k.topLeftCorner(6, 6) - coupling.transpose() * inner.fullPivLu().solve(coupling);
  EXPECT_LT(left.norm(), 1e-9 * k.norm());  // the chain's condition is some 1e4
  for (int d = 0; d < 3; ++d) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(18);
    for (int node = 0; node < 6; ++node) u[3 * node + d] = 1.0;
    EXPECT_LT((k * u).norm(), 1e-9 * k.norm()) << d;
  }
}

// Oracle: two straight pieces of sqrt((L/2)² + sag²) at 20 kg/m, less the bar's 20 L, in every direction.
TEST(Cable, MassIsThatOfTheChainLessTheBar) {
  const Cable cable = cable_of(level_cable(), 1e5, 2);  // sag 2.5 m
  const double expected = 20.0 * (2.0 * std::hypot(50.0, 2.5) - 100.0);
  for (int d = 0; d < 3; ++d) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(9);
    for (int node = 0; node < 3; ++node) u[3 * node + d] = 1.0;
    EXPECT_NEAR(u.dot(cable.mass * u), expected, 1e-9) << d;
  }
}

// Oracle: taut string n/(2 L) sqrt(T/m). Forty pieces err by (n pi/40)⁴/240, below 1e-5 for n = 3.
TEST(Cable, WeightlessCableIsATautString) {
  const Model model = level_cable(0.0);
  const Eigen::VectorXd f = in_plane_frequencies(model, model.elements[0], cable_of(model, 1e6, 40));
  ASSERT_EQ(f.size(), 20);
  for (int n = 1; n <= 3; ++n) EXPECT_NEAR(f[n - 1] / taut_string_Hz(100.0, 1e6, n), 1.0, 1e-5) << n;
}

// Oracle: a vertical cable has no component of weight across it: the taut string again. Uneven pieces cost some 1e-5.
TEST(Cable, VerticalCableIsATautString) {
  for (const double top : {50.0, -50.0}) {
    const Model model = cable_between({0.0, 0.0, 0.0}, {0.0, 0.0, top});
    const Eigen::VectorXd f = in_plane_frequencies(model, model.elements[0], cable_of(model, 1e6, 40));
    for (int n = 1; n <= 3; ++n) EXPECT_NEAR(f[n - 1] / taut_string_Hz(50.0, 1e6, n), 1.0, 1e-4) << n;
  }
}

/// First symmetric in-plane frequency over the string's: Omega/pi with tan(Omega/2) = Omega/2 - 4/lambda² (Omega/2)³.
double irvine_ratio(double lambda2) {
  double low = 0.5 * std::numbers::pi + 1e-12, high = 1.5 * std::numbers::pi - 1e-12;  // of Omega/2
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 * (low + high);
    (std::tan(x) - x + 4.0 / lambda2 * x * x * x < 0.0 ? low : high) = x;
  }
  return 2.0 * low / std::numbers::pi;
}

// Oracle: Irvine (1981), chapter 3, for a cable inclined by cos = 0.8: lambda² = (m g L cos/T)² E A/T. Terms of (m g L/T)² are
// left out there, some 1e-3 here.
TEST(Cable, SagRaisesTheSymmetricFrequencyAsIrvineSays) {
  const double force = 6e5, length = 200.0, weight = 20.0 * 10.0 * length * 0.8;
  const Model model = cable_between({0.0, 0.0, 0.0}, {160.0, 0.0, 120.0});
  const double lambda2 = std::pow(weight / force, 2) * 160e9 * 0.0025 / force;
  ASSERT_GT(lambda2, 1.0);
  const Eigen::VectorXd f = in_plane_frequencies(model, model.elements[0], cable_of(model, force, 40));
  EXPECT_GT(irvine_ratio(lambda2), 1.05);
  EXPECT_NEAR(f[0] / taut_string_Hz(length, force, 1), irvine_ratio(lambda2), 3e-3);
  EXPECT_NEAR(f[1] / taut_string_Hz(length, force, 2), 1.0, 3e-3);
}

// Oracle: the inverse of the taut string, T = m (2 L f_n/n)². Harmonics of unlike forces give the mean of log T with weights
// 1/std². Sixteen pieces err by (2 pi/16)⁴/240 = 1e-4 in frequency, twice that in force.
TEST(Cable, ForceIsTheWeightedMeanOfTheHarmonics) {
  const Model model = level_cable(0.0);
  const Element& stay = model.elements[0];
  const double force =
      force_of_harmonics(model, stay, {{1, taut_string_Hz(100.0, 1e6, 1), 0.01}, {2, taut_string_Hz(100.0, 1e6, 2), 0.02}}, 16);
  EXPECT_NEAR(force / 1e6, 1.0, 1e-3);
  const double mixed = force_of_harmonics(
      model, stay, {{1, taut_string_Hz(100.0, 1.1e6, 1), 0.01}, {2, taut_string_Hz(100.0, 1e6, 2), 0.02}}, 16);
  EXPECT_NEAR(mixed / (1e6 * std::pow(1.1, 0.8)), 1.0, 1e-3);
}

// Oracle: Irvine's frequencies of a sagging cable go in, the force comes out. T errs by twice what the frequency does (3e-3).
TEST(Cable, ForceOfASaggingCableAllowsForItsSag) {
  const double force = 6e5, length = 200.0;
  const double lambda2 = std::pow(20.0 * 10.0 * length * 0.8 / force, 2) * 160e9 * 0.0025 / force;
  const Model model = cable_between({0.0, 0.0, 0.0}, {160.0, 0.0, 120.0});
  const double first = irvine_ratio(lambda2) * taut_string_Hz(length, force, 1);
  const double second = taut_string_Hz(length, force, 2);
  EXPECT_NEAR(force_of_harmonics(model, model.elements[0], {{1, first, 0.01}, {2, second, 0.01}}, 16) / force, 1.0, 1e-2);
}

// Oracle: the header: harmonics beyond pieces / 2 are not used, and 0 says that none is left.
TEST(Cable, HarmonicsThatThePiecesDoNotShowAreLeftOut) {
  const Model model = level_cable(0.0);
  EXPECT_EQ(force_of_harmonics(model, model.elements[0], {}, 6), 0.0);
  EXPECT_EQ(force_of_harmonics(model, model.elements[0], {{4, 3.0, 0.01}}, 6), 0.0);
  const double with = force_of_harmonics(model, model.elements[0], {{1, 1.0, 0.01}, {4, 77.0, 0.01}}, 6);
  EXPECT_DOUBLE_EQ(with, force_of_harmonics(model, model.elements[0], {{1, 1.0, 0.01}}, 6));
}

// Oracle: the contract.
TEST(Cable, RefusesAStayWithoutAForce) {
  for (const double force : {0.0, -1e3, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)cable_of(level_cable(), force, 4), InputError) << force;
  EXPECT_THROW((void)cable_of(level_cable(), 1e6, 1), InternalError);
}

// Oracle: the cable's own frequencies go in, its force comes out, for slack cables (lambda² up to 34) too.
TEST(Cable, TwoHarmonicsFindTheForceOfASlackCable) {
  const Model model = cable_between({0.0, 0.0, 0.0}, {300.0, 0.0, 0.0});
  for (const double force : {3.5e5, 4e5, 5e5, 8e5}) {
    const Eigen::VectorXd f = in_plane_frequencies(model, model.elements[0], cable_of(model, force, 12));
    EXPECT_NEAR(force_of_harmonics(model, model.elements[0], {{1, f[0], 0.01}, {2, f[1], 0.01}}, 12) / force, 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace twindeck::fe
