// Causes at supports and nodes of single bodies. Oracles: frequencies in closed form, or of hand-written matrices by a dense
// solve.
#include <gtest/gtest.h>

#include "unit/diagnosis/found_causes.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::DiagnosedModel;
using diagnosis::ExtendedModel;
using diagnosis::Places;
using diagnosis::ReducedPlace;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A body that slides on x and turns about y, on a foot with springs of both.
struct Foot {
  double slide = 4e6, turn = 9e6, mass = 1000.0, inertia = 1500.0;
  double rigid_slide = 0.0;  // of what stands for a rigid support

  [[nodiscard]] fe::Model model(const std::string& of_rigid = "foot") const {
    fe::Model m;
    m.source = "foot";
    m.nodes = {{5, Vector3d::Zero()}};
    m.masses = {{"body", 0, mass, Vector3d::Constant(inertia)}};
    m.springs = {spring("foot_s", "foot", 0, -1, slide), spring("foot_t", "foot", 0, -1, turn, Vector3d::UnitY())};
    m.springs[1].rotation = true;
    if (rigid_slide > 0.0)
      m.springs.push_back(spring(of_rigid + std::string(diagnosis::kRigidSpring) + "x", of_rigid, 0, -1, rigid_slide));
    m.supports = {{"guide", 0, {false, true, true, true, false, true}}};
    return m;
  }
  [[nodiscard]] VectorXd hertz() const {
    return dense_hertz(Eigen::Vector2d(slide + rigid_slide, turn).asDiagonal().toDenseMatrix(),
                       Eigen::Vector2d(mass, inertia).asDiagonal().toDenseMatrix());
  }
};

void expect_foot(const Foot& foot, const At& cause, const Foot& expected, const std::string& of_rigid = "foot") {
  const DiagnosedModel prepared = ready(foot.model(of_rigid));
  const ExtendedModel out = diagnosis::extended_model(prepared, Places(), diagnosis_with({&cause}));
  ASSERT_EQ(out.holds, std::vector<bool>{true});
  expect_close(model_hertz(*out.elements, 2), expected.hertz());
}

TEST(ExtendedModel, ASupportSlidesAndAFoundationTurns) {
  Foot slides, turns;
  slides.slide *= 0.1;
  turns.turn *= 0.1;
  expect_foot(Foot(), At("scale.stiffness", {{"factor", 0.1}}, "supports", "support:foot"), slides);
  expect_foot(Foot(), At("scale.stiffness", {{"factor", 0.1}}, "foundations", "support:foot"), turns);
}

TEST(ExtendedModel, WhatIsRigidOfASupportHasANameOfItsOwn) {
  Foot foot;
  foot.rigid_slide = 2e7;
  Foot spring_soft = foot, rigid_soft = foot;
  spring_soft.slide *= 0.1;
  rigid_soft.rigid_slide *= 0.1;
  expect_foot(foot, At("scale.stiffness", {{"factor", 0.1}}, "supports", "support:foot"), spring_soft);
  expect_foot(foot, At("scale.stiffness", {{"factor", 0.1}}, "supports", "support:foot fixed"), rigid_soft);
  // Alone, it goes by the support's name.
  expect_foot(foot, At("scale.stiffness", {{"factor", 0.1}}, "supports", "support:abutment"), rigid_soft, "abutment");
}

/// A body that moves in all three directions, on a spring along each.
struct Body {
  std::array<double, 3> stiffness = {2e6, 5e6, 9e6};
  double mass = 1000.0;

  [[nodiscard]] fe::Model model() const {
    fe::Model m;
    m.source = "body";
    m.nodes = {{12, {1.0, 2.0, 3.0}}};
    m.masses = {{"body", 0, mass, Vector3d::Zero()}};
    for (int d = 0; d < 3; ++d)
      m.springs.push_back(
          spring(std::string("s") + "xyz"[d], "ground", 0, -1, stiffness[static_cast<std::size_t>(d)], Vector3d::Unit(d)));
    m.supports = {{"turns", 0, {false, false, false, true, true, true}}};
    return m;
  }
  [[nodiscard]] VectorXd hertz() const {
    VectorXd f(3);
    for (int d = 0; d < 3; ++d) f[d] = std::sqrt(stiffness[static_cast<std::size_t>(d)] / mass) / (2.0 * std::numbers::pi);
    std::sort(f.begin(), f.end());
    return f;
  }
};

void expect_body(const At& cause, const Body& expected) {
  const DiagnosedModel prepared = ready(Body().model());
  const ExtendedModel out = diagnosis::extended_model(prepared, Places(), diagnosis_with({&cause}));
  ASSERT_EQ(out.holds, std::vector<bool>{true});
  expect_close(model_hertz(*out.elements, 3), expected.hertz());
}

TEST(ExtendedModel, AMassMovesWithItsNode) {
  Body heavy;
  heavy.mass += 700.0;
  expect_body(At("mass.add", {{"mass", 700.0}}, "nodes", "node:12"), heavy);
}

TEST(ExtendedModel, APropHoldsInAllDirectionsOrUpwardsAlone) {
  const ReducedPlace node;
  Body held = Body(), propped = Body();
  for (double& k : held.stiffness) k += 3e6;
  propped.stiffness[2] += 3e6;
  expect_body(At("element.spring", {{"stiffness", 3e6}}, "nodes", "node:12", {&node}), held);
  At vertical("element.spring", {{"stiffness", 3e6}}, "nodes", "node:12", {&node});
  vertical.with_text("direction", "vertical");
  expect_body(vertical, propped);
}

TEST(ExtendedModel, AnOscillatorSplitsEveryMode) {
  // Of a mass m on k with a body mu m, tuned to w: (k + ka - m l)(ka - mu m l) = ka², ka = mu m w².
  const double mass = 150.0, tuned = 9.0, w = 2.0 * std::numbers::pi * tuned;
  const DiagnosedModel prepared = ready(Body().model());
  const At osc("element.oscillator", {{"mass", mass}, {"frequency", tuned}}, "nodes", "node:12");
  const ExtendedModel out = diagnosis::extended_model(prepared, Places(), diagnosis_with({&osc}));
  EXPECT_EQ(out.holds, std::vector<bool>{true});
  VectorXd expected(6);
  for (int d = 0; d < 3; ++d) {
    const double k = Body().stiffness[static_cast<std::size_t>(d)], m = Body().mass, ka = mass * w * w;
    const double a = m * mass, b = -((k + ka) * mass + ka * m), c = k * ka, root = std::sqrt(b * b - 4.0 * a * c);
    expected[2 * d] = std::sqrt((-b - root) / (2.0 * a)) / (2.0 * std::numbers::pi);
    expected[2 * d + 1] = std::sqrt((-b + root) / (2.0 * a)) / (2.0 * std::numbers::pi);
  }
  std::sort(expected.begin(), expected.end());
  expect_close(model_hertz(*out.elements, 6), expected);
  EXPECT_EQ(out.elements->nodes.back().id, 13);
  const At second("element.oscillator", {{"mass", 10.0}, {"frequency", 1.0}}, "nodes", "node:12");
  const ExtendedModel two = diagnosis::extended_model(prepared, Places(), diagnosis_with({&osc, &second}));
  EXPECT_EQ(two.elements->nodes.back().id, 14);  // each a node of its own
}

TEST(ExtendedModel, AnOscillatorThatOnlyMovesVerticallySplitsThatModeAlone) {
  const DiagnosedModel prepared = ready(Body().model());
  const ReducedPlace node;
  At osc("element.oscillator", {{"mass", 150.0}, {"frequency", 9.0}}, "nodes", "node:12", {&node});
  osc.with_text("direction", "vertical");
  const ExtendedModel out = diagnosis::extended_model(prepared, Places(), diagnosis_with({&osc}));
  EXPECT_EQ(out.holds, std::vector<bool>{true});
  const double ka = 150.0 * std::pow(2.0 * std::numbers::pi * 9.0, 2);
  MatrixXd k = MatrixXd(Eigen::Vector4d(2e6, 5e6, 9e6 + ka, ka).asDiagonal());
  k(2, 3) = k(3, 2) = -ka;
  const MatrixXd m = Eigen::Vector4d(1000.0, 1000.0, 1000.0, 150.0).asDiagonal();
  expect_close(model_hertz(*out.elements, 4), dense_hertz(k, m));
}

/// Two bodies in a plane, three metres apart on x and four on y.
fe::Model two_bodies(const Vector3d& second = {3.0, 4.0, 0.0}) {
  fe::Model m;
  m.source = "two bodies";
  m.nodes = {{40, Vector3d::Zero()}, {4, second}};
  for (int i = 0; i < 2; ++i) {
    m.masses.push_back({"body", i, 100.0 * (i + 1), Vector3d::Zero()});
    for (int d = 0; d < 2; ++d)
      m.springs.push_back(spring("s" + std::to_string(2 * i + d), "ground", i, -1, 1e5 * (1 + i + 3 * d), Vector3d::Unit(d)));
    m.supports.push_back({"flat", i, {false, false, true, true, true, true}});
  }
  return m;
}

TEST(ExtendedModel, ATieHoldsAlongItsLine) {
  const double tie = 7e5;
  const ReducedPlace a, b;
  const At cause("element.spring", {{"stiffness", tie}}, "pairs(nodes)", "nodes:40,4", {&a, &b});
  const ExtendedModel out = diagnosis::extended_model(ready(two_bodies()), Places(), diagnosis_with({&cause}));
  EXPECT_EQ(out.holds, std::vector<bool>{true});
  MatrixXd k = Eigen::Vector4d(1e5, 4e5, 2e5, 5e5).asDiagonal();
  const Eigen::Vector4d along(0.6, 0.8, -0.6, -0.8);
  k += tie * along * along.transpose();
  expect_close(model_hertz(*out.elements, 4),
               dense_hertz(k, Eigen::Vector4d(100.0, 100.0, 200.0, 200.0).asDiagonal().toDenseMatrix()));
}

TEST(ExtendedModel, ATieOfNodesInOnePlaceIsNotHeld) {
  const ReducedPlace a, b;
  const At cause("element.spring", {{"stiffness", 7e5}}, "pairs(nodes)", "nodes:40,4", {&a, &b});
  const ExtendedModel out = diagnosis::extended_model(ready(two_bodies(Vector3d::Zero())), Places(), diagnosis_with({&cause}));
  EXPECT_EQ(out.holds, std::vector<bool>{false});
  EXPECT_EQ(out.elements->springs.size(), 4U);
}

}  // namespace
}  // namespace twindeck::tests
