// The catalogue as data, and what it becomes for a model and rows. Oracles: counts by hand; the reasons that are promised.
#include "diagnosis/files/catalogue_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "unit/diagnosis/chain.hpp"
#include "unit/io/temporary_folder.hpp"

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

/// A file of a folder with one cause; what is said of it.
class CatalogueFile : public io::test::TemporaryFolder {
 protected:
  static constexpr const char* kHypothesis = "[hypothesis]\nid = \"h\"\n";
  static constexpr const char* kLocation = "[location]\nset = \"nodes\"\n";
  static constexpr const char* kAction = "[[action]]\nkind = \"mass.add\"\nmass = 2.5\n";
  std::string said(const std::string& text) const {
    write("catalogue/h.toml", text);
    return refusal([&] { (void)diagnosis::read_catalogue(folder_ / "catalogue"); });
  }
  /// Of a sound file with further lines from line 8.
  std::string said_of(const std::string& more) const { return said(std::string(kHypothesis) + kLocation + kAction + more); }
};

TEST_F(CatalogueFile, IsReadAsItStands) {
  write("catalogue/h.toml",
        "[hypothesis]\nid = \"h\"\ntitle = \"T\"\nside = \"measurement\"\nprior_weight = 0.25\n[location]\nset = "
        "\"pairs(channels)\"\nfilter = \"same_direction\"\n[[parameter]]\nname = \"k\"\nunit = \"N/m\"\nlow = "
        "\"0.05*k_drive\"\nhigh = \"20*k_drive\"\nstart = [\"k_drive\", 3]\n[[parameter]]\nname = \"z\"\nlow = -1\nhigh = "
        "2.5\nscale = \"lin\"\n[[action]]\nkind = \"field.stiffness\"\nvariable = \"wind_m_s\"\nrate = \"-2*$z\"\nreference "
        "= 4\n[needs]\nconditions = { wind_m_s = \"known\" }\ndistinct = { people = 3 }\nrows = [\"shape\", "
        "\"frequency_Hz\"]\n[report]\nsentence = \"S\"\nremedy = \"R\"\n");
  const auto read = diagnosis::read_catalogue(folder_ / "catalogue");
  ASSERT_EQ(read.size(), 1U);
  const diagnosis::Hypothesis& h = read[0];
  EXPECT_EQ(h.id + h.title + h.set + h.filter + h.sentence + h.remedy, "hTpairs(channels)same_directionSR");
  EXPECT_TRUE(h.measurement);
  EXPECT_EQ(h.prior_weight, 0.25);
  ASSERT_EQ(h.unknowns.size(), 2U);
  EXPECT_EQ(h.unknowns[0].unit, "N/m");
  EXPECT_TRUE(h.unknowns[0].log);
  EXPECT_EQ(h.unknowns[0].low.factor, 0.05);
  EXPECT_EQ(h.unknowns[0].low.name, "k_drive");
  EXPECT_EQ(h.unknowns[0].low.line, 12);
  EXPECT_EQ(h.unknowns[0].high.factor, 20.0);
  ASSERT_EQ(h.unknowns[0].start.size(), 2U);
  EXPECT_EQ(h.unknowns[0].start[0].factor, 1.0);
  EXPECT_EQ(h.unknowns[0].start[0].name, "k_drive");
  EXPECT_EQ(h.unknowns[0].start[1].factor, 3.0);
  EXPECT_FALSE(h.unknowns[1].log);
  EXPECT_EQ(h.unknowns[1].low.factor, -1.0);
  ASSERT_EQ(h.actions.size(), 1U);
  EXPECT_EQ(h.actions[0].primitive, diagnosis::Primitive::field_stiffness);
  EXPECT_EQ(h.actions[0].line, 21);
  EXPECT_EQ(h.actions[0].text.at("variable"), "wind_m_s");
  EXPECT_EQ(h.actions[0].number.at("rate").factor, -2.0);
  EXPECT_EQ(h.actions[0].number.at("rate").name, "$z");
  EXPECT_EQ(h.actions[0].number.at("reference").factor, 4.0);
  EXPECT_EQ(h.needs.conditions, (std::map<std::string, std::string>{{"wind_m_s", "known"}}));
  EXPECT_EQ(h.needs.distinct, (std::map<std::string, int>{{"people", 3}}));
  EXPECT_EQ(h.needs.rows, (std::vector<std::string>{"shape", "frequency_Hz"}));
}

TEST_F(CatalogueFile, AFolderWithoutCausesIsRefused) {
  const auto folder = [&](const std::string& name) {
    return refusal([&] { (void)diagnosis::read_catalogue(folder_ / name); });
  };
  EXPECT_EQ(folder("none"), "none: is no folder, expected the catalogue of hypotheses; give --catalogue DIR");
  write("empty/README.md", "");
  EXPECT_EQ(folder("empty"), "empty: holds no *.toml, expected one for each cause");
}

TEST_F(CatalogueFile, CausesComeByTheirFilesAndHaveIdsOfTheirOwn) {
  const std::string rest = std::string(kLocation) + kAction;
  write("catalogue/b.toml", "[hypothesis]\nid = \"first\"\n" + rest);
  write("catalogue/a.toml", "[hypothesis]\nid = \"second\"\n" + rest);
  const auto read = diagnosis::read_catalogue(folder_ / "catalogue");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].id, "second");
  EXPECT_EQ(read[1].id, "first");
  write("catalogue/a.toml", "[hypothesis]\nid = \"first\"\n" + rest);
  EXPECT_EQ(refusal([&] { (void)diagnosis::read_catalogue(folder_ / "catalogue"); }),
            "catalogue/b.toml: id: 'first' is the id of another file too; give each its own");
}

TEST_F(CatalogueFile, WhatIsMissingIsNamed) {
  EXPECT_EQ(said_of(""), "");
  EXPECT_EQ(said(std::string(kLocation) + kAction),
            "catalogue/h.toml:1: hypothesis.id: is missing; name the cause: [hypothesis] id = \"…\"");
  EXPECT_EQ(said(std::string(kHypothesis) + kAction),
            "catalogue/h.toml:1: location.set: is missing; say where the cause can sit: [location] set = \"nodes\"");
  EXPECT_EQ(said(std::string(kHypothesis) + kLocation),
            "catalogue/h.toml:1: action: is missing; say what the cause does: [[action]] kind = \"…\"");
  const std::string lacks = ": parameter: lacks name, low or high";
  for (const char* two : {"name = \"k\"\nlow = 1\n", "low = 1\nhigh = 2\n", "name = \"k\"\nhigh = 2\n"}) {
    const std::string text = said_of(std::string("[[parameter]]\n") + two);
    EXPECT_TRUE(text.starts_with("catalogue/h.toml:") && text.ends_with(lacks)) << text;
  }
  EXPECT_EQ(said(std::string(kHypothesis) + kLocation + "[[action]]\nkind = \"element.oscillator\"\nmass = 1\n"),
            "catalogue/h.toml:6: action.frequency: is missing; element.oscillator takes mass, frequency");
}

TEST_F(CatalogueFile, WhatItDoesNotKnowIsRefusedWithItsLine) {
  const std::string at = "catalogue/h.toml:9: ";
  const std::string parameter = "name = \"k\"\nlow = 1\nhigh = 2\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[reports]\n", "catalogue/h.toml:8: unknown key 'reports'; did you mean 'report'?"},
      {"[zzz]\n",
       "catalogue/h.toml:8: unknown key 'zzz'; known keys are hypothesis, location, parameter, action, needs, report"},
      {"[report]\nsentense = \"x\"\n", at + "unknown key 'sentense'; did you mean 'sentence'?"},
      {"[report]\nsentence = 3\n", at + "sentence: is 3, expected text; write it in quotes"},
      {"[[parameter]]\nunits = \"N\"\n" + parameter, at + "unknown key 'units'; did you mean 'unit'?"},
      {"[[parameter]]\nscale = \"ln\"\n" + parameter,
       at + "scale: is 'ln', expected \"lin\" or \"log\"; log suits what may be off by a factor"},
      {"[[parameter]]\nstart = 2\n" + parameter,
       at + "start: is no list of values; give values between low and high, or leave start out"},
      {"[[parameter]]\nlow = \"2x*k_drive\"\nname = \"k\"\nhigh = 2\n",
       at + "low: is '2x*k_drive', expected a number, a name or \"number*name\""},
      {"[[parameter]]\nlow = 3\nname = \"k\"\nhigh = 2\n", at + "k.low: 3 is not below high, 2; exchange them, or correct one"},
      {"[[parameter]]\nlow = 2\nname = \"k\"\nhigh = 2\n", at + "k.low: 2 is not below high, 2; exchange them, or correct one"},
      {"[[parameter]]\nlow = 0\nname = \"k\"\nhigh = 2\n",
       at + "k.low: 0 has no logarithm; give a value above 0, or scale = \"lin\""},
      {"[needs]\nrows = \"shape\"\n", at + "rows: is no list"},
      {"[needs]\nrows = [\"shapes\"]\n", at + "needs.rows: 'shapes' is no type of row (did you mean 'shape'?)"},
      {"[needs]\nrows = [3]\n", at + "needs.rows: '' is no type of row"},
      {"[needs]\nconditions = 3\n", at + "conditions: is 3, expected a table; write [conditions]"}};
  for (const auto& [more, expected] : cases) EXPECT_EQ(said_of(more), expected);
  for (const char* count : {"0", "1001", "2.5", "\"two\""}) {
    const std::string text = said_of(std::string("[needs]\ndistinct = { people = ") + count + " }\n");
    EXPECT_EQ(text, at + "needs.distinct.people: is " + count +
                        ", expected a whole number from 1 to 1000; say how many different values the rows must have");
  }
  for (const char* count : {"1", "1000"})
    EXPECT_EQ(said_of(std::string("[needs]\ndistinct = { people = ") + count + " }\n"), "");
  EXPECT_TRUE(said_of("[needs]\nconditions = { wind = \"known\" }\n")
                  .starts_with(at + "needs.conditions: 'wind' is no key of a condition"));
  EXPECT_TRUE(said_of("[needs]\nconditions = { people = \"knwn\" }\n")
                  .starts_with(at + "needs.conditions.people: is 'knwn' (did you mean 'known'?); use one of "));
  EXPECT_TRUE(
      said_of("[[parameter]]\nlow = \"k_drift\"\nname = \"k\"\nhigh = 2\n")
          .starts_with(at + "low: 'k_drift' is no number of a place (did you mean 'k_drive'?); use a number, or one of "));
}

TEST_F(CatalogueFile, ASideASetAndAnActionAreKnownOnes) {
  const std::string action = std::string(kHypothesis) + kLocation + "[[action]]\n";
  EXPECT_EQ(said(std::string(kHypothesis) + "side = \"sensor\"\n" + kLocation + kAction),
            "catalogue/h.toml:3: side: is 'sensor', expected model or measurement");
  EXPECT_TRUE(
      said(std::string(kHypothesis) + "[location]\nset = \"node\"\n" + kAction)
          .starts_with("catalogue/h.toml:4: location.set: 'node' is no set of locations (did you mean 'nodes'?); use one of "));
  EXPECT_TRUE(
      said(action + "mass = 1\nkind = \"mass.ad\"\n")
          .starts_with("catalogue/h.toml:7: action.kind: unknown primitive 'mass.ad' (did you mean 'mass.add'?); use one of "));
  EXPECT_EQ(said(action + "kind = \"mass.add\"\nmass = 1\nmas = 2\n"),
            "catalogue/h.toml:8: action.mas: is no number of mass.add (did you mean 'mass'?)");
  EXPECT_EQ(said(action + "kind = \"mass.add\"\nmass = \"$m\"\n"),
            "catalogue/h.toml:7: action.mass: names '$m', which is no [[parameter]]");
  EXPECT_EQ(said(action + "kind = \"mass.add\"\nmass = 1\ndirection = \"up\"\n"),
            "catalogue/h.toml:8: direction: is 'up', expected \"vertical\"; leave it out for all directions");
  EXPECT_TRUE(said(action + "kind = \"mass.add\"\nmass = 1\nvariable = \"wind\"\n")
                  .starts_with("catalogue/h.toml:8: action.variable: 'wind' is no key of a condition"));
  EXPECT_EQ(said("hypothesis = 3\n"), "catalogue/h.toml:1: hypothesis: is 3, expected a table; write [hypothesis]");
  EXPECT_EQ(said("action = 3\n"), "catalogue/h.toml:1: action: is 3, expected tables; write [[action]]");
  EXPECT_EQ(said("action = [1]\n"), "catalogue/h.toml:1: action: holds 1, expected tables; write [[action]]");
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
