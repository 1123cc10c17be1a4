// The blind trials' own frames. Oracles: closed forms of beams, cantilevers and shear buildings.
#include "blind/form/plane_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twindeck::blind::form {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBending = 7e9, kMass = 2000.0, kLength = 25.0;  // N m², kg/m, m

struct Line {
  PlaneFrame frame;
  std::vector<int> nodes;
};

/// A straight beam of equal parts along a direction, the first node at the origin.
Line line(int parts, BeamPart beam, const Eigen::Vector2d& along = {1.0, 0.0}) {
  Line out;
  for (int i = 0; i <= parts; ++i) out.nodes.push_back(out.frame.add_node(along * (kLength * i / parts)));
  for (int i = 0; i < parts; ++i) {
    beam.from = out.nodes[static_cast<std::size_t>(i)];
    beam.to = out.nodes[static_cast<std::size_t>(i) + 1];
    out.frame.add_beam(beam);
  }
  return out;
}

void fix(Line& line, int at, const std::vector<int>& directions) {
  const int node = at >= 0 ? line.nodes[static_cast<std::size_t>(at)] : line.nodes.back();
  for (const int d : directions) line.frame.fix(line.frame.unknown(node, d));
}

/// Modes that move across the axis, given how far apart axial ones lie: axial stiffness is high enough for none to be among
/// these.
constexpr double kAxial = 1e14;

TEST(PlaneFrame, SimplySupportedTimoshenkoBeam) {
  // EI k⁴ - m w² - (J + EI m / S) k² w² + (m J / S) w⁴ = 0, k = n pi / L (Timoshenko 1921).
  const double shear = 1.2e9, rotary = 450.0;
  const auto modes_of = [&](int parts) {
    Line beam = line(parts, {-1, -1, kAxial, kBending, shear, kMass, rotary});
    fix(beam, 0, {0, 1});
    fix(beam, -1, {1});
    return beam.frame.modes();
  };
  const FrameModes coarse = modes_of(40), fine = modes_of(80);
  for (int n = 1; n <= 6; ++n) {
    const double k2 = std::pow(n * kPi / kLength, 2), a = kMass * rotary / shear,
                 b = kMass + (rotary + kBending * kMass / shear) * k2, c = kBending * k2 * k2;
    const double omega2 = (b - std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    // Short elements are linear ones in shear: with their consistent mass w² is too high by (k h)²/12 at most, and the error
    // falls with h².
    const double of_fine = fine.omega2[n - 1] / omega2 - 1.0, of_coarse = coarse.omega2[n - 1] / omega2 - 1.0;
    EXPECT_GT(of_fine, 0.0) << n;
    EXPECT_LT(of_fine, k2 * std::pow(kLength / 80, 2) / 12.0) << n;
    EXPECT_NEAR((4.0 * of_fine - of_coarse) / 3.0, 0.0, 2e-4) << n;  // extrapolated to h = 0; what is left is of (k h)⁴
    EXPECT_LT(omega2, kBending * k2 * k2 / kMass) << n;
  }
}

TEST(PlaneFrame, CantileverInAnyDirection) {
  const double roots[] = {1.875104069, 4.694091133, 7.854757438, 10.99554073};
  for (const Eigen::Vector2d& along : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.6, 0.8)}) {
    Line beam = line(24, {-1, -1, kAxial, kBending, 0.0, kMass, 0.0}, along);
    fix(beam, 0, {0, 1, 2});
    const FrameModes modes = beam.frame.modes();
    for (int n = 0; n < 4; ++n)
      EXPECT_NEAR(std::sqrt(modes.omega2[n] / (kBending / kMass)) / std::pow(roots[n] / kLength, 2), 1.0, 1e-4) << n;
  }
}

TEST(PlaneFrame, ShearBuilding) {
  // Columns without mass between floors that cannot turn: w_k = 2 sqrt(k/m) sin((2k - 1) pi / (2 (2n + 1))).
  constexpr int kStoreys = 5;
  constexpr double kHeight = 3.5, kFloor = 40e3;
  PlaneFrame frame;
  std::vector<int> nodes;
  for (int s = 0; s <= kStoreys; ++s) {
    nodes.push_back(frame.add_node({0.0, s * kHeight}));
    frame.fix(frame.unknown(nodes.back(), 1));
    frame.fix(frame.unknown(nodes.back(), 2));
    if (s == 0) {
      frame.fix(frame.unknown(nodes[0], 0));
      continue;
    }
    frame.add_mass({{frame.unknown(nodes.back(), 0), 1.0}}, kFloor);
    for (int column = 0; column < 2; ++column)
      frame.add_beam({nodes[static_cast<std::size_t>(s) - 1], nodes.back(), 1e9, 0.5 * 7e7, 0.0, 0.0, 0.0});
  }
  const double k = 12.0 * 7e7 / std::pow(kHeight, 3);
  const FrameModes modes = frame.modes();
  ASSERT_EQ(modes.omega2.size(), kStoreys);
  for (int n = 1; n <= kStoreys; ++n)
    EXPECT_NEAR(std::sqrt(modes.omega2[n - 1]) /
                    (2.0 * std::sqrt(k / kFloor) * std::sin((2 * n - 1) * kPi / (2.0 * (2 * kStoreys + 1)))),
                1.0, 1e-9);
}

TEST(PlaneFrame, CompressionLowersFrequenciesUpToBuckling) {
  // w² = w0² (1 - P / (n² P_euler)) for a simply supported beam.
  const double euler = kBending * std::pow(kPi / kLength, 2);
  BeamPart part{-1, -1, kAxial, kBending, 0.0, kMass, 0.0, 0.6 * euler};
  Line beam = line(24, part);
  fix(beam, 0, {0, 1});
  fix(beam, -1, {1});
  const FrameModes modes = beam.frame.modes();
  for (int n = 1; n <= 3; ++n)
    EXPECT_NEAR(modes.omega2[n - 1] / (kBending / kMass * std::pow(n * kPi / kLength, 4) * (1.0 - 0.6 / (n * n))), 1.0, 1e-4)
        << n;
  part.compression_N = 1.1 * euler;
  Line buckled = line(24, part);
  fix(buckled, 0, {0, 1});
  fix(buckled, -1, {1});
  EXPECT_THROW((void)buckled.frame.modes(), std::runtime_error);
}

TEST(PlaneFrame, TipOfACantileverWithShearAndATurningJoint) {
  // w = P L³/(3 EI) + P L / S + c P (L - a)², the joint at a.
  const double shear = 5e8, turning = 3e-9;  // N, rad/(N m)
  PlaneFrame frame;
  const int root = frame.add_node({0.0, 0.0}), middle = frame.add_node({10.0, 0.0}), tip = frame.add_node({kLength, 0.0});
  const int joint = frame.add_unknown();
  frame.add_beam({root, middle, kAxial, kBending, shear, kMass, 0.0});
  BeamPart beyond{middle, tip, kAxial, kBending, shear, kMass, 0.0};
  beyond.turn_from = joint;
  frame.add_beam(beyond);
  frame.add_spring({{joint, 1.0}, {frame.unknown(middle, 2), -1.0}}, 1.0 / turning);
  for (const int d : {0, 1, 2}) frame.fix(frame.unknown(root, d));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(frame.unknowns());
  load[frame.unknown(tip, 1)] = 1000.0;
  const double expected = 1000.0 * (std::pow(kLength, 3) / (3.0 * kBending) + kLength / shear + turning * 15.0 * 15.0);
  EXPECT_NEAR(frame.displacement(load)[frame.unknown(tip, 1)] / expected, 1.0, 1e-9);
}

TEST(PlaneFrame, AMassOnASpringAndAVaryingSpring) {
  // Two masses: the second hangs on the first. A spring whose stiffness does not vary gives the modes of the frame that has it.
  const auto build = [](double further_N_m) {
    PlaneFrame frame;
    const int node = frame.add_node({0.0, 0.0}), own = frame.add_unknown();
    frame.fix(frame.unknown(node, 0));
    frame.fix(frame.unknown(node, 2));
    frame.add_mass({{frame.unknown(node, 1), 1.0}}, 1000.0);
    frame.add_spring({{frame.unknown(node, 1), 1.0}}, 1e6 + further_N_m);
    frame.add_mass({{own, 1.0}}, 100.0);
    frame.add_spring({{own, 1.0}, {frame.unknown(node, 1), -1.0}}, 1e5);
    return frame.modes();
  };
  // Equal tuning, mass ratio 0.1: w²/w0² = 1 + mu/2 -+ sqrt(mu + mu²/4).
  const FrameModes modes = build(0.0);
  EXPECT_NEAR(modes.omega2[0] / 1000.0, 1.05 - std::sqrt(0.1 + 0.0025), 1e-9);
  EXPECT_NEAR(modes.omega2[1] / 1000.0, 1.05 + std::sqrt(0.1 + 0.0025), 1e-9);
  const FrameModes stiffer = build(4e5), varied = with_varying_spring(
                                             modes, {{1, 1.0}}, [](double) { return 4e5; }, 2, 2);
  for (int i : {0, 1}) EXPECT_NEAR(varied.omega2[i] / stiffer.omega2[i], 1.0, 1e-9);
  // Storage stiffness of a spring and a dashpot in series: each mode holds at its own frequency.
  const auto storage = [](double w) { return 4e5 * w * w / (w * w + 900.0); };
  const FrameModes damped = with_varying_spring(modes, {{1, 1.0}}, storage, 2, 2);
  for (int i : {0, 1}) EXPECT_NEAR(damped.omega2[i] / build(storage(std::sqrt(damped.omega2[i]))).omega2[i], 1.0, 1e-3);
}

}  // namespace
}  // namespace twindeck::blind::form
