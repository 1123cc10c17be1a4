// The catalogue as data, and what it becomes for a model and rows. Oracles: counts by hand; the reasons that are promised.
#include "diagnosis/files/catalogue_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "unit/diagnosis/chain.hpp"

namespace twindeck::tests {
namespace {

TEST(Catalogue, HoldsTheFamiliesAndEveryPrimitiveIsKnown) {
  const auto hypotheses = catalogue();
  std::set<std::string> ids;
  for (const auto& h : hypotheses) {
    ids.insert(h.id);
    EXPECT_FALSE(h.title.empty()) << h.id;
    EXPECT_FALSE(h.sentence.empty()) << h.id;
    EXPECT_FALSE(h.remedy.empty()) << h.id;
    EXPECT_FALSE(h.actions.empty()) << h.id;
    for (const auto& action : h.actions) EXPECT_TRUE(diagnosis::action_kinds().contains(action.kind)) << h.id;
  }
  EXPECT_EQ(ids.size(), hypotheses.size());
  EXPECT_GE(ids.size(), 24u);
  for (const char* id : {"foundation", "osc", "tie", "skewclk", "drift", "slack", "flutter"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

TEST(Catalogue, PriorsOfAllEntriesAddUpToOne) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto features = chain.measure(chain.as_modelled());
  const auto hypotheses = catalogue();
  const auto entries = diagnosis::instantiate(hypotheses, chain.reduced(), features);
  double sum = 0.0;
  int swaps = 0, signs = 0;
  for (const auto& candidate : entries.candidates) {
    sum += std::exp(candidate->log_prior);
    swaps += candidate->hypothesis->id == "swap";
    signs += candidate->hypothesis->id == "pol";
    EXPECT_FALSE(candidate->starts.empty()) << candidate->id();
    for (const auto& a : candidate->starts)
      for (Eigen::Index i = 0; i < a.size(); ++i) {
        EXPECT_GE(a[i], candidate->low[i]) << candidate->id();
        EXPECT_LE(a[i], candidate->high[i]) << candidate->id();
      }
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(swaps, 15);  // six channels, two at a time
  EXPECT_EQ(signs, 6);
}

TEST(Catalogue, WhatTheseRowsCannotSeeIsSaidWithTheReason) {
  const Chain chain({.masses = 6, .modes = 4, .shapes = false});
  const auto features = chain.measure(chain.as_modelled());
  const auto hypotheses = catalogue();
  const auto entries = diagnosis::instantiate(hypotheses, chain.reduced(), features);
  std::map<std::string, std::string> reasons;
  for (const auto& none : entries.invisible) reasons[none.hypothesis] = none.reason;
  EXPECT_NE(reasons["pol"].find("no row of type shape"), std::string::npos) << reasons["pol"];
  EXPECT_NE(reasons["tempE"].find("temperature_C"), std::string::npos) << reasons["tempE"];
  EXPECT_NE(reasons["fric"].find("dampers = on"), std::string::npos) << reasons["fric"];
  EXPECT_FALSE(reasons.contains("stiffness"));
  // Every family is either looked for or listed.
  std::set<std::string> known;
  for (const auto& candidate : entries.candidates) known.insert(candidate->hypothesis->id);
  for (const auto& h : hypotheses) EXPECT_NE(known.contains(h.id), reasons.contains(h.id)) << h.id;
}

// Oracle: the message as a user reads it: file, line, key, what it is and what was expected.
TEST(Catalogue, NumbersThatAreNoneAreRefusedWithTheirLine) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("twindeck-catalogue-" + std::to_string(::getpid()));
  const auto said = [&](const std::string& weight, const std::string& low, const std::string& rest = "") -> std::string {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "gain.toml") << "[hypothesis]\nid = \"gain\"\nprior_weight = " << weight
                                        << "\n[location]\nset = \"channels\"\n[[parameter]]\nname = \"f\"\nlow = " << low
                                        << "\nhigh = 2.0\n[[action]]\nkind = \"channel.gain\"\nfactor = \"$f\"\n"
                                        << rest;
    try {
      const auto read = diagnosis::read_catalogue(folder);
      return read.front().id;
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder.string().size() + 1);
    }
  };
  EXPECT_EQ(said("0.5", "0.5"), "gain");
  for (const char* weight : {"nan", "-1.0", "0", "0.0", "-inf", "inf", "1e300", "\"2*k_drive\"", "\"often\""})
    EXPECT_TRUE(said(weight, "0.5").starts_with("gain.toml:3: prior_weight: is ")) << said(weight, "0.5");
  EXPECT_EQ(said("nan", "0.5"), "gain.toml:3: prior_weight: is nan, expected a finite number; correct the value");
  EXPECT_EQ(said("-1", "0.5"), "gain.toml:3: prior_weight: is -1, expected a number above 0; 1 is the weight of most causes");
  EXPECT_TRUE(said("1", "nan").starts_with("gain.toml:8: low: is nan, expected a finite number"));
  EXPECT_TRUE(said("1", "\"nan*k_drive\"").starts_with("gain.toml:8: low: is \"nan*k_drive\", expected a finite number"));
  EXPECT_TRUE(said("1", "[1]").starts_with("gain.toml:8: low: is an array, expected a number or a text"));
  EXPECT_EQ(said("1", "1", "[needs]\nrow = [\"shape\"]\n"), "gain.toml:14: unknown key 'row'; did you mean 'rows'?");
  std::ofstream(folder / "gain.toml") << "action = [1]\n";
  EXPECT_THROW((void)diagnosis::read_catalogue(folder), InputError);
  std::filesystem::remove_all(folder);
}

TEST(Catalogue, BoundsThatAreNoneAreRefused) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto features = chain.measure(chain.as_modelled());
  auto hypotheses = catalogue({"gain"});
  hypotheses[0].unknowns[0].low = {3.0, "", 7};
  hypotheses[0].unknowns[0].high = {2.0, "", 8};
  EXPECT_THROW((void)diagnosis::instantiate(hypotheses, chain.reduced(), features), InputError);
  hypotheses = catalogue({"gain"});
  hypotheses[0].unknowns[0].low = {1.0, "k_drift", 7};
  EXPECT_THROW((void)diagnosis::instantiate(hypotheses, chain.reduced(), features), InputError);
}

TEST(Features, TheRuleHoldsOutTheExtremesAndTheHighestMode) {
  diagnosis::FeatureSet f;
  for (const double amplitude : {0.001, 0.002, 0.01}) {
    diagnosis::Condition c;
    c.name = "a" + std::to_string(f.conditions.size());
    c.amplitude_m = amplitude;
    f.conditions.push_back(c);
    const int modes = f.conditions.size() == 1 ? 4 : 3;
    for (int m = 0; m < modes; ++m)
      f.rows.push_back({diagnosis::RowType::frequency, std::to_string(m + 1), -1, "", static_cast<int>(f.conditions.size()) - 1,
                        1.0 + m, 0.01, false});
  }
  diagnosis::hold_out_by_rule(f);
  std::vector<std::string> held;
  for (const auto& row : f.rows)
    if (row.held_out) held.push_back(f.conditions[static_cast<std::size_t>(row.condition)].name + "/" + row.mode);
  EXPECT_EQ(held, (std::vector<std::string>{"a0/4", "a2/1", "a2/2", "a2/3"}));
  // Marks of the file win over the rule.
  for (auto& row : f.rows) row.held_out = false;
  f.rows[1].held_out = true;
  diagnosis::hold_out_by_rule(f);
  EXPECT_EQ(std::count_if(f.rows.begin(), f.rows.end(), [](const auto& row) { return row.held_out; }), 1);
}

}  // namespace
}  // namespace twindeck::tests
