// Causes put into matrices, and into the list of channels. Oracles: matrices by hand; what the diagnosis's own model of faulty
// channels reads.
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

/// Node "a" moves in x, y, z and turns about x; "b" moves in x and z. Each dof on a spring of its own.
class Labelled {
 public:
  Labelled()
      : stiffness(Eigen::VectorXd::LinSpaced(6, 1e6, 6e6).asDiagonal()),
        mass(1000.0 * MatrixXd::Identity(6, 6)),
        model_(dofs(), stiffness, mass,
               {{{"k", fe::Target::matrix_stiffness, {}, "-", 2.0, 1.5, 2.5}, 5e5 * MatrixXd::Identity(6, 6)},
                {{"more", fe::Target::matrix_stiffness, {}, "-", 0.0, -0.5, 0.5}, 3e5 * MatrixXd::Identity(6, 6)}}) {
    prepared_.loaded.system = *model_.structure().system;
    // Of a parameter that is zero at first, the matrix is the one of a unit.
    prepared_.loaded.system.stiffness_terms[2].coefficient.factors[0].reference = 1.0;
    prepared_.loaded.theta = prepared_.loaded.system.initial();
    stiffness += 5e5 * MatrixXd::Identity(6, 6);
  }
  [[nodiscard]] ExtendedModel with(const At& cause, const VectorXd& theta = {}) const {
    return diagnosis::extended_model(prepared_, Places(), diagnosis_with({&cause}, theta));
  }
  void expect(const At& cause, const MatrixXd& k, const MatrixXd& m) const {
    const ExtendedModel out = with(cause);
    EXPECT_EQ(out.holds, std::vector<bool>{true});
    EXPECT_FALSE(out.elements.has_value());
    const VectorXd theta = out.system.initial();
    EXPECT_LT((MatrixXd(out.system.stiffness(theta)) - k).norm(), kExact * k.norm());
    EXPECT_LT((MatrixXd(out.system.mass(theta)) - m).norm(), kExact * m.norm());
  }
  static MatrixXd on(const std::vector<int>& dofs, double value) {
    MatrixXd out = MatrixXd::Zero(6, 6);
    for (const int i : dofs) out(i, i) = value;
    return out;
  }
  MatrixXd stiffness, mass;

 private:
  static std::vector<fe::DofLabel> dofs() {
    return {{"a", 3, Vector3d::Zero()}, {"a", 0, Vector3d::Zero()},  {"a", 1, Vector3d::Zero()},
            {"a", 2, Vector3d::Zero()}, {"b", 0, Vector3d::UnitX()}, {"b", 2, Vector3d::UnitX()}};
  }
  MatrixModel model_;
  DiagnosedModel prepared_;
};

TEST(ExtendedMatrices, AMassAndAPropAreOnTheTranslationsOfTheirNode) {
  const Labelled matrices;
  const ReducedPlace node;
  matrices.expect(At("mass.add", {{"mass", 30.0}}, "nodes", "node:a", {&node}), matrices.stiffness,
                  matrices.mass + Labelled::on({1, 2, 3}, 30.0));
  matrices.expect(At("element.spring", {{"stiffness", 4e5}}, "nodes", "node:b", {&node}),
                  matrices.stiffness + Labelled::on({4, 5}, 4e5), matrices.mass);
}

TEST(ExtendedMatrices, AVerticalPropHoldsUpwardsWhereTheNodeMovesInSpace) {
  // As the diagnosis fits it: a node that lacks a direction is held in those that it has.
  const Labelled matrices;
  const ReducedPlace node;
  At prop("element.spring", {{"stiffness", 4e5}}, "nodes", "node:a", {&node});
  prop.with_text("direction", "vertical");
  matrices.expect(prop, matrices.stiffness + Labelled::on({3}, 4e5), matrices.mass);
  At flat("element.spring", {{"stiffness", 4e5}}, "nodes", "node:b", {&node});
  flat.with_text("direction", "vertical");
  matrices.expect(flat, matrices.stiffness + Labelled::on({4, 5}, 4e5), matrices.mass);
}

TEST(ExtendedMatrices, AGroupIsItsParametersValue) {
  const Labelled matrices;
  // Half of 5e5 on every dof is taken off.
  const At soft("scale.stiffness", {{"factor", 0.5}}, "groups", "group:k");
  matrices.expect(soft, matrices.stiffness - 2.5e5 * MatrixXd::Identity(6, 6), matrices.mass);
  const fe::Parameter k = matrices.with(soft).system.parameters.at(0);
  EXPECT_EQ(k.initial, 1.0);
  EXPECT_EQ(k.lower, 1.0);
  EXPECT_EQ(k.upper, 2.5);
  // A correction that is zero counts in its own unit: 1.8 of a factor is 0.8 of it.
  const At more("scale.stiffness", {{"factor", 1.8}}, "groups", "group:more");
  matrices.expect(more, matrices.stiffness + 0.8 * 3e5 * MatrixXd::Identity(6, 6), matrices.mass);
  EXPECT_NEAR(matrices.with(more).system.parameters.at(1).upper, 0.8, 1e-12);
  // The fit moves it to 0.2, the cause adds 0.8 all the same.
  EXPECT_NEAR(matrices.with(more, Eigen::Vector2d(2.0, 0.2)).system.parameters.at(1).initial, 1.0, 1e-12);
}

TEST(ExtendedMatrices, WhatMatricesCannotSayIsNotHeld) {
  const Labelled matrices;
  const ReducedPlace a, b;
  for (const At& cause : {At("scale.stiffness", {{"factor", 0.5}}, "global", "global"),
                          At("element.spring", {{"stiffness", 1e5}}, "pairs(nodes)", "nodes:a,b", {&a, &b}),
                          At("element.oscillator", {{"mass", 5.0}, {"frequency", 2.0}}, "nodes", "node:a", {&a})}) {
    const ExtendedModel out = matrices.with(cause);
    EXPECT_EQ(out.holds, std::vector<bool>{false}) << cause.hypothesis.id;
    EXPECT_EQ(out.system.mass_terms.size(), 1U);
    EXPECT_EQ(out.system.stiffness_terms.size(), 3U);
  }
}

/// Three channels along x at nodes that stand on x = 0, 1, 2.
std::vector<matching::Channel> three_channels() {
  std::vector<matching::Channel> channels(3);
  for (int c = 0; c < 3; ++c) {
    channels[static_cast<std::size_t>(c)].name = "c" + std::to_string(c);
    channels[static_cast<std::size_t>(c)].point = std::to_string(c + 1);
    channels[static_cast<std::size_t>(c)].direction = Vector3d::UnitX();
  }
  return channels;
}

/// What the channels read of a motion, by their names, as a corrected channels.csv says that they stand: reading = motion at
/// the point along the direction / gain, the gain being the factor that brings the reading back.
std::map<std::string, double> readings(const diagnosis::CorrectedChannels& corrected, const VectorXd& motion) {
  std::map<std::string, double> out;
  for (std::size_t c = 0; c < corrected.channels.size(); ++c) {
    const matching::Channel& channel = corrected.channels[c];
    out[channel.name] = motion[std::stoi(channel.point) - 1] * channel.direction.x() / corrected.gain[c];
  }
  return out;
}

TEST(CorrectedChannels, AreGainsSignsAndExchanges) {
  At gain("channel.gain", {{"factor", 1.25}}, "channels", "channel:c1"), sign("channel.sign", {}, "channels", "channel:c2");
  gain.on_channels({1});
  sign.on_channels({2});
  const auto out = diagnosis::corrected_channels(three_channels(), diagnosis_with({&gain, &sign}));
  EXPECT_EQ(out.gain, (std::vector<double>{1.0, 0.8, 1.0}));
  EXPECT_EQ(out.channels[1].direction, Vector3d::UnitX());
  EXPECT_EQ(out.channels[2].direction, -Vector3d::UnitX());
  At swap("channel.swap", {}, "pairs(channels)", "channels:c0,c2");
  swap.on_channels({0, 2});
  const auto swapped = diagnosis::corrected_channels(three_channels(), diagnosis_with({&swap}));
  EXPECT_EQ(swapped.channels[0].name, "c2");
  EXPECT_EQ(swapped.channels[0].point, "1");
  EXPECT_EQ(swapped.channels[2].name, "c0");
}

TEST(CorrectedChannels, ReadWhatTheModelOfFaultyChannelsReads) {
  // c0 and c1, then c1 and c2 have changed places; c0 reads the wrong sign, c1 a quarter more. Of a motion u, c0 reads -u2, c1
  // reads 1.25 u3 and c2 reads u1, in whatever order signs and gains were found.
  At first("channel.swap", {}, "pairs(channels)", ""), second("channel.swap", {}, "pairs(channels)", ""),
      sign("channel.sign", {}, "channels", ""), gain("channel.gain", {{"factor", 1.25}}, "channels", "");
  first.on_channels({0, 1});
  second.on_channels({1, 2});
  sign.on_channels({0});
  gain.on_channels({1});
  const Eigen::Vector3d u(0.3, 0.7, 1.1);
  for (const auto& order : {std::vector<const At*>{&first, &second, &sign, &gain}, {&sign, &first, &gain, &second}}) {
    const auto read = readings(diagnosis::corrected_channels(three_channels(), diagnosis_with(order)), u);
    EXPECT_NEAR(read.at("c0"), -u[1], 1e-12);
    EXPECT_NEAR(read.at("c1"), 1.25 * u[2], 1e-12);
    EXPECT_NEAR(read.at("c2"), u[0], 1e-12);
  }
  // The same of the diagnosis: shape rows of one mode, scaled by the largest.
  Predicted model(nodes_in_a_row(3), springs_in_a_row(Eigen::Vector4d(2e6, 1e6, 3e6, 2e6)), 1000.0 * MatrixXd::Identity(3, 3));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(springs_in_a_row(Eigen::Vector4d(2e6, 1e6, 3e6, 2e6)));
  const VectorXd phi = eigen.eigenvectors().col(0);
  model.add_frequencies(dense_hertz(springs_in_a_row(Eigen::Vector4d(2e6, 1e6, 3e6, 2e6)), 1000.0 * MatrixXd::Identity(3, 3)));
  const auto read =
      readings(diagnosis::corrected_channels(three_channels(), diagnosis_with({&first, &second, &sign, &gain})), phi);
  const double most = std::max<double>({std::abs(read.at("c0")), std::abs(read.at("c1")), std::abs(read.at("c2"))});
  const Eigen::Index row = model.add_row(diagnosis::RowType::shape, "1", 0, read.at("c0") / most);
  model.add_row(diagnosis::RowType::shape, "1", 1, read.at("c1") / most);
  model.add_row(diagnosis::RowType::shape, "1", 2, read.at("c2") / most);
  const auto predicted = model.predict({first.cause(), second.cause(), sign.cause(), gain.cause()});
  ASSERT_TRUE(predicted.valid);
  const VectorXd g = predicted.g.segment(row, 3);
  EXPECT_NEAR(g[1] / g[0], read.at("c1") / read.at("c0"), 1e-6);
  EXPECT_NEAR(g[2] / g[0], read.at("c2") / read.at("c0"), 1e-6);
}

}  // namespace
}  // namespace twindeck::tests
