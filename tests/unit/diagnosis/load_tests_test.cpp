// Rows of load tests. Oracles: closed forms of Euler beams (deflection, rotation, strain and reactions of one span and of two,
// a settlement, a temperature gradient by its end moments); the structure with all its degrees of freedom; central differences.
#include <gtest/gtest.h>

#include "chain.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/load_test_vectors.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Cause;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSpan = 20.0, kModulus = 34e9, kInertia = 0.42, kDepth = 1.5, kForce = 4e5, kFall = 0.006;
constexpr double kEI = kModulus * kInertia;

/// Spans of equal length along x on simple supports, with a row for each channel and load case.
class Girder {
 public:
  Girder(int spans, int elements, std::vector<diagnosis::NodalLoad> loads, int full_below, double bearing = 0.0)
      : loads_(std::move(loads)) {
    fe::Model model;
    model.source = "girder";
    const int nodes = spans * elements + 1;
    for (int i = 0; i < nodes; ++i) model.nodes.push_back({i + 1, {kSpan * i / elements, 0.0, 0.0}});
    model.materials.push_back({"concrete", kModulus, 14e9, 0.2, 2500.0});
    fe::Section section;
    section.name = "box";
    section.area_m2 = 2.4;
    section.inertia_y_m4 = kInertia;
    section.inertia_z_m4 = 3.0;
    section.torsion_m4 = 0.8;
    model.sections.push_back(section);
    for (int i = 0; i + 1 < nodes; ++i) {
      fe::Element element;
      element.id = i + 1;
      element.group = "span_" + std::to_string(i / elements + 1);
      element.material = element.section = 0;
      element.nodes = {i, i + 1};
      model.elements.push_back(element);
    }
    for (int s = 0; s <= spans; ++s) {
      const bool on_bearing = s == 1 && bearing > 0.0;
      fe::Support support{"S" + std::to_string(s), s * elements, {s == 0, true, !on_bearing, s == 0, false, false}};
      model.supports.push_back(support);
      if (!on_bearing) continue;
      fe::Spring spring;
      spring.name = spring.group = "bearing";
      spring.node = s * elements;
      spring.stiffness = bearing;
      model.springs.push_back(spring);
      model.parameters.push_back({"k_bearing", fe::Target::spring_stiffness, {"bearing"}, "-", 1.0, 0.5, 2.0});
    }
    model.parameters.push_back({"E", fe::Target::youngs_modulus, {"concrete"}, "Pa", kModulus, 0.7 * kModulus, 1.3 * kModulus});
    at_middle_ = elements / 2;
    // Displacement and rotation in the middle of the first span, rotations at its ends, forces of all supports, strain below
    // its middle.
    add_channel("w", at_middle_ + 1, {0.0, 0.0, 1.0}, RowType::static_displacement);
    add_channel("r0", 1, {0.0, 1.0, 0.0}, RowType::static_rotation);
    add_channel("r1", elements + 1, {0.0, 1.0, 0.0}, RowType::static_rotation);
    for (int s = 0; s <= spans; ++s) {
      matching::Channel force;
      force.name = "F" + std::to_string(s);
      force.support = s == 1 && bearing > 0.0 ? "bearing" : "S" + std::to_string(s);
      force.direction = Eigen::Vector3d::UnitZ();
      put(force, RowType::static_force);
    }
    matching::Channel strain;
    strain.name = "e";
    strain.element = std::to_string(at_middle_);
    strain.xi = 1.0;
    strain.fibre_m = {0.0, -0.5 * kDepth};
    put(strain, RowType::static_strain);
    std::vector<std::string> cases;
    for (const auto& load : loads_)
      if (std::find(cases.begin(), cases.end(), load.load) == cases.end()) cases.push_back(load.load);
    for (const std::string& name : cases) {
      features_.conditions.emplace_back();
      features_.conditions.back().name = features_.conditions.back().load = name;
      for (std::size_t c = 0; c < types_.size(); ++c)
        features_.rows.push_back(
            {types_[c], "", static_cast<int>(c), "", static_cast<int>(features_.conditions.size()) - 1, 1.0, 0.1, false});
    }
    prepared_ = diagnosis::prepare_model(dynamics::from_model(model), channels_, 0.01);
    structure_ = prepared_->structure();
    places_ = diagnosis::find_places(structure_, {});
    std::vector<diagnosis::Gauge> gauges;
    for (std::size_t c = 0; c < channels_.size(); ++c)
      gauges.push_back({structure_.sensor_nodes[c], channels_[c].direction, channels_[c].element, channels_[c].xi,
                        channels_[c].fibre_m, channels_[c].support, 0});
    structure_.load_tests = diagnosis::load_tests_of(structure_, places_, loads_, gauges, "loads.csv", "channels.csv");
    diagnosis::ReductionOptions options;
    options.full_below = full_below;
    options.parameter_vectors = 60;
    options.element_change = 0.1;
    reduced_ = std::make_unique<diagnosis::ReducedModel>(structure_, places_, options);
    entries_ = diagnosis::instantiate(hypotheses_, *reduced_, features_);
    map_ = std::make_unique<diagnosis::FeatureMap>(*reduced_, features_, diagnosis::ScatterOptions{});
  }
  Girder(const Girder&) = delete;
  Girder& operator=(const Girder&) = delete;

  [[nodiscard]] const diagnosis::FeatureMap& map() const { return *map_; }
  [[nodiscard]] const diagnosis::ReducedModel& reduced() const { return *reduced_; }
  [[nodiscard]] Cause cause(const std::string& id, double coordinate) const {
    for (const auto& candidate : entries_.candidates)
      if (candidate->id() == id) return {candidate.get(), VectorXd::Constant(1, coordinate)};
    ADD_FAILURE() << "no entry " << id;
    return {};
  }
  [[nodiscard]] diagnosis::Prediction predict(const VectorXd& x, const std::vector<Cause>& causes = {}) const {
    diagnosis::Prediction p = map_->predict(map_->base(x), causes, true);
    EXPECT_TRUE(p.valid);
    return p;
  }
  [[nodiscard]] VectorXd nominal() const { return VectorXd::Zero(static_cast<Index>(map_->nuisances().size())); }
  /// Value of a channel in a load case.
  [[nodiscard]] double value(const diagnosis::Prediction& p, const std::string& channel, const std::string& load) const {
    for (std::size_t r = 0; r < features_.rows.size(); ++r) {
      const auto& row = features_.rows[r];
      if (features_.channels[static_cast<std::size_t>(row.channel)] == channel &&
          features_.conditions[static_cast<std::size_t>(row.condition)].load == load)
        return p.g[static_cast<Index>(r)];
    }
    ADD_FAILURE() << "no row of " << channel << " under " << load;
    return 0.0;
  }

 private:
  void put(const matching::Channel& channel, RowType type) {
    channels_.push_back(channel);
    types_.push_back(type);
    features_.channels.push_back(channel.name);
    features_.direction.push_back(channel.direction);
  }
  void add_channel(const std::string& name, int node, const Eigen::Vector3d& direction, RowType type) {
    matching::Channel channel;
    channel.name = name;
    channel.point = std::to_string(node);
    channel.direction = direction;
    put(channel, type);
  }

  std::vector<diagnosis::NodalLoad> loads_;
  std::vector<matching::Channel> channels_;
  std::vector<RowType> types_;
  diagnosis::FeatureSet features_;
  int at_middle_ = 0;
  std::shared_ptr<diagnosis::DiagnosedModel> prepared_;
  diagnosis::Structure structure_;
  diagnosis::Places places_;
  std::unique_ptr<diagnosis::ReducedModel> reduced_;
  std::vector<diagnosis::Hypothesis> hypotheses_ = catalogue({"settle", "stiffness", "brg"});
  diagnosis::Instantiated entries_;
  std::unique_ptr<diagnosis::FeatureMap> map_;
};

constexpr int kAll = 1 << 20;  // dofs: no structure here is reduced
constexpr int kNone = 0;       // every one is

diagnosis::NodalLoad down(const std::string& load, int node, double newton) {
  return {load, std::to_string(node), 2, -newton, false, 2};
}
diagnosis::NodalLoad couple(const std::string& load, int node, double value) {
  return {load, std::to_string(node), 4, value, false, 2};
}
diagnosis::NodalLoad moved(const std::string& load, int node, double metre) {
  return {load, std::to_string(node), 2, metre, true, 2};
}

TEST(LoadTests, ForceInTheMiddleOfASpan) {
  for (const int full_below : {kAll, kNone}) {
    const Girder girder(1, 20, {down("lorry", 11, kForce)}, full_below);
    const auto p = girder.predict(girder.nominal());
    const auto value = [&](const char* channel) { return girder.value(p, channel, "lorry"); };
    EXPECT_NEAR(value("w") / (-kForce * std::pow(kSpan, 3) / (48.0 * kEI)), 1.0, 1e-6);
    EXPECT_NEAR(value("r0") / (kForce * kSpan * kSpan / (16.0 * kEI)), 1.0, 1e-6);
    EXPECT_NEAR(value("r1") / (-kForce * kSpan * kSpan / (16.0 * kEI)), 1.0, 1e-6);
    EXPECT_NEAR(value("F0") / (0.5 * kForce), 1.0, 1e-6);
    EXPECT_NEAR(value("F1") / (0.5 * kForce), 1.0, 1e-6);
    EXPECT_NEAR(value("e") / (0.25 * kForce * kSpan * 0.5 * kDepth / kEI), 1.0, 1e-6);
  }
}

TEST(LoadTests, ForceOnOneOfTwoSpans) {
  for (const int full_below : {kAll, kNone}) {
    const Girder girder(2, 12, {down("lorry", 7, kForce)}, full_below);
    const auto p = girder.predict(girder.nominal());
    const auto value = [&](const char* channel) { return girder.value(p, channel, "lorry"); };
    EXPECT_NEAR(value("F0") / (13.0 / 32.0 * kForce), 1.0, 1e-6);
    EXPECT_NEAR(value("F1") / (11.0 / 16.0 * kForce), 1.0, 1e-6);
    EXPECT_NEAR(value("F2") / (-3.0 / 32.0 * kForce), 1.0, 1e-6);
    // Of the simple span less what the moment 3 P L / 32 over the support lifts.
    const double simple = std::pow(kSpan, 3) / (48.0 * kEI), lifted = 3.0 / 32.0 * std::pow(kSpan, 3) / (16.0 * kEI);
    EXPECT_NEAR(value("w") / (-kForce * (simple - lifted)), 1.0, 1e-6);
    EXPECT_NEAR(value("r1") / (-kForce * kSpan * kSpan / (32.0 * kEI)), 1.0, 1e-6);
  }
}

TEST(LoadTests, MiddleSupportThatSettlesAsALoadAndAsACause) {
  const double pull = 3.0 * kEI * kFall / std::pow(kSpan, 3);  // of each end
  for (const int full_below : {kAll, kNone}) {
    const Girder girder(2, 12, {moved("lowered", 13, -kFall), down("empty", 13, 0.0), down("empty", 7, 0.0)}, full_below);
    const auto as_load = girder.predict(girder.nominal());
    const auto as_cause = girder.predict(girder.nominal(), {girder.cause("settle@support:S1", -kFall)});
    for (const auto& [p, load] : {std::pair{as_load, "lowered"}, std::pair{as_cause, "empty"}}) {
      EXPECT_NEAR(girder.value(p, "F0", load) / pull, 1.0, 1e-5);
      EXPECT_NEAR(girder.value(p, "F1", load) / (-2.0 * pull), 1.0, 1e-5);
      EXPECT_NEAR(girder.value(p, "F2", load) / pull, 1.0, 1e-5);
      EXPECT_NEAR(girder.value(p, "w", load) / (-11.0 / 16.0 * kFall), 1.0, 1e-6);
      EXPECT_NEAR(girder.value(p, "r1", load), 0.0, 1e-6 * kFall / kSpan);
      EXPECT_NEAR(girder.value(p, "e", load) / (pull * 0.5 * kSpan * 0.5 * kDepth / kEI), 1.0, 1e-5);
    }
    // Without its cause nothing moves where nothing is loaded.
    EXPECT_EQ(girder.value(as_load, "F1", "empty"), 0.0);
  }
}

TEST(LoadTests, TemperatureGradientByItsEndMoments) {
  const double curvature = 1e-5 * 12.0 / kDepth;  // 12 K over the depth, warmer above: the girder bows upwards
  const Girder one(1, 20, {couple("sun", 1, -kEI * curvature), couple("sun", 21, kEI * curvature)}, kAll);
  EXPECT_NEAR(one.value(one.predict(one.nominal()), "w", "sun") / (curvature * kSpan * kSpan / 8.0), 1.0, 1e-6);
  const Girder two(2, 12, {couple("sun", 1, -kEI * curvature), couple("sun", 25, kEI * curvature)}, kAll);
  const auto p = two.predict(two.nominal());
  EXPECT_NEAR(two.value(p, "F1", "sun") / (-3.0 * kEI * curvature / kSpan), 1.0, 1e-6);
  EXPECT_NEAR(two.value(p, "F0", "sun") / (1.5 * kEI * curvature / kSpan), 1.0, 1e-6);
}

TEST(LoadTests, ReducedRowsAreThoseOfAllDegreesOfFreedomWhereParametersAndCausesMoveTheStructure) {
  const std::vector<diagnosis::NodalLoad> loads = {down("left", 16, kForce), moved("lowered", 31, -kFall)};
  const Girder full(2, 30, loads, kAll, 4e8), reduced(2, 30, loads, kNone, 4e8);
  ASSERT_LT(reduced.reduced().common, full.reduced().common);
  VectorXd x = full.nominal();
  ASSERT_EQ(x.size(), reduced.nominal().size());
  for (Index j = 0; j < x.size(); ++j) {
    const diagnosis::Nuisance& v = full.map().nuisances()[static_cast<std::size_t>(j)];
    x[j] = std::clamp((j % 3 == 0 ? 1.0 : -0.7), v.lower, v.upper);
  }
  for (const std::string id : {"", "settle@support:S2", "stiffness@group:span_2", "brg@support:bearing"}) {
    std::vector<Cause> in_full, in_reduced;
    const double a = id.starts_with("settle") ? 0.01 : std::log(0.6);
    if (!id.empty()) in_full = {full.cause(id, a)}, in_reduced = {reduced.cause(id, a)};
    const auto p = full.predict(x, in_full), q = reduced.predict(x, in_reduced);
    for (Index r = 0; r < p.g.size(); ++r) EXPECT_NEAR(q.g[r], p.g[r], 2e-3 * std::abs(p.g[r]) + 1e-9) << id << " row " << r;
  }
}

TEST(LoadTests, DerivativesAreThoseOfCentralDifferences) {
  const Girder girder(2, 6, {down("left", 4, kForce), moved("lowered", 7, -kFall)}, kAll, 4e8);
  VectorXd x = VectorXd::Constant(girder.nominal().size(), 0.2);
  const std::vector<Cause> causes = {girder.cause("brg@support:bearing", std::log(0.7))};
  const auto p = girder.predict(x, causes);
  constexpr double kStep = 1e-4;
  for (Index j = 0; j < x.size(); ++j) {
    VectorXd above = x, below = x;
    above[j] += kStep;
    below[j] -= kStep;
    const VectorXd slope = (girder.predict(above, causes).g - girder.predict(below, causes).g) / (2.0 * kStep);
    for (Index r = 0; r < slope.size(); ++r)
      EXPECT_NEAR(p.jacobian(r, j), slope[r], 1e-5 * std::abs(p.g[r]) + 1e-10)
          << girder.map().nuisances()[static_cast<std::size_t>(j)].name << " row " << r;
  }
}

TEST(LoadTests, WhatTheModelCannotAnswerIsRefusedByLine) {
  const auto refused = [](const diagnosis::NodalLoad& load) -> std::string {
    try {
      const Girder girder(2, 6, {load}, kAll);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused(down("left", 99, kForce)).find("loads.csv:2: node: '99' is no node"), std::string::npos);
  EXPECT_NE(refused(moved("lowered", 3, -kFall)).find("loads.csv:2: node: no support holds node '3' in direction z"),
            std::string::npos);
  EXPECT_EQ(refused(moved("lowered", 7, -kFall)), "");
}

}  // namespace
}  // namespace twindeck::tests
