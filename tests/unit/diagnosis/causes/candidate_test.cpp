// Oracles: entries, bounds, starts and priors of small catalogues, counted and written out by hand.
#include "diagnosis/causes/candidate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Candidate;
using diagnosis::FeatureSet;
using diagnosis::Hypothesis;
using diagnosis::instantiate;
using diagnosis::Place;
using diagnosis::ReducedModel;
using diagnosis::RowType;
using diagnosis::UnknownSpec;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Masses in a row with places of further sets.
class RowModel {
 public:
  explicit RowModel(int n = 4, const std::function<void(diagnosis::Places&)>& more = {})
      : matrices_(nodes_in_a_row(n), springs_in_a_row(VectorXd::Constant(n + 1, 2e6)), 1000.0 * MatrixXd::Identity(n, n)) {
    diagnosis::Places places = find_places(matrices_.structure(), {});
    if (more) more(places);
    reduced = std::make_unique<ReducedModel>(matrices_.structure(), places, diagnosis::ReductionOptions{});
  }
  std::unique_ptr<ReducedModel> reduced;

 private:
  MatrixModel matrices_;
};

/// Modes 1 and 2 at 2 and 5 Hz with a shape at the first three of four channels.
FeatureSet two_modes_at_channels() {
  FeatureSet f;
  for (int c = 0; c < 4; ++c) {
    f.channels.push_back(std::string(1, static_cast<char>('a' + c)));
    f.direction.push_back(c < 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX());
  }
  f.conditions.emplace_back();
  f.conditions[0].name = "calm";
  for (const int mode : {1, 2}) {
    f.rows.push_back({RowType::frequency, std::to_string(mode), -1, "", 0, mode == 1 ? 2.0 : 5.0, 0.01, false});
    for (int c = 0; c < 3; ++c) f.rows.push_back({RowType::shape, std::to_string(mode), c, "", 0, 1.0, 0.02, false});
  }
  return f;
}

Hypothesis family(const std::string& id, const std::string& set, const std::string& kind) {
  Hypothesis h;
  h.id = id;
  h.set = set;
  h.file = id + ".toml";
  h.actions.push_back({diagnosis::primitive_named(kind).value(), {}, {}, 0});
  return h;
}

UnknownSpec unknown(const std::string& name, double low, double high, bool log, const std::vector<double>& starts = {}) {
  UnknownSpec u{name, "-", {low, "", 3}, {high, "", 3}, log, {}};
  for (const double start : starts) u.start.push_back({start, "", 3});
  return u;
}

std::vector<std::string> ids(const diagnosis::Instantiated& found) {
  std::vector<std::string> out;
  for (const auto& candidate : found.candidates) out.push_back(candidate->key());
  return out;
}

TEST(Instantiate, EachLocationOfASetOnce) {
  const RowModel model;
  const FeatureSet f = two_modes_at_channels();
  const auto at = [&](const std::string& set, const std::string& kind) {
    return ids(instantiate({family("h", set, kind)}, *model.reduced, f));
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(at("nodes", "mass.add"), (Ids{"h@node:1", "h@node:2", "h@node:3", "h@node:4"}));
  EXPECT_EQ(at("channels", "channel.sign"), (Ids{"h@channel:a", "h@channel:b", "h@channel:c"}));  // d shows no row
  EXPECT_EQ(at("pairs(channels)", "channel.swap"), (Ids{"h@channels:a,b", "h@channels:a,c", "h@channels:b,c"}));
  EXPECT_EQ(at("modes", "modes.exchange"), (Ids{"h@mode:1", "h@mode:2"}));
  EXPECT_EQ(at("global", "scale.stiffness"), Ids{"h@global"});
  EXPECT_EQ(at("pairs(nodes)", "element.spring").size(), 6U);
}

TEST(Instantiate, PairsOfChannelsMayHaveToPointAlike) {
  // a and b are vertical, c is not.
  const RowModel model;
  Hypothesis swap = family("h", "pairs(channels)", "channel.swap");
  swap.filter = "same_direction";
  const FeatureSet f = two_modes_at_channels();
  EXPECT_EQ(ids(instantiate({swap}, *model.reduced, f)), std::vector<std::string>{"h@channels:a,b"});
}

TEST(Instantiate, OfManyNodesPairsAreTheNearestFour) {
  // Ten nodes: six have four after them, the last four have 3, 2, 1 and 0.
  const RowModel model(10);
  const std::vector<Hypothesis> all = {family("tie", "pairs(nodes)", "element.spring")};
  const auto found = instantiate(all, *model.reduced, two_modes_at_channels());
  EXPECT_EQ(found.candidates.size(), 6U * 4U + 3U + 2U + 1U);
  for (const auto& candidate : found.candidates)
    EXPECT_LE((candidate->places[0]->x_m - candidate->places[1]->x_m).norm(), 4.0 + 1e-12) << candidate->id();
}

TEST(Instantiate, PriorsAreSharedByWeightAndLocation) {
  // Weights 3 and 1: a family of four nodes has 3/4 of it, one global entry 1/4. A family that is invisible takes nothing.
  const RowModel model;
  Hypothesis mass = family("mass", "nodes", "mass.add"), stiff = family("stiff", "global", "scale.stiffness"),
             unseen = family("unseen", "stays", "stay.pull");
  mass.prior_weight = 3.0;
  unseen.prior_weight = 100.0;
  const FeatureSet f = two_modes_at_channels();
  const std::vector<Hypothesis> all = {mass, stiff, unseen};
  const auto found = instantiate(all, *model.reduced, f);
  ASSERT_EQ(found.candidates.size(), 5U);
  for (const auto& candidate : found.candidates)
    EXPECT_NEAR(candidate->log_prior, std::log(candidate->location == "global" ? 0.25 : 0.75 / 4.0), 1e-12);
  ASSERT_EQ(found.invisible.size(), 1U);
  EXPECT_EQ(found.invisible[0].hypothesis, "unseen");
}

TEST(Instantiate, NeedsThatTheRowsDoNotMeetAreInvisible) {
  const RowModel model;
  FeatureSet f = two_modes_at_channels();
  const auto is_seen = [&](const diagnosis::Needs& needs) {
    Hypothesis h = family("h", "nodes", "mass.add");
    h.needs = needs;
    return instantiate({h}, *model.reduced, f).invisible.empty();
  };
  const diagnosis::Needs on{{{"dampers", "on"}}, {}, {}}, off{{{"dampers", "off"}}, {}, {}},
      known{{{"people", "known"}}, {}, {}}, above{{{"people", "above_zero"}}, {}, {}}, two{{}, {{"temperature_C", 2}}, {}},
      rows{{}, {}, {"rms_m_s2", "shape"}}, others{{}, {}, {"rms_m_s2"}};
  for (const auto* needs : {&on, &off, &known, &above, &two, &others}) EXPECT_FALSE(is_seen(*needs));
  EXPECT_TRUE(is_seen(rows));
  f.conditions[0].dampers_on = true;
  f.conditions[0].people = 0.0;
  f.conditions[0].temperature_C = 10.0;
  EXPECT_TRUE(is_seen(on));
  EXPECT_FALSE(is_seen(off));
  EXPECT_TRUE(is_seen(known));
  EXPECT_FALSE(is_seen(above));
  f.conditions.push_back(f.conditions[0]);  // without rows it does not count
  f.conditions[1].temperature_C = 20.0;
  EXPECT_FALSE(is_seen(two));
  f.rows.push_back({RowType::frequency, "1", -1, "", 1, 2.0, 0.01, false});
  EXPECT_TRUE(is_seen(two));
}

TEST(Instantiate, BoundsAndStartsAreInTheirCoordinates) {
  // Starts outside of the bounds are left out; without one the middle is tried. The last unknown's starts run fastest.
  const RowModel model;
  Hypothesis h = family("h", "global", "mass.per_count");
  h.unknowns = {unknown("mass", 10.0, 1000.0, true, {20.0, 100.0, 5000.0}), unknown("angle", -4.0, 8.0, false, {0.0, 3.0}),
                unknown("rate", 1.0, 3.0, false)};
  const std::vector<Hypothesis> all = {h};
  const auto found = instantiate(all, *model.reduced, two_modes_at_channels());
  const Candidate& c = *found.candidates.at(0);
  EXPECT_NEAR((c.low - Eigen::Vector3d(std::log(10.0), -4.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((c.high - Eigen::Vector3d(std::log(1000.0), 8.0, 3.0)).norm(), 0.0, 1e-12);
  ASSERT_EQ(c.starts.size(), 4U);
  EXPECT_NEAR((c.starts[1] - Eigen::Vector3d(std::log(20.0), 3.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((c.starts[2] - Eigen::Vector3d(std::log(100.0), 0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(c.physical(c.starts[1], 0), 20.0, 1e-12);
  EXPECT_EQ(c.physical(c.starts[1], 1), 3.0);
  EXPECT_EQ(c.tuned, -1);
}

TEST(Instantiate, BoundsThatAreNoneAreRefused) {
  const RowModel model;
  const FeatureSet f = two_modes_at_channels();
  for (const UnknownSpec& wrong :
       {unknown("u", 2.0, 1.0, false), unknown("u", 1.0, 1.0, false), unknown("u", 0.0, 1.0, true)}) {
    Hypothesis h = family("h", "global", "scale.stiffness");
    h.unknowns = {wrong};
    EXPECT_THROW((void)instantiate({h}, *model.reduced, f), InputError);
  }
  Hypothesis h = family("h", "global", "scale.stiffness");
  h.unknowns = {unknown("u", 1.0, 2.0, false)};
  h.unknowns[0].high.name = "weight_of_the_moon";
  EXPECT_THROW((void)instantiate({h}, *model.reduced, f), InputError);
}

TEST(Instantiate, BoundsMayNameNumbersOfThePlace) {
  // A node of four equal springs in a row drives k (1/1 + 1/4) at the first mass.
  const RowModel model;
  Hypothesis h = family("h", "nodes", "element.spring");
  h.unknowns = {unknown("stiffness", 0.01, 10.0, true)};
  h.unknowns[0].low.name = h.unknowns[0].high.name = "k_drive";
  const std::vector<Hypothesis> all = {h};
  const auto found = instantiate(all, *model.reduced, two_modes_at_channels());
  EXPECT_NEAR(std::exp(found.candidates.at(0)->low[0]) / (0.01 * 2e6 * 1.25), 1.0, 1e-10);
  EXPECT_NEAR(std::exp(found.candidates.at(0)->high[0]) / (10.0 * 2e6 * 1.25), 1.0, 1e-10);
  h.unknowns[0].low.name = "f_cable";  // no node has one: the family is nowhere
  EXPECT_EQ(instantiate({h}, *model.reduced, two_modes_at_channels()).invisible.size(), 1U);
}

TEST(Instantiate, TunedStartsFollowTheMeasuredModes) {
  // 0.9 and 1.1 times 2 and 5 Hz of the condition with most modes.
  const RowModel model;
  FeatureSet f = two_modes_at_channels();
  f.conditions.emplace_back();
  f.rows.push_back({RowType::frequency, "1", -1, "", 1, 3.0, 0.01, false});
  Hypothesis h = family("h", "nodes", "element.oscillator");
  h.unknowns = {unknown("mass", 10.0, 1000.0, true, {100.0}), unknown("frequency", 0.1, 50.0, true)};
  h.unknowns[1].start = {{0.9, "f_measured", 0}, {1.1, "f_measured", 0}};
  const std::vector<Hypothesis> all = {h};
  const auto found = instantiate(all, *model.reduced, f);
  const Candidate& c = *found.candidates.at(0);
  EXPECT_EQ(c.tuned, 1);
  ASSERT_EQ(c.starts.size(), 4U);
  const double expected[] = {1.8, 4.5, 2.2, 5.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(c.physical(c.starts[i], 1), expected[i], 1e-12) << i;
    EXPECT_EQ(c.tuning[i].mode, i % 2 ? "2" : "1");
    EXPECT_EQ(c.tuning[i].condition, 0);
    EXPECT_EQ(c.tuning[i].factor, i < 2 ? 0.9 : 1.1);
  }
}

void add_stay(diagnosis::Places& places) {
  Place stay;
  stay.id = "stay:S1";
  MatrixXd own = MatrixXd::Zero(4, 4);
  own(1, 1) = 1e5;
  stay.stiffness = diagnosis::Symmetric(own.sparseView());
  stay.attributes = {{"f_cable", 1.5}};
  places.sets["stays"] = {stay};
}

TEST(Instantiate, AStaysFrequencyIsTheMeasuredOneOrWideAboutTheModels) {
  const RowModel model(4, add_stay);
  FeatureSet f = two_modes_at_channels();
  Hypothesis h = family("h", "stays", "element.string");
  h.unknowns = {unknown("frequency", 1.0, 1.0, true)};
  h.unknowns[0].low.name = "f_own_low";
  h.unknowns[0].high.name = "f_own_high";
  const std::vector<Hypothesis> all = {h};
  const auto modelled = instantiate(all, *model.reduced, f);
  EXPECT_NEAR(std::exp(modelled.candidates.at(0)->low[0]), 0.6 * 1.5, 1e-12);
  EXPECT_NEAR(std::exp(modelled.candidates.at(0)->high[0]), 1.6 * 1.5, 1e-12);
  // First and third harmonics, both to 2 %: the mean of ln 1.2 and ln 3.9/3, with 2 % / sqrt 2; three deviations of it.
  f.rows.push_back({RowType::stay_frequency, "1", -1, "S1", 0, 1.2, 0.024, false});
  f.rows.push_back({RowType::stay_frequency, "3", -1, "S1", 0, 3.9, 0.078, false});
  const auto measured = instantiate(all, *model.reduced, f);
  const double middle = 0.5 * (std::log(1.2) + std::log(1.3)), spread = 3.0 * 0.02 / std::sqrt(2.0);
  EXPECT_NEAR(measured.candidates.at(0)->own.at("f_own"), std::exp(middle), 1e-12);
  EXPECT_NEAR(measured.candidates.at(0)->low[0], middle - spread, 1e-12);
  EXPECT_NEAR(measured.candidates.at(0)->high[0], middle + spread, 1e-12);
}

TEST(Instantiate, BetweenStatesPartsChangeInOneAlone) {
  // A factor is asked in the later state, what is added and a sensor in either and in both.
  const RowModel model;
  FeatureSet f = two_modes_at_channels();
  f.conditions.push_back(f.conditions[0]);
  f.conditions[1].state = "after";
  f.rows.push_back({RowType::frequency, "1", -1, "", 1, 2.0, 0.01, false});
  Hypothesis stiff = family("stiff", "global", "scale.stiffness"), sign = family("sign", "channels", "channel.sign"),
             mass = family("mass", "nodes", "mass.add");
  stiff.unknowns = {unknown("factor", 0.5, 2.0, true, {0.7})};
  sign.measurement = true;
  const std::vector<Hypothesis> all = {stiff, sign, mass};
  const auto found = instantiate(all, *model.reduced, f);
  EXPECT_EQ(found.candidates.size(), 2U + 9U + 12U);  // what errs in both states is an error of the model
  for (const auto& c : found.candidates) {
    if (c->hypothesis->id != "stiff") continue;
    if (c->state.empty()) {
      EXPECT_EQ(c->key(), "stiff@global");
      EXPECT_NEAR(c->low[0], std::log(0.5), 1e-12);
      continue;
    }
    EXPECT_EQ(c->key(), "stiff@global in after");
    EXPECT_NEAR(c->low[0], std::log(0.005), 1e-12);  // parts may be cut
    EXPECT_NEAR(c->high[0], std::log(20.0), 1e-12);
    EXPECT_TRUE(c->acts_in(f.conditions[1]));
    EXPECT_FALSE(c->acts_in(f.conditions[0]));
  }
}

TEST(Instantiate, OfThreeStatesPartsChangeInOneOrFromOneOn) {
  // A factor: in the second, in the third, from the second on. What is added, and a fault of a sensor, may also be missing in
  // the third, or after the first. The prior of a family stays what it is.
  const RowModel model;
  FeatureSet f = two_modes_at_channels();
  for (const char* state : {"mid", "late"}) {
    f.conditions.push_back(f.conditions[0]);
    f.conditions.back().state = state;
    f.rows.push_back({RowType::frequency, "1", -1, "", static_cast<int>(f.conditions.size()) - 1, 2.0, 0.01, false});
  }
  Hypothesis stiff = family("stiff", "global", "scale.stiffness"), sign = family("sign", "channels", "channel.sign"),
             mass = family("mass", "global", "mass.add");
  stiff.unknowns = {unknown("factor", 0.5, 2.0, true, {0.7})};
  sign.measurement = true;
  const std::vector<Hypothesis> all = {stiff, sign, mass};
  const auto found = instantiate(all, *model.reduced, f);
  using Ids = std::vector<std::string>;
  Ids expected = {"stiff@global in mid", "stiff@global in late", "stiff@global from state mid on", "stiff@global"};
  const Ids in_some = {" in mid", " in late", " from state mid on", " in reference", " before state late", ""};
  for (const std::string& states : in_some)
    for (const char* channel : {"a", "b", "c"}) expected.push_back(std::string("sign@channel:") + channel + states);
  for (const std::string& states : in_some) expected.push_back("mass@global" + states);
  EXPECT_EQ(ids(found), expected);
  const auto acts = [&](std::size_t i) {
    std::string out;
    for (const auto& condition : f.conditions) out += found.candidates[i]->acts_in(condition) ? '1' : '0';
    return out;
  };
  EXPECT_EQ(acts(0), "010");
  EXPECT_EQ(acts(2), "011");
  EXPECT_EQ(acts(3), "111");
  EXPECT_EQ(acts(4), "010");
  EXPECT_EQ(acts(21), "111");
  EXPECT_EQ(acts(26), "110");
  double sum = 0.0;
  for (const auto& c : found.candidates) sum += c->hypothesis->id == "stiff" ? std::exp(c->log_prior) : 0.0;
  EXPECT_NEAR(sum, 1.0 / 3.0, 1e-12);
}

TEST(Instantiate, DampersOfATypeAreOneLocation) {
  const RowModel model(4, [](diagnosis::Places& places) {
    for (const int i : {0, 1, 2}) {
      Place damper;
      damper.id = "damper:D" + std::to_string(i);
      damper.directions.resize(4, 1);
      damper.directions.insert(i, 0) = 1.0;
      damper.attributes = {{"type", i == 1 ? 7.0 : 3.0}};
      places.sets["dampers"].push_back(damper);
    }
    Place type = places.sets["dampers"][0];
    type.id = "dampers:D0,D2";
    places.sets["damper_types"] = {type};
  });
  const std::vector<Hypothesis> all = {family("h", "damper_types", "damper.damping")};
  const auto found = instantiate(all, *model.reduced, two_modes_at_channels());
  ASSERT_EQ(found.candidates.size(), 1U);
  ASSERT_EQ(found.candidates[0]->places.size(), 2U);
  EXPECT_EQ(found.candidates[0]->places[0]->id, "damper:D0");
  EXPECT_EQ(found.candidates[0]->places[1]->id, "damper:D2");
}

TEST(Instantiate, AFactorNeedsSomethingToScale) {
  // Nodes of a matrix model have a mass and no stiffness; no support is gauged, so that none can settle.
  const RowModel model;
  const FeatureSet f = two_modes_at_channels();
  EXPECT_TRUE(instantiate({family("h", "nodes", "scale.stiffness")}, *model.reduced, f).candidates.empty());
  EXPECT_TRUE(instantiate({family("h", "nodes", "support.settle")}, *model.reduced, f).candidates.empty());
  EXPECT_EQ(instantiate({family("h", "nodes", "scale.mass")}, *model.reduced, f).candidates.size(), 4U);
}

TEST(CandidateValue, IsANumberAnUnknownOrANumberOfThePlace) {
  const RowModel model(4, add_stay);
  Hypothesis h = family("h", "stays", "stay.pull");
  h.unknowns = {unknown("p", 1.0, 10.0, true), unknown("q", -1.0, 1.0, false)};
  const std::vector<Hypothesis> all = {h};
  const auto found = instantiate(all, *model.reduced, two_modes_at_channels());
  const Candidate& c = *found.candidates.at(0);
  const Eigen::Vector2d a(std::log(3.0), 0.25);
  EXPECT_EQ(c.value({4.0, "", 0}, a), 4.0);
  EXPECT_NEAR(c.value({2.0, "$p", 0}, a), 6.0, 1e-12);
  EXPECT_NEAR(c.value({2.0, "$q", 0}, a), 0.5, 1e-12);
  EXPECT_NEAR(c.value({2.0, "f_cable", 0}, a), 3.0, 1e-12);
  EXPECT_EQ(c.value({2.0, "friction", 0}, a), 0.0);  // a number that this place does not have
  EXPECT_THROW((void)c.value({1.0, "$r", 0}, a), InputError);
  EXPECT_THROW((void)c.value({1.0, "nothing", 0}, a), InputError);
}

TEST(NumberOf, ReadsTheKeyThatIsAsked) {
  diagnosis::Condition c;
  c.amplitude_m = 1.0;
  c.temperature_C = 2.0;
  c.wind_m_s = 3.0;
  c.direction_deg = 4.0;
  c.people = 5.0;
  EXPECT_EQ(number_of(c, "amplitude_m"), 1.0);
  EXPECT_EQ(number_of(c, "temperature_C"), 2.0);
  EXPECT_EQ(number_of(c, "wind_m_s"), 3.0);
  EXPECT_EQ(number_of(c, "direction_deg"), 4.0);
  EXPECT_EQ(number_of(c, "people"), 5.0);
  EXPECT_EQ(number_of(c, "dampers"), std::nullopt);
  c.dampers_on = false;
  EXPECT_EQ(number_of(c, "dampers"), 0.0);
  c.dampers_on = true;
  EXPECT_EQ(number_of(c, "dampers"), 1.0);
  EXPECT_EQ(number_of(c, "moon"), std::nullopt);
}

}  // namespace
}  // namespace twindeck::tests
