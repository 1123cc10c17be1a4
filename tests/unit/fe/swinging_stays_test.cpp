// Oracles: the taut string between fixed ends, f_n = n/(2 L) sqrt(T/m); a string with an end that moves on a spring and a mass,
// k - w² M + T kappa cot(kappa L) = 0; Irvine's first symmetric frequency; statics without the cable.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/cable.hpp"

namespace twindeck::fe {
namespace {

constexpr int pieces = 6;
constexpr double pi = std::numbers::pi;

/// A level stay of 80 m and 20 kg/m under 300 kN between fixed ends.
struct LevelStay {
  Model model;
  PrestressState state;
  double length = 80.0, mass = 20.0, stiffness_N = 165e9 * 20.0 / 8000.0, force = 3e5;

  explicit LevelStay(double gravity) {
    model.source = "one_stay";
    model.gravity_m_s2 = gravity;
    model.materials.push_back({"rope", 165e9, 60e9, 0.3, 8000.0});
    Section section;
    section.name = "rope";
    section.area_m2 = mass / 8000.0;
    model.sections.push_back(section);
    test::add_node(model, 0, 0, 0);
    test::add_node(model, length, 0, 0);
    test::add_element(model, ElementType::stay, "stay", 0, 0, {0, 1}).name = "NE8";
    test::fix(model, 0);
  }
  /// The model with the cable, and the same pull in its stay.
  [[nodiscard]] ParametricSystem with_cable(int so_many = pieces) {
    model = with_swinging_stays(model, {{0, force}}, so_many);
    return as_it_is();
  }
  [[nodiscard]] ParametricSystem as_it_is() {
    state.stay_pull_N = Eigen::VectorXd::Constant(1, force);
    state.axial_force_N = Eigen::VectorXd::Zero(1);
    return assemble(model, state);
  }
};

/// Frequencies of the motion in one global direction, which a level stay without sag does not couple to others, ascending [Hz].
std::vector<double> frequencies(const ParametricSystem& system, int direction) {
  std::vector<int> dofs;
  for (std::size_t i = 0; i < system.dofs.size(); ++i)
    if (system.dofs[i].direction == direction) dofs.push_back(static_cast<int>(i));
  const Eigen::MatrixXd k = test::full(system.stiffness(Eigen::VectorXd(0)))(dofs, dofs),
                        m = test::full(system.mass(Eigen::VectorXd(0)))(dofs, dofs);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eig(k, m);
  std::vector<double> out;
  for (const double value : eig.eigenvalues()) out.push_back(std::sqrt(value) / (2.0 * pi));
  return out;
}

constexpr std::array<double, 3> kOff = {3e-4, 3e-3, 1.5e-2};  // of the string's first three frequencies, see below

// What six pieces with masses half lumped and half consistent leave of a string, phi = n pi / 6 a piece:
// w² = 2 T (1 - cos phi) / (l² m (1 - (1 - cos phi)/6)). It is 0.02, 0.3 and 1.4 % off the string itself.
TEST(SwingingStays, TautStringBetweenFixedEnds) {
  LevelStay stay(0.0);
  test::fix(stay.model, 1);
  const ParametricSystem system = stay.with_cable();
  const double first = std::sqrt(stay.force / stay.mass) / (2.0 * stay.length);
  for (const int direction : {1, 2}) {
    const std::vector<double> found = frequencies(system, direction);
    ASSERT_EQ(found.size(), pieces - 1U);
    for (int n = 1; n <= 3; ++n) {
      const double f = found[static_cast<std::size_t>(n - 1)];
      EXPECT_NEAR(f, n * first, kOff[static_cast<std::size_t>(n - 1)] * n * first) << n;
      const double share = 1.0 - std::cos(n * pi / pieces);
      EXPECT_NEAR(f, pieces / (pi)*std::sqrt(2.0 * share / (1.0 - share / 6.0)) * first, 1e-9 * f) << n;
    }
  }
}

/// A stay whose second end moves in z with a mass on a spring of 0.9 Hz; the string itself has 0.77 Hz.
struct MovingEnd : LevelStay {
  double end_mass = 2000.0, end_stiffness = end_mass * std::pow(2.0 * pi * 0.9, 2);
  MovingEnd() : LevelStay(0.0) {
    test::fix(model, 1, {true, true, false, true, true, true});
    model.masses.push_back({"deck", 1, end_mass, Eigen::Vector3d::Zero()});
    Spring spring;
    spring.name = spring.group = "deck";
    spring.node = 1;
    spring.stiffness = end_stiffness;
    model.springs.push_back(spring);
  }
};

// At a moving end the chain pulls back by (kappa l)²/12 too little, so that no frequency is more than half of that off, and a
// fourth with twice the pieces (a little less is asked for, since higher orders are in it).
TEST(SwingingStays, StringWithAnEndThatMoves) {
  const std::vector<double> coarse = frequencies(MovingEnd().with_cable(), 2),
                            fine = frequencies(MovingEnd().with_cable(2 * pieces), 2);
  const MovingEnd stay;
  const double c = std::sqrt(stay.force / stay.mass);
  for (std::size_t n = 0; n < 3; ++n) {  // one root between any two frequencies of the string with fixed ends
    const double from = static_cast<double>(n) * pi * c / stay.length;
    double low = from + 1e-9, high = from + pi * c / stay.length - 1e-9;
    for (int i = 0; i < 200; ++i) {
      const double w = 0.5 * (low + high);
      const double value = stay.end_stiffness - w * w * stay.end_mass + stay.force * w / c / std::tan(w / c * stay.length);
      (value > 0.0 ? low : high) = w;
    }
    const double f = low / (2.0 * pi), error = std::abs(coarse[n] / f - 1.0);
    EXPECT_LT(error, std::pow(low / c * stay.length / pieces, 2) / 24.0) << n;
    EXPECT_LT(std::abs(fine[n] / f - 1.0), error / 3.5) << n;
  }
}

TEST(SwingingStays, StaticsAndTotalMassStay) {
  LevelStay stay(9.81);
  test::fix(stay.model, 1, {false, false, false, true, true, true});
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    Spring hold;
    hold.name = hold.group = "hold";
    hold.node = 1;
    hold.direction = d;
    hold.stiffness = 1e4;
    stay.model.springs.push_back(hold);
  }
  const Eigen::VectorXd theta(0);
  const Eigen::Matrix3d bar = test::full(stay.as_it_is().stiffness(theta));
  const ParametricSystem system = stay.with_cable();
  const Eigen::MatrixXd k = test::full(system.stiffness(theta));
  const Eigen::Matrix3d held = k.ldlt().solve(Eigen::MatrixXd::Identity(k.rows(), 3)).topRows(3).inverse();
  EXPECT_LT((held - bar).norm(), 1e-9 * bar.norm());
  double mass = 0.0;
  const Eigen::MatrixXd m = test::full(system.mass(theta));
  Eigen::VectorXd up = Eigen::VectorXd::Zero(m.rows());
  for (std::size_t i = 0; i < system.dofs.size(); ++i) up[static_cast<Eigen::Index>(i)] = system.dofs[i].direction == 2;
  mass = up.dot(m * up);
  // The fixed end keeps what of the chain stands on it: its share of the first piece.
  EXPECT_LT(mass, stay.mass * stay.length);
  EXPECT_GT(mass, (1.0 - 0.6 / pieces) * stay.mass * stay.length);
  EXPECT_EQ(stay.model.elements.size(), 1U);
  EXPECT_EQ(stay.model.nodes.back().id, 1000000 + pieces - 2);
}

TEST(SwingingStays, SagLiftsTheFirstModeAsIrvineSays) {
  const LevelStay stay(9.81);
  const Cable cable = cable_beyond_bar(stay.model, stay.model.elements[0], stay.force, pieces);
  const Eigen::VectorXd found = in_plane_frequencies(stay.model, stay.model.elements[0], cable);
  const double slope = stay.mass * 9.81 * stay.length / stay.force;
  const double lambda_squared = slope * slope * stay.stiffness_N / (stay.force * (1 + slope * slope / 8));
  ASSERT_GT(lambda_squared, 3.0);
  double low = pi, high = 2 * pi;
  for (int i = 0; i < 200; ++i) {  // tan(w/2) = w/2 - (4/lambda²)(w/2)³
    const double w = 0.5 * (low + high);
    const auto f = [&](double x) {
      return std::sin(x / 2) - (x / 2 - 4 / lambda_squared * std::pow(x / 2, 3)) * std::cos(x / 2);
    };
    (f(low) * f(w) <= 0.0 ? high : low) = w;
  }
  const double c = std::sqrt(stay.force / stay.mass) / (2.0 * stay.length), irvine = low / pi * c;
  EXPECT_GT(irvine, 1.1 * c);
  EXPECT_NEAR(found[0], irvine, 0.015 * irvine);  // a polygon of six pieces for the parabola
  EXPECT_NEAR(found[1], 2.0 * c, 0.01 * c);
  // A force is found again from what such a stay shows; within 3 % from Irvine's own frequencies.
  const std::vector<StayHarmonic> irvines = {{1, irvine, 0.005}, {2, 2.0 * c, 0.005}, {9, 1.0, 0.005}};
  EXPECT_NEAR(force_of_harmonics(stay.model, stay.model.elements[0], irvines, pieces), stay.force, 0.03 * stay.force);
  const std::vector<StayHarmonic> own = {{1, found[0], 0.005}, {2, found[1], 0.005}};
  EXPECT_NEAR(force_of_harmonics(stay.model, stay.model.elements[0], own, pieces), stay.force, 1e-6 * stay.force);
  EXPECT_EQ(force_of_harmonics(stay.model, stay.model.elements[0], {{9, 7.0, 0.01}}, pieces), 0.0);
}

TEST(SwingingStays, AStayWithoutForceIsRefused) {
  const LevelStay stay(9.81);
  EXPECT_THROW((void)with_swinging_stays(stay.model, {{0, 0.0}}, pieces), InputError);
}

}  // namespace
}  // namespace twindeck::fe
