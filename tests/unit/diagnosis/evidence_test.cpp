// What is published about the Ponte del Mare, as the account states it. Oracles: the printed numbers themselves (Table 8's
// changes against the ranges of section 4.2, (0.92/0.748)² - 1, Table 10's diagonal) and, for Table 13, the ratio computed here
// from M1's own row; made-up errors without a channel that stands off; Student's law of two and six degrees of freedom in
// tables.
#include "diagnosis/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "chain.hpp"
#include "diagnosis/files/feature_files.hpp"
#include "records/measured_tables.hpp"
#include "test_places.hpp"

namespace twindeck::tests {
namespace {

const std::filesystem::path kFeatures = std::string(TWINDECK_SOURCE_DIR) + "/data/ponte_del_mare/features";

std::vector<diagnosis::Finding> account() {
  diagnosis::Places places;
  places.sets["supports"] = {{"support:ramp", {72.0, 3.0, 11.0}, {}, {}, {}, {}, {}},
                             {"support:mast", {0.0, 0.0, 0.0}, {}, {}, {}, {}, {}}};
  places.sets["damper_types"] = {{"dampers:C1,C2,C3,C4", {0.0, 0.0, 0.0}, {}, {}, {}, {}, {}}};
  return diagnosis::account_of(diagnosis::read_claims(kFeatures), diagnosis::read_all_features(kFeatures),
                               records::read_channels(kFeatures / "channels.csv"), places);
}

const diagnosis::Finding& finding(const std::vector<diagnosis::Finding>& all, const std::string& kind) {
  for (const diagnosis::Finding& one : all)
    if (one.kind == kind) return one;
  throw std::runtime_error("no finding " + kind);
}

TEST(Evidence, PublishedUpdatingEndsOnFourBoundsAndLeavesPairsThatAreNone) {
  const auto all = account();
  const auto& bounds = finding(all, "bounds").names;
  ASSERT_EQ(bounds.size(), 4u);
  for (const char* name : {"E_c2 ", "E_s ", "E_s_stay_44 ", "rho_2 "})
    EXPECT_TRUE(std::any_of(bounds.begin(), bounds.end(), [&](const auto& n) { return n.starts_with(name); })) << name;
  const auto& shapes = finding(all, "shapes").names;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0], "2X-2N (0.42)");
  EXPECT_EQ(shapes[1], "5X-5N (0.38)");
  EXPECT_EQ(shapes[2], "11X-13N (0.49)");
}

TEST(Evidence, DampersStiffenTheFirstModeByHalf) {
  const diagnosis::Finding dampers = finding(account(), "dampers");
  EXPECT_EQ(dampers.names, std::vector<std::string>{"1"});
  EXPECT_NE(dampers.text.find("51 %"), std::string::npos) << dampers.text;  // (0.92/0.748)² - 1 = 0.513
  EXPECT_EQ(dampers.candidates, (std::vector<std::string>{"fric@dampers:C1,C2,C3,C4", "dampk@dampers:C1,C2,C3,C4"}));
}

// 1.2² - 1 = 44 % more stiffness; 2 · 1.44 · hypot(2.5 %, 2.5 %/1.2) = 9 % is its deviation, 11 % with 3 % of each frequency:
// a quarter of the change lies between.
TEST(Evidence, DampersStiffenAModeWhereTheChangeIsFourDeviations) {
  diagnosis::FeatureSet features;
  features.conditions.resize(2);
  features.conditions[0].dampers_on = false;
  features.conditions[1].dampers_on = true;
  const auto account_with = [&](double deviation_Hz) {
    features.rows = {{diagnosis::RowType::frequency, "1", -1, "", 0, 1.0, deviation_Hz, false},
                     {diagnosis::RowType::frequency, "1", -1, "", 1, 1.2, deviation_Hz, false}};
    return diagnosis::account_of({}, features, {}, {});
  };
  const auto clear = account_with(0.025);
  ASSERT_EQ(clear.size(), 1u);
  EXPECT_NE(clear[0].text.find("44 % (+- 9)"), std::string::npos) << clear[0].text;
  EXPECT_TRUE(account_with(0.030).empty());
}

TEST(Evidence, OneAccelerometerStandsOffInEveryWindModelAndEvent) {
  const auto all = account();
  std::vector<std::string> channels;
  for (const diagnosis::Finding& one : all)
    if (one.kind == "channel") channels.push_back(one.names[0]);
  EXPECT_EQ(channels, std::vector<std::string>{"M1"});  // and none of the seven others
  EXPECT_EQ(finding(all, "channel").candidates, (std::vector<std::string>{"gain@channel:M1", "brg@support:ramp"}));
  EXPECT_NE(finding(all, "channel").split_by.find("M1"), std::string::npos);
  const auto factors = diagnosis::channel_factors(diagnosis::read_claims(kFeatures));
  ASSERT_EQ(factors.size(), 8u);
  EXPECT_EQ(factors[0].records, 6);
  // Raw mean of ln(1 + error) of M1 is 0.79; the records' own levels, medians over channels, lie within 0.2 of nothing.
  const double raw =
      (std::log(2.216) + std::log(2.3664) + std::log(1.7194) + std::log(2.1513) + std::log(2.1931) + std::log(2.7405)) / 6.0;
  EXPECT_NEAR(std::log(factors[0].factor), raw, 0.2);
  EXPECT_LT(factors[0].p_value, 0.05);
  for (std::size_t i = 1; i < factors.size(); ++i) EXPECT_GT(factors[i].p_value, 0.3) << factors[i].channel;
}

TEST(Evidence, ErrorsThatAllChannelsShareNameNone) {
  std::vector<diagnosis::Claim> claims;
  for (int record = 0; record < 3; ++record)
    for (int channel = 0; channel < 6; ++channel)
      claims.push_back({diagnosis::Claim::Kind::rms_error, "c" + std::to_string(channel), "r" + std::to_string(record),
                        100.0 + 10.0 * record + 3.0 * ((channel * 5 + record) % 6), 0.0, 0.0, ""});
  for (const auto& factor : diagnosis::channel_factors(claims)) EXPECT_GT(factor.p_value, 0.05) << factor.channel;
  EXPECT_TRUE(diagnosis::channel_factors({claims.begin(), claims.begin() + 3}).empty());  // too few to stand off from
}

// Oracle: Student's law on two degrees of freedom, p = 1 - t / sqrt(2 + t²), times the four channels. A new value has the
// deviation s sqrt(1 + 1/3) from the mean of three.
TEST(Evidence, AChannelIsHeldAgainstTheScatterOfTheOthers) {
  const double s = 0.05, off = 12.0 * s, logarithm[] = {off, -s, 0.0, s};
  std::vector<diagnosis::Claim> claims;
  for (int channel = 0; channel < 4; ++channel)
    claims.push_back({diagnosis::Claim::Kind::rms_error, "c" + std::to_string(channel), "r",
                      100.0 * std::expm1(logarithm[channel]), 0.0, 0.0, ""});
  const auto factors = diagnosis::channel_factors(claims);
  ASSERT_EQ(factors.size(), 4u);
  const double t = off / (s * std::sqrt(1.0 + 1.0 / 3.0));
  EXPECT_NEAR(factors[0].p_value, 4.0 * (1.0 - t / std::sqrt(2.0 + t * t)), 1e-9);
  EXPECT_NEAR(factors[0].others, s, 1e-12);
  // The record's level is the median of the four.
  EXPECT_NEAR(std::log(factors[0].factor), off - 0.5 * s, 1e-12);
  EXPECT_EQ(factors[0].lowest, factors[0].highest);
}

/// A chain with dampers of one make at its masses 4 and 9, which may also stand the other way round.
struct TwoDampers {
  TwoDampers() : chain({.masses = 12, .modes = 4}), places(chain.places()) {
    const auto force = [](int dof, int column, Eigen::SparseMatrix<double>& to) { to.insert(dof, column) = 1.0; };
    diagnosis::Place all{"dampers:A,B", Eigen::Vector3d::Zero(), {}, {}, {}, {{"type", 0.0}}, {}};
    diagnosis::Place moved{"dampers:A,B@exchanged", Eigen::Vector3d::Zero(), {}, {}, {}, {}, {}};
    moved.directions.resize(12, 2);
    const std::pair<std::string, int> where[] = {{"A", 3}, {"B", 8}};
    for (int i = 0; i < 2; ++i) {
      diagnosis::Place damper{
          "damper:" + where[i].first,
          Eigen::Vector3d::Zero(),
          {},
          {},
          {},
          {{"damping", i == 0 ? 4e3 : 9e3}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 0.0}, {"type", 0.0}},
          {}};
      damper.directions.resize(12, 1);
      force(where[i].second, 0, damper.directions);
      force(where[1 - i].second, i, moved.directions);
      places.sets["dampers"].push_back(damper);
    }
    places.sets["damper_types"] = {all};
    places.sets["damper_moves"] = {moved};
    reduced = std::make_unique<diagnosis::ReducedModel>(chain.structure(), places, diagnosis::ReductionOptions{});
    features = chain.measure(chain.as_modelled());
    features.conditions[0].dampers_on = true;
    for (int m = 1; m <= 4; ++m)
      features.rows.push_back({diagnosis::RowType::damping, std::to_string(m), -1, "", 0, 1.0, 0.1, false});
    hypotheses = catalogue({"fric", "dampc"});
    for (diagnosis::Hypothesis& h :
         diagnosis::read_catalogue(std::string(TWINDECK_SOURCE_DIR) + "/workflows/ponte_del_mare/hypotheses"))
      if (h.id == "fric" || h.id == "dampplace") hypotheses.push_back(h);
    entries = diagnosis::instantiate(hypotheses, *reduced, features);
    map = std::make_unique<diagnosis::FeatureMap>(*reduced, features, diagnosis::ScatterOptions{});
  }
  [[nodiscard]] const diagnosis::Candidate* entry(const std::string& id) const {
    for (const auto& candidate : entries.candidates)
      if (candidate->id() == id) return candidate.get();
    throw std::runtime_error("no entry " + id);
  }
  [[nodiscard]] Eigen::VectorXd rows(const std::vector<diagnosis::Cause>& causes) const {
    const auto base = map->base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(map->nuisances().size())));
    return map->predict(base, causes, false).g;
  }
  Chain chain;
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
  diagnosis::FeatureSet features;
  std::vector<diagnosis::Hypothesis> hypotheses;
  diagnosis::Instantiated entries;
  std::unique_ptr<diagnosis::FeatureMap> map;
};

// Oracle: the same cause at each damper by itself.
TEST(DampersOfOneMake, AreHeldTogetherAsEachByItself) {
  const TwoDampers two;
  Eigen::VectorXd a(2);
  a << std::log(2000.0), std::log(1.5e6);
  const Eigen::VectorXd together = two.rows({{two.entry("fric@dampers:A,B"), a}});
  const Eigen::VectorXd each = two.rows({{two.entry("fric@damper:A"), a}, {two.entry("fric@damper:B"), a}});
  EXPECT_LT((together - each).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((together - two.rows({})).cwiseAbs().maxCoeff(), 0.01);
}

// Oracle: dampers that change places are dampers that exchange their constants, 4 and 9 kN s/m.
TEST(DampersElsewhere, ActWhereTheyAreMovedTo) {
  const TwoDampers two;
  const Eigen::VectorXd moved = two.rows({{two.entry("dampplace@dampers:A,B@exchanged"), Eigen::VectorXd(0)}});
  const Eigen::VectorXd up = Eigen::VectorXd::Constant(1, std::log(9.0 / 4.0));
  const Eigen::VectorXd exchanged = two.rows({{two.entry("dampc@damper:A"), up}, {two.entry("dampc@damper:B"), -up}});
  EXPECT_LT((moved - exchanged).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((moved - two.rows({})).cwiseAbs().maxCoeff(), 1e-3);
}

// Oracle: the definition. What the model's form leaves open is one unknown of a mode in all conditions, on top of each one's
// own error.
TEST(ModelForm, IsCommonToTheConditionsOfAMode) {
  const Chain chain({.masses = 8, .modes = 3, .shapes = false});
  auto features = chain.measure(chain.as_modelled());
  features.conditions.push_back(features.conditions[0]);
  features.conditions[1].name = "later";
  for (int m = 0; m < 3; ++m) {
    features.rows.push_back(features.rows[static_cast<std::size_t>(m)]);
    features.rows.back().condition = 1;
  }
  diagnosis::ScatterOptions scatter;
  scatter.model_form = 0.03;
  const diagnosis::FeatureMap map(chain.reduced(), features, scatter);
  const Eigen::MatrixXd& c = map.covariance();
  EXPECT_NEAR(c(0, 0), 0.003 * 0.003 + 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(c(0, 3), 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(c(0, 4), 0.0, 1e-15);
}

// Oracle: K/16 leaves shapes alone and divides every frequency by four. Few of the model's modes lie below the highest measured
// one then, and every measured mode must find its own all the same.
TEST(FeatureMap, PredictsEveryModeOfAStructureFourTimesAsSlow) {
  const Chain chain({.masses = 8, .modes = 6});
  ChainTruth truth = chain.as_modelled();
  truth.spring /= 16.0;
  diagnosis::FeatureSet measured = chain.measure(truth);
  for (auto& row : measured.rows) row.held_out = false;  // what is held out says nothing of the pairs
  const diagnosis::FeatureMap map(chain.reduced(), measured, {});
  const auto prediction =
      map.predict(map.base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(map.nuisances().size()))), {}, false);
  ASSERT_TRUE(prediction.valid);
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    EXPECT_NEAR(prediction.frequency_Hz[m] / map.measured_modes()[m].frequency_Hz, 4.0, 1e-6) << m;
    EXPECT_NEAR(prediction.mac[m], 1.0, 1e-9) << m;
  }
}

}  // namespace
}  // namespace twindeck::tests
