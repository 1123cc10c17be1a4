// The tier of form errors: its schedule, its truths without a form error against the product's finite elements, the level that
// is reached, and which answers are right. Oracles: the shares that are asked for; two programs that share no code; hand-made
// diagnoses.
#include "blind/form/form_trial.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "blind/form/measurement.hpp"
#include "dynamics/loaded_model.hpp"

namespace twindeck::blind::form {
namespace {

TEST(FormSchedule, SharesHoldForAnyTwentySeeds) {
  for (const std::uint64_t first : {0u, 7u, 9000u, 123456u}) {
    std::map<Category, int> count;
    for (std::uint64_t seed = first; seed < first + 20; ++seed) ++count[turn_of(seed).category];
    EXPECT_EQ(count[Category::sound], 5);
    EXPECT_EQ(count[Category::two_states], 4);
    EXPECT_EQ(count[Category::conditions], 3);
    EXPECT_EQ(count[Category::sensors], 2);
    EXPECT_EQ(count[Category::one_state], 3);
    EXPECT_EQ(count[Category::outside], 3);
  }
}

TEST(FormSchedule, FamiliesMeetLevelsAndKindsEvenly) {
  std::map<std::string, std::map<double, int>> levels;
  std::map<std::string, std::set<Kind>> kinds;
  std::set<std::string> hidden;
  for (std::uint64_t seed = 40; seed < 440; ++seed) {
    const Turn turn = turn_of(seed);
    const std::string name = name_of(turn.category) + " " + turn.family;
    ++levels[name][turn.level];
    kinds[name].insert(turn.kind);
    if (turn.category != Category::sound) hidden.insert(turn.family);
  }
  EXPECT_GE(hidden.size(), 15u);
  for (const auto& [name, of] : levels) {
    EXPECT_EQ(of.size(), 3u) << name;
    int least = 1000, most = 0;
    for (const auto& [level, count] : of) {
      least = std::min(least, count);
      most = std::max(most, count);
    }
    EXPECT_LE(most - least, 1) << name;
    EXPECT_GE(kinds[name].size(), name.ends_with("brace") ? 1u : name.ends_with("lost") ? 2u : 3u) << name;
  }
}

TEST(FormTruth, WithoutFormErrorIsTheCoarseModelOnAFinerMesh) {
  for (const Kind kind : {Kind::girder_1, Kind::girder_2, Kind::girder_3, Kind::frame}) {
    Stream random(3);
    Truth truth;
    truth.layout = draw_layout(kind, random);
    truth.factors = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(truth.layout.quantities.size()));
    const auto loaded = dynamics::from_model(coarse_model(truth.layout));
    const SeenModes seen = measurable_modes(truth, {});
    ASSERT_EQ(seen.frequency_Hz.size(), truth.layout.modes);
    // Parameters stand where the truth has them: what a fit leaves, and how far it has to go, is the mesh alone. A mode of six
    // beams a span whose half wave is two beams long is 0.4 % off (Hughes 2000, section 7.3: error of cubic beams ~ (k
    // h)⁴/1440).
    const SimpleFit fit = simple_fit(loaded.system, truth.layout, seen);
    EXPECT_LT(fit.rms, 0.003) << name_of(kind);
    EXPECT_LT((fit.theta.cwiseQuotient(loaded.theta).array() - 1.0).abs().maxCoeff(), 0.1) << name_of(kind);
  }
}

TEST(FormTruth, FactorsOfTheTruthAreFoundByTheFit) {
  Stream random(5);
  Truth truth;
  truth.layout = draw_layout(Kind::girder_2, random);
  truth.factors = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(truth.layout.quantities.size()));
  truth.factors[0] = 1.2;  // E of the first span
  const auto loaded = dynamics::from_model(coarse_model(truth.layout));
  const SimpleFit fit = simple_fit(loaded.system, truth.layout, measurable_modes(truth, {}));
  EXPECT_GT(fit.theta[0] / loaded.theta[0], 1.1);
  EXPECT_LT(fit.theta[1] / loaded.theta[1], 1.1);
}

TEST(FormTruth, ALevelIsReachedAndATrialIsTheSameForOneSeed) {
  const FormCase one = make_form_case(9006), other = make_form_case(9006);
  EXPECT_NEAR(one.calibrated.reached / one.hidden.turn.level, 1.0, 0.1);
  EXPECT_GE(one.calibrated.least_mac, 0.6);
  ASSERT_EQ(one.features.rows.size(), other.features.rows.size());
  for (std::size_t r = 0; r < one.features.rows.size(); ++r)
    EXPECT_EQ(one.features.rows[r].value, other.features.rows[r].value);
  EXPECT_GE(one.features.channels.size(), 8u);
  EXPECT_LE(one.features.channels.size(), 16u);
}

TEST(FormScoring, TakesThePlaceOrTheZoneBesideIt) {
  Stream random(3);
  const Layout layout = draw_layout(Kind::girder_2, random);
  const Sought mass{{"mass"}, {}, layout.nodes[4], 1.1 * layout.zone_m};
  EXPECT_TRUE(names(layout, mass, "mass@node:5"));
  EXPECT_TRUE(names(layout, mass, "mass@node:4"));
  EXPECT_TRUE(names(layout, mass, "mass@node:5[after]"));
  EXPECT_FALSE(names(layout, mass, "mass@node:8"));
  EXPECT_FALSE(names(layout, mass, "osc@node:5"));
  EXPECT_FALSE(names(layout, mass, "mass@node:99"));
  const Sought bearing{{"brg", "stiffness"}, {"support:pier_1", "group:k_pier"}, {}, 0.0};
  EXPECT_TRUE(names(layout, bearing, "brg@support:pier_1"));
  EXPECT_TRUE(names(layout, bearing, "stiffness@group:k_pier"));
  EXPECT_FALSE(names(layout, bearing, "brg@support:abutment_W"));
  const Sought weak = sought_of(layout, {Feature::What::splice, 4, 0.05, {}});
  EXPECT_TRUE(names(layout, weak, "joint@element:4"));
  EXPECT_TRUE(names(layout, weak, "joint@element:5"));
  EXPECT_FALSE(names(layout, weak, "joint@element:9"));
}

TEST(FormScoring, CountsAnAnswerByItsSet) {
  FormCase hidden = make_form_case(9001);  // two states
  hidden.hidden.sought = {{"mass"}, {"node:3"}, {}, 0.0};
  hidden.hidden.size_name = "";
  diagnosis::Diagnosis result;
  result.verdict = diagnosis::Verdict::ambiguous;
  result.message = "one of two";
  result.effects.resize(1);
  result.effects[0].cluster = {"osc@node:3", "mass@node:3"};
  FormScore score;
  score_answer(hidden, result, score);
  EXPECT_TRUE(score.answered);
  EXPECT_TRUE(score.reported);
  EXPECT_TRUE(score.in_set);
  EXPECT_FALSE(score.complete);  // no form report
  result.effects[0].cluster = {"osc@node:3", "other@global"};
  FormScore without;
  score_answer(hidden, result, without);
  EXPECT_FALSE(without.in_set);
  EXPECT_FALSE(without.reported);
  EXPECT_EQ(without.found, "osc@node:3 or other@global");
}

TEST(FormMeasurement, LabelsFollowAModeWithinAStateAndFaultsReachTheirChannel) {
  const FormCase hidden = make_form_case(9003);  // a sensor fault
  ASSERT_EQ(hidden.hidden.turn.category, Category::sensors);
  Hidden right = hidden.hidden;
  right.fault = {};
  const Measured wrong = measure(hidden.truth, hidden.hidden), sound = measure(hidden.truth, right);
  EXPECT_LT((wrong.modes[0].frequency_Hz - sound.modes[0].frequency_Hz).norm(), 1e-12);
  EXPECT_GT((wrong.shapes[0] - sound.shapes[0]).norm(), 0.1);
  EXPECT_EQ(wrong.labels.back(), wrong.labels.front());
}

FormScore diagnosed(std::uint64_t seed) {
  const FormCase hidden = make_form_case(seed);
  FormScore score = prepare_score(hidden);
  run_form_case(hidden, score);
  return score;
}

// Oracle: what the trials hide. Both were seen while the rules were made, and count for no rate.
TEST(FormDiagnosis, AStiffBearingIsNotTheOtherOneLost) {
  // The parameter of both abutments has taken the stiff one up, so that the base shows the other one as too soft.
  const FormScore score = diagnosed(64010);
  EXPECT_TRUE(score.answered);
  EXPECT_TRUE(score.in_set) << score.found;
}

TEST(FormDiagnosis, AModeThatTheModelDoesNotHaveMakesNoAlarm) {
  // The mode at 84.3 Hz is a hybrid: its shape is that of the mode at 89.9 Hz, and the model's nearest free mode is 42 % off.
  // A channel's axis by an angle whose interval holds zero comes nearest: that is no cause.
  const FormScore score = diagnosed(66176);
  EXPECT_EQ(score.verdict, "none") << score.found;
}

TEST(FormDiagnosis, TheErrorOfAnEffectIsNoSecondCause) {
  // The support has moved by 1.71 m, 4,268 nats; beside it a turning foundation would be worth 12.
  const FormScore score = diagnosed(69333);
  EXPECT_EQ(score.verdict, "named") << score.found;
  EXPECT_TRUE(score.in_set) << score.found;
}

TEST(FormDiagnosis, ABearingThatSlipsIsFoundFromWhereItHolds) {
  // A fit to all amplitudes at once would be neither the bearing that holds nor the one that slips.
  // A second cause stands beside it, in a set that the verdict leaves open.
  const FormScore score = diagnosed(66055);
  EXPECT_TRUE(score.answered);
  EXPECT_TRUE(score.in_set) << score.found;
}

TEST(FormDiagnosis, ALightOscillatorOnASoundGirderIsNotNamed) {
  const FormScore score = diagnosed(64052);
  EXPECT_FALSE(score.reported) << score.found;
}

// A fixed bearing below the axis gives a mode more than the model has: an oscillator explained it in both tests.
TEST(FormDiagnosis, AModeThatTheModelLacksIsNoOscillator) {
  const FormScore score = diagnosed(890036);
  EXPECT_FALSE(score.reported) << score.found;
}

}  // namespace
}  // namespace twindeck::blind::form
