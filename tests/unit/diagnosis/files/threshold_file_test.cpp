// Kept thresholds. Oracles: what was written, read back; SHA-256 of "abc" (FIPS 180-4); a key for every circumstance that a
// threshold depends on.
#include "diagnosis/files/threshold_file.hpp"

#include <functional>

#include "io/manifest.hpp"
#include "unit/diagnosis/chain.hpp"
#include "unit/io/temporary_folder.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::Hypothesis;
using diagnosis::ThresholdRules;

constexpr const char* kHashOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

class ThresholdFile : public io::test::TemporaryFolder {
 protected:
  std::string said(const std::filesystem::path& file, const std::string& key) const {
    return refusal([&] { (void)diagnosis::read_threshold(file, key); });
  }
};

TEST_F(ThresholdFile, IsNamedByTheHashOfItsKey) {
  EXPECT_EQ(diagnosis::threshold_file("kept", "abc"), std::filesystem::path("kept") / "ba7816bf8f01cfea.toml");
}

TEST_F(ThresholdFile, HoldsWhatWasWritten) {
  const std::filesystem::path file = folder_ / "t.toml";
  EXPECT_FALSE(diagnosis::read_threshold(file, "abc").has_value());
  diagnosis::write_threshold(3.1415926, 200, 0.99, file, "abc");
  const auto read = diagnosis::read_threshold(file, "abc");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(*read, 3.141593);
  const std::string body = std::string("threshold = 3.141593\nnull_data_sets = 200\nkey = \"") + kHashOfAbc + "\"\n";
  EXPECT_EQ(content(file), "# 200 null data sets, quantile 0.99 of the largest log odds\n" + body + "check = \"" +
                               io::sha256_of_text(body) + "\"\n");
}

TEST_F(ThresholdFile, ThatWasChangedIsRefused) {
  const std::filesystem::path file = folder_ / "t.toml";
  const std::string refused =
      "t.toml: threshold: is not what a run of s9_diagnosis kept for these data; remove the file: the null data sets are run "
      "again";
  diagnosis::write_threshold(3.25, 200, 0.99, file, "abc");
  const std::string kept = content(file);
  EXPECT_EQ(said(file, "abc"), "");
  EXPECT_EQ(said(file, "abd"), refused);
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"3.250000", "3.250001"},
                                 {"= 200", "= 20"},
                                 {"key = \"ba", "key = \"bb"},
                                 {"check = \"", "check = \"0"},
                                 {"3.250000", "inf"}}) {
    std::string other = kept;
    other.replace(other.find(from), from.size(), to);
    EXPECT_EQ(said(write("t.toml", other), "abc"), refused) << to;
  }
  std::string none = kept;
  none.replace(none.find("3.250000"), 8, "\"high\"");
  EXPECT_EQ(said(write("t.toml", none), "abc"),
            "t.toml: is not what a run of s9_diagnosis kept for these data; remove the file: the null data sets are run again");
}

/// What a threshold depends on beside the model.
struct Circumstances {
  ThresholdRules rules;
  FeatureSet features;
  std::vector<Hypothesis> catalogue;
  std::uint64_t seed = 1;
};
using Change = std::function<void(Circumstances&)>;

std::vector<Change> other_rules() {
  return {[](Circumstances& c) { c.seed = 2; },
          [](Circumstances& c) { c.rules.alpha = 0.02; },
          [](Circumstances& c) { c.rules.nulls = 101; },
          [](Circumstances& c) { c.rules.modes = 21; },
          [](Circumstances& c) { c.rules.most_refined = 4; },
          [](Circumstances& c) { c.rules.refine_within = 2.5; },
          [](Circumstances& c) { c.rules.pairs = std::vector<std::string>{"b"}; },
          [](Circumstances& c) { c.rules.scatter.element_stiffness = 0.5; },
          [](Circumstances& c) { c.rules.scatter.element_mass = 0.5; },
          [](Circumstances& c) { c.rules.scatter.node_mass = 0.5; },
          [](Circumstances& c) { c.rules.scatter.stay_stiffness = 0.5; },
          [](Circumstances& c) { c.rules.scatter.stay_pull = 0.5; },
          [](Circumstances& c) { c.rules.scatter.gain = 0.5; },
          [](Circumstances& c) { c.rules.scatter.frequency_floor = 0.5; },
          [](Circumstances& c) { c.rules.scatter.damping_floor = 0.5; },
          [](Circumstances& c) { c.rules.scatter.shape_floor = 0.5; },
          [](Circumstances& c) { c.rules.scatter.load_model = 0.5; },
          [](Circumstances& c) { c.rules.scatter.model_form = 0.5; },
          [](Circumstances& c) { c.rules.scatter.fine = 0.5; },
          [](Circumstances& c) { c.rules.scatter.noise = 0.5; },
          [](Circumstances& c) { c.rules.scatter.damping_by_dampers = true; }};
}

std::vector<Change> other_rows() {
  return {[](Circumstances& c) { c.features.conditions[0].name = "storm"; },
          [](Circumstances& c) { c.features.conditions[0].state = "damaged"; },
          [](Circumstances& c) { c.features.conditions[0].dampers_on = true; },
          [](Circumstances& c) { c.features.conditions[0].dampers_on = false; },
          [](Circumstances& c) { c.features.conditions[0].amplitude_channel = "c1"; },
          [](Circumstances& c) { c.features.conditions[0].load = "truck"; },
          [](Circumstances& c) { c.features.conditions[0].amplitude_m = 0.5; },
          [](Circumstances& c) { c.features.conditions[0].temperature_C = 0.5; },
          [](Circumstances& c) { c.features.conditions[0].wind_m_s = 0.5; },
          [](Circumstances& c) { c.features.conditions[0].direction_deg = 0.5; },
          [](Circumstances& c) { c.features.conditions[0].people = 0.5; },
          [](Circumstances& c) { c.features.rows[1].type = diagnosis::RowType::shape_imag; },
          [](Circumstances& c) { c.features.rows[1].mode = "9"; },
          [](Circumstances& c) { c.features.rows[1].channel = 3; },
          [](Circumstances& c) { c.features.rows[1].stay = "S"; },
          [](Circumstances& c) { c.features.rows[1].condition = 1; },
          [](Circumstances& c) { c.features.rows[1].std = 0.77; },
          [](Circumstances& c) { c.features.rows[1].held_out = true; },
          [](Circumstances& c) { c.features.rows.pop_back(); },
          [](Circumstances& c) { c.features.covariance = Eigen::MatrixXd(Eigen::MatrixXd::Identity(2, 2)); },
          [](Circumstances& c) { c.features.covariance = Eigen::MatrixXd(2.0 * Eigen::MatrixXd::Identity(2, 2)); }};
}

std::vector<Change> other_causes() {
  return {[](Circumstances& c) { c.catalogue[0].id = "x"; },
          [](Circumstances& c) { c.catalogue[0].set = "x"; },
          [](Circumstances& c) { c.catalogue[0].filter = "x"; },
          [](Circumstances& c) { c.catalogue[0].prior_weight = 0.123; },
          [](Circumstances& c) { c.catalogue[0].measurement = !c.catalogue[0].measurement; },
          [](Circumstances& c) { c.catalogue[0].unknowns[0].name = "x"; },
          [](Circumstances& c) { c.catalogue[0].unknowns[0].log = !c.catalogue[0].unknowns[0].log; },
          [](Circumstances& c) { c.catalogue[0].unknowns[0].low.factor = 0.0123; },
          [](Circumstances& c) { c.catalogue[0].unknowns[0].high.name = "x"; },
          [](Circumstances& c) {
            c.catalogue[0].unknowns[0].start.push_back({0.123, "", 0});
          },
          [](Circumstances& c) { c.catalogue[0].actions[0].kind = "x"; },
          [](Circumstances& c) { c.catalogue[0].actions[0].text["variable"] = "people"; },
          [](Circumstances& c) { c.catalogue[0].actions[0].number["factor"].factor = 0.123; },
          [](Circumstances& c) { c.catalogue.pop_back(); }};
}

TEST_F(ThresholdFile, EveryCircumstanceHasAKeyOfItsOwn) {
  const Chain chain({.masses = 4, .modes = 2});
  const FeatureSet features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"stiffness", "gain", "tempE", "settle"}));
  const Circumstances base{{0.01, 100, 20, 3, 2.0, {}, {"a"}}, features, *e.hypotheses, 1};
  std::vector<Change> changes = {[](Circumstances&) {}};
  for (const auto& more : {other_rules(), other_rows(), other_causes()})
    changes.insert(changes.end(), more.begin(), more.end());
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Circumstances c = base;
    changes[i](c);
    const auto key = diagnosis::threshold_key(c.rules, chain.reduced(), c.features, c.catalogue, *e.inference, c.seed);
    const auto [at, is_new] = seen.try_emplace(key, i);
    EXPECT_TRUE(is_new) << "change " << i << " has the key of " << at->second;
  }
}

// A sensor elsewhere has a threshold of its own; vectors of the other sign, as another processor gives them, and rounding do
// not.
TEST_F(ThresholdFile, WhereTheSensorsStandIsPartOfTheKey) {
  const Chain chain({.masses = 4, .modes = 2});
  const FeatureSet features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"stiffness"}));
  diagnosis::ReducedModel model = chain.reduced();
  const auto key = [&] { return diagnosis::threshold_key({}, model, features, *e.hypotheses, *e.inference, 1); };
  model.sensors.row(1).setZero();  // a sensor that sees nothing
  const std::string before = key();
  model.sensors.col(0) *= -1.0;
  model.sensors(1, 0) = 1e-14 * model.sensors.norm();
  EXPECT_EQ(key(), before);
  model.sensors.row(0) *= 1.001;
  EXPECT_NE(key(), before);
}

TEST_F(ThresholdFile, MeasuredValuesAndWordsHaveNoPartInTheKey) {
  const Chain chain({.masses = 4, .modes = 2});
  const FeatureSet features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"stiffness", "gain", "settle"}));
  const auto key = [&](const FeatureSet& f, const std::vector<Hypothesis>& c) {
    return diagnosis::threshold_key({}, chain.reduced(), f, c, *e.inference, 1);
  };
  FeatureSet other = features;
  other.rows[0].value *= 1.5;
  other.rows[0].line = 99;
  std::vector<Hypothesis> words = *e.hypotheses;
  words[0].sentence = words[0].title = words[0].file = "other";
  EXPECT_EQ(key(other, words), key(features, *e.hypotheses));
  // What only load tests show has none where there are none, and one where there are.
  const auto settles = std::find_if(words.begin(), words.end(), [](const Hypothesis& h) { return h.id == "settle"; });
  ASSERT_NE(settles, words.end());
  words.erase(settles);
  EXPECT_EQ(key(features, words), key(features, *e.hypotheses));
  other.rows[0].type = diagnosis::RowType::static_strain;
  EXPECT_NE(key(other, words), key(other, *e.hypotheses));
}

}  // namespace
}  // namespace twindeck::tests
