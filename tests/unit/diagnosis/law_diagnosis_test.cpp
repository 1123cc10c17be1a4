// Diagnosis by the one law. Oracles: data of the model itself; what was put into a chain by dense matrices of its own;
// exchanged channels are the same rows under other names.
#include "diagnosis/law_diagnosis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "chain.hpp"
#include "core/error.hpp"
#include "diagnosis/form_frame.hpp"
#include "diagnosis/law_search.hpp"

namespace twindeck::tests {
namespace {

diagnosis::FeatureSet no_row_held_out(diagnosis::FeatureSet f) {
  for (auto& row : f.rows) row.held_out = false;
  return f;
}

diagnosis::Diagnosis by_law(const Examined& e) { return diagnosis::diagnose(*e.inference, {}, 1); }

diagnosis::LawSearch law_searched(const Examined& e) {
  const diagnosis::LawSetting setting{*e.inference, *e.inference, diagnosis::contrasts_of(e.map->features()),
                                      diagnosis::DiagnoseOptions{}.static_odds};
  return diagnosis::search_by_law(setting, e.inference->fit({}, {}));
}

bool is_in_a_set(const diagnosis::Diagnosis& result, const std::string& id) {
  return std::any_of(result.effects.begin(), result.effects.end(), [&](const diagnosis::Effect& effect) {
    return std::find(effect.cluster.begin(), effect.cluster.end(), id) != effect.cluster.end();
  });
}

/// Rows of two measurements, the second in state "after".
diagnosis::FeatureSet before_and_after(diagnosis::FeatureSet before, const diagnosis::FeatureSet& after) {
  before.conditions.push_back(before.conditions.front());
  before.conditions.back().name = "later";
  before.conditions.back().state = "after";
  for (auto row : after.rows) {
    row.condition = 1;
    before.rows.push_back(row);
  }
  return no_row_held_out(before);
}

TEST(LawSearch, AnAnswerIsTakenFromTheSmallestAccountThatWasFitted) {
  diagnosis::LawAccount pair, fitted, screened;
  pair.members = {3, 7};
  fitted.members = {3};
  screened.members = {7};  // weighed by the screen alone: its scales have no deviations
  pair.scored = fitted.scored = true;
  EXPECT_EQ(&diagnosis::account_to_take({&pair, &screened, &fitted}), &fitted);
  EXPECT_EQ(&diagnosis::account_to_take({&pair, &screened}), &pair);
}

TEST(LawSearch, PriorOddsOfEachClassOfCausesAreShared) {
  const Chain chain({.masses = 8, .modes = 5});
  const Examined e =
      examine(chain, no_row_held_out(chain.measure(chain.as_modelled())), catalogue({"mass", "stiffness", "gain", "pol"}));
  const auto search = law_searched(e);
  double everywhere = 0.0, channels = 0.0, masses = 0.0;
  for (const auto& entry : search.entries) {
    (entry.candidate->hypothesis->measurement ? channels : everywhere) += std::exp(entry.log_prior);
    if (entry.candidate->hypothesis->id == "mass") masses += std::exp(entry.log_prior);
  }
  EXPECT_NEAR(std::log(channels), std::log(0.1), 1e-9);
  EXPECT_NEAR(std::log(everywhere), diagnosis::DiagnoseOptions{}.static_odds, 1e-9);
  EXPECT_NEAR(masses / everywhere, 0.5, 1e-9);  // two families
}

TEST(LawSearch, ExchangedChannelsAreTheSameRowsUnderOtherNamesToTheLaw) {
  const Chain chain({.masses = 10, .modes = 5});
  std::mt19937_64 random(12);
  ChainTruth truth = chain.scattered(random);
  auto right = no_row_held_out(chain.measure(truth, &random)), wrong = right;
  for (auto& row : wrong.rows)
    if (row.channel == 2 || row.channel == 6) row.channel = 8 - row.channel;
  const Examined a = examine(chain, right, catalogue({"swap", "gain"})), b = examine(chain, wrong, catalogue({"swap", "gain"}));
  const auto of_right = law_searched(a), of_wrong = law_searched(b);
  const auto& leader = of_wrong.accounts.front();
  ASSERT_EQ(leader.causes.size(), 1U);
  EXPECT_EQ(leader.causes.front().candidate->id(), "swap@channels:c3,c7");
  EXPECT_TRUE(leader.refined());
  EXPECT_NEAR(leader.evidence.log_evidence, of_right.nothing.evidence.log_evidence, 0.05);
  EXPECT_GT(leader.log_weight, of_wrong.none.log_evidence + 20.0);
}

/// The shape of a measured mode is replaced by one in which a single mass moves: its MAC with any mode of the chain is below
/// 0.2.
diagnosis::FeatureSet with_a_stranger(const Chain& chain, const ChainTruth& truth, const std::string& mode,
                                      std::mt19937_64& random) {
  diagnosis::FeatureSet f = no_row_held_out(chain.measure(truth, &random));
  for (auto& row : f.rows)
    if (row.type == diagnosis::RowType::shape && row.mode == mode) row.value = row.channel == 4 ? 1.0 : 0.0;
  return f;
}

TEST(DiagnoseByLaw, AMeasuredModeThatIsNoneOfTheModelsDecidesNothingAndIsTold) {
  const Chain chain({.masses = 10, .modes = 8});
  std::mt19937_64 random(5);
  const auto sound =
      by_law(examine(chain, with_a_stranger(chain, chain.as_modelled(), "3", random), catalogue({"mass", "gain"})));
  EXPECT_EQ(sound.verdict, diagnosis::Verdict::none) << sound.message;
  ASSERT_TRUE(sound.form);
  const auto tells = [](const std::string& warning) { return warning.find("is the measured mode 3 (") != std::string::npos; };
  EXPECT_TRUE(std::any_of(sound.form->warnings.begin(), sound.form->warnings.end(), tells));
  EXPECT_EQ(sound.before.all.open.size(), 11U);  // ten channels and the frequency
  for (const int row : sound.before.all.open) EXPECT_EQ(sound.before.all.jacobian.row(row).cwiseAbs().maxCoeff(), 0.0) << row;
}

/// The shape of one mode partly another one's: near enough to be paired, far beyond any error of the model.
diagnosis::FeatureSet with_a_hybrid(const Chain& chain, const ChainTruth& truth, std::mt19937_64& random) {
  diagnosis::FeatureSet f = no_row_held_out(chain.measure(truth, &random));
  for (auto& row : f.rows)
    if (row.type == diagnosis::RowType::shape && row.mode == "5") row.value += row.channel % 3 == 0 ? 0.35 : -0.2;
  return f;
}

TEST(DiagnoseByLaw, AModeOfWhichTheShapeIsWhollyOffDecidesNothing) {
  const Chain chain({.masses = 10, .modes = 8});
  std::mt19937_64 random(11);
  const auto sound = by_law(examine(chain, with_a_hybrid(chain, chain.scattered(random), random), catalogue()));
  EXPECT_EQ(sound.verdict, diagnosis::Verdict::none) << sound.message;
  ASSERT_TRUE(sound.form);
  const auto tells = [](const std::string& warning) { return warning.find("is the measured mode 5 (") != std::string::npos; };
  EXPECT_TRUE(std::any_of(sound.form->warnings.begin(), sound.form->warnings.end(), tells));
  for (const auto& scale : sound.form->classes) EXPECT_LT(scale.scale.level, 0.03) << scale.name;
}

TEST(DiagnoseByLaw, ACauseIsFoundBesideAModeOfWhichTheShapeIsWhollyOff) {
  const Chain chain({.masses = 10, .modes = 8});
  std::mt19937_64 random(12);
  ChainTruth truth = chain.scattered(random);
  truth.gain[3] = 0.5;
  const auto result = by_law(examine(chain, with_a_hybrid(chain, truth, random), catalogue({"gain", "pol", "mass"})));
  EXPECT_EQ(result.effects.size(), 1U) << result.message;
  EXPECT_TRUE(is_in_a_set(result, "gain@channel:c4"));
}

TEST(DiagnoseByLaw, SaysWhereTheModelHasNoneOfTheModes) {
  const Chain chain({.masses = 10, .modes = 2});
  std::mt19937_64 random(5);
  diagnosis::FeatureSet f = with_a_stranger(chain, chain.as_modelled(), "1", random);
  std::erase_if(f.rows, [](const auto& row) { return row.mode != "1"; });
  const auto result = by_law(examine(chain, f, catalogue({"gain"})));
  EXPECT_EQ(result.verdict, diagnosis::Verdict::unknown);
  EXPECT_EQ(result.message, "the model predicts none of these rows");
}

TEST(LawFrame, AChangeThatTurnsIsAsNearAsOneThatDoesNot) {
  // Three levels of a contrast, in the ratio 0 : 1 : 2: variances grow along it, and increments are independent of one another.
  const Chain chain({.masses = 10, .modes = 5});
  diagnosis::FeatureSet f = no_row_held_out(chain.measure(chain.as_modelled()));
  const auto first = f.rows;
  for (const double people : {1.0, 2.0}) {
    f.conditions.push_back(f.conditions.front());
    f.conditions.back().name = people > 1.0 ? "two" : "one";
    f.conditions.back().people = people;
    for (auto row : first) {
      row.condition = static_cast<int>(f.conditions.size()) - 1;
      f.rows.push_back(row);
    }
  }
  f.conditions.front().people = 0.0;
  const Examined e = examine(chain, f, catalogue({"gain"}));
  const auto contrasts = diagnosis::contrasts_of(e.map->features());
  ASSERT_EQ(contrasts.size(), 1U);
  const auto system = diagnosis::law_system(*e.inference, e.inference->fit({}, {}), contrasts);
  std::vector<Eigen::Index> frequency;  // of one mode in each condition
  for (std::size_t r = 0; r < f.rows.size(); ++r)
    if (f.rows[r].type == diagnosis::RowType::frequency && f.rows[r].mode == first.front().mode)
      frequency.push_back(static_cast<Eigen::Index>(r));
  ASSERT_EQ(frequency.size(), 3U);
  const Eigen::MatrixXd covariance = system.classes.at(diagnosis::kFirstContrast).covariance(frequency, frequency);
  EXPECT_NEAR(covariance(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 1e-4, 1e-9);  // 1 % at the end of the contrast
  EXPECT_NEAR(covariance(1, 1), 0.5e-4, 1e-9);
  EXPECT_NEAR(covariance(1, 2), covariance(1, 1), 1e-9);
}

// In one condition the stated scatter of elements is known beforehand; where a contrast divides them it is a class.
TEST(LawSystem, ElementsAreAClassWhereConditionsDiffer) {
  const Chain chain({.masses = 6, .modes = 3});
  const Examined e = examine(chain, no_row_held_out(chain.measure(chain.as_modelled())), catalogue({"gain"}));
  const diagnosis::Fit fit = e.inference->fit({}, {});
  const auto alone = diagnosis::law_system(*e.inference, fit, {});
  const auto differing = diagnosis::law_system(*e.inference, fit, {{"people", Eigen::VectorXd::Ones(1)}});
  EXPECT_TRUE(alone.classes.at(diagnosis::kElements).empty());
  ASSERT_FALSE(differing.classes.at(diagnosis::kElements).empty());
  const Eigen::MatrixXd together = differing.sigma + differing.classes.at(diagnosis::kElements).covariance;
  EXPECT_LT((together - alone.sigma).norm(), 1e-9 * alone.sigma.norm());
  EXPECT_GT((differing.sigma - alone.sigma).norm(), 1e-6 * alone.sigma.norm());
}

TEST(DiagnoseByLaw, SaysNoneOfDataOfTheModelItself) {
  const Chain chain({.masses = 10});
  for (unsigned i = 0; i < 6; ++i) {
    std::mt19937_64 random(40 + i);
    const auto result = by_law(examine(chain, no_row_held_out(chain.measure(chain.scattered(random), &random)), catalogue()));
    EXPECT_EQ(result.verdict, diagnosis::Verdict::none) << i << ": " << result.message;
    ASSERT_TRUE(result.form);
    EXPECT_LT(result.form->frequency.level, 0.01) << i;  // the model is exact but for scatter
    EXPECT_GT(result.form->frequency.high, result.form->frequency.level);
  }
}

TEST(DiagnoseByLaw, AReversedChannelIsNamed) {
  const Chain chain({.masses = 10, .modes = 5});
  std::mt19937_64 random(4);
  ChainTruth truth = chain.scattered(random);
  truth.gain[3] = -1.0;
  const auto result = by_law(examine(chain, no_row_held_out(chain.measure(truth, &random)), catalogue()));
  EXPECT_EQ(result.verdict, diagnosis::Verdict::named) << result.message;
  EXPECT_TRUE(is_in_a_set(result, "pol@channel:c4"));
}

TEST(DiagnoseByLaw, TwoFaultsOfChannelsAreASetOfTwo) {
  const Chain chain({.masses = 10, .modes = 5});
  std::mt19937_64 random(4);
  ChainTruth truth = chain.scattered(random);
  truth.gain[3] = -1.0;
  truth.gain[7] = -1.0;
  const auto result =
      by_law(examine(chain, no_row_held_out(chain.measure(truth, &random)), catalogue({"pol", "gain", "swap"})));
  EXPECT_EQ(result.effects.size(), 2U) << result.message;
  EXPECT_TRUE(is_in_a_set(result, "pol@channel:c4"));
  EXPECT_TRUE(is_in_a_set(result, "pol@channel:c8"));
}

TEST(DiagnoseByLaw, FindsWhatWasCutBetweenTwoStatesWithItsSize) {
  const Chain chain({.masses = 10, .modes = 6});
  std::mt19937_64 random(7);
  const ChainTruth before = chain.scattered(random);
  ChainTruth after = before;
  after.spring[6] *= 0.4;
  const Examined e =
      examine(chain, before_and_after(chain.measure(before, &random), chain.measure(after, &random)), catalogue());
  const auto result = by_law(e);
  ASSERT_FALSE(result.effects.empty()) << result.message;
  EXPECT_TRUE(is_in_a_set(result, "stiffness@group:g6"));
  EXPECT_EQ(result.effects.front().cause.candidate->state, "after");
  if (result.effects.front().cause.candidate->id() == "stiffness@group:g6") {
    EXPECT_LT(result.effects.front().parameters[0].low, 0.4);
    EXPECT_GT(result.effects.front().parameters[0].high, 0.4);
  }
}

TEST(DiagnoseByLaw, NothingThatChangedIsNone) {
  const Chain chain({.masses = 10, .modes = 6});
  for (unsigned i = 0; i < 4; ++i) {
    std::mt19937_64 random(60 + i);
    const ChainTruth truth = chain.scattered(random);
    const auto result =
        by_law(examine(chain, before_and_after(chain.measure(truth, &random), chain.measure(truth, &random)), catalogue()));
    EXPECT_EQ(result.verdict, diagnosis::Verdict::none) << i << ": " << result.message;
  }
}

// Two springs cut at once, at places that do not look alike.
TEST(DiagnoseByLaw, FindsTwoPartsThatChangedTogether) {
  const Chain chain({.masses = 10, .modes = 8, .frequency_std = 0.001, .shape_std = 0.01});
  std::mt19937_64 random(9);
  const ChainTruth before = chain.scattered(random);
  ChainTruth after = before;
  after.spring[2] *= 0.4;
  after.spring[7] *= 0.5;
  const auto result = by_law(examine(chain, before_and_after(chain.measure(before, &random), chain.measure(after, &random)),
                                     catalogue({"stiffness", "gain"})));
  EXPECT_EQ(result.effects.size(), 2U) << result.message;
  EXPECT_TRUE(is_in_a_set(result, "stiffness@group:g2"));
  EXPECT_TRUE(is_in_a_set(result, "stiffness@group:g7"));
}

TEST(DiagnoseByLaw, RowsFarMoreExactThanTheFormAreWeighed) {
  const Chain chain({.masses = 10, .modes = 5, .frequency_std = 1e-9, .shape_std = 1e-9});
  diagnosis::ScatterOptions no_floors;
  no_floors.frequency_floor = no_floors.shape_floor = 0.0;
  const Examined e = examine(chain, no_row_held_out(chain.measure(chain.as_modelled())), catalogue({"mass"}), no_floors);
  EXPECT_EQ(by_law(e).verdict, diagnosis::Verdict::none);
}

TEST(FormModes, AreThoseOfTheModelAndExchangeWithTheChannels) {
  const Chain chain({.masses = 10, .modes = 5});
  const Examined e = examine(chain, chain.measure(chain.as_modelled()), catalogue({"swap"}));
  const auto base = e.map->base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(e.map->nuisances().size())));
  const auto modes = e.map->form_modes(base, {});
  ASSERT_EQ(modes.paired.size(), 5u);
  // Mass-normalised shapes and frequencies of the dense eigenproblem.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(chain.stiffness(chain.as_modelled()) / Chain::kMass);
  for (int m = 0; m < 5; ++m) {
    EXPECT_EQ(modes.paired[static_cast<std::size_t>(m)].model_mode, m);
    EXPECT_NEAR(modes.structures.front().omega_rad_s[m] / std::sqrt(eigen.eigenvalues()[m]), 1.0, 1e-6);
    const Eigen::VectorXd shape = eigen.eigenvectors().col(m) / std::sqrt(Chain::kMass);
    EXPECT_NEAR(std::abs(modes.structures.front().shapes.col(m).dot(shape)) / shape.squaredNorm(), 1.0, 1e-6);
  }
  const auto& swap = e.entry("swap@channels:c3,c7");
  const auto exchanged = e.map->form_modes(base, {{&swap, Eigen::VectorXd()}});
  EXPECT_LT((exchanged.structures.front().shapes.row(2) - modes.structures.front().shapes.row(6)).norm(), 1e-12);
  EXPECT_LT((exchanged.structures.front().shapes.row(6) - modes.structures.front().shapes.row(2)).norm(), 1e-12);
  EXPECT_LT((exchanged.structures.front().shapes.row(4) - modes.structures.front().shapes.row(4)).norm(), 1e-12);
}

TEST(DiagnoseByLaw, ACauseWhereNoneMayBeTakenIsUnknown) {
  const Chain chain({.masses = 10, .modes = 5});
  ChainTruth truth = chain.as_modelled();
  truth.gain[3] = -1.0;
  const Examined e = examine(chain, no_row_held_out(chain.measure(truth)), catalogue({"pol"}));
  diagnosis::DiagnoseOptions options;
  options.most_causes = 0;
  const diagnosis::Diagnosis out = diagnosis::diagnose(*e.inference, options, 1);
  EXPECT_EQ(out.verdict, diagnosis::Verdict::unknown);
  EXPECT_TRUE(out.effects.empty());
  EXPECT_NE(out.message.find("most_causes allows none"), std::string::npos) << out.message;
  EXPECT_NE(out.message.find("pol@channel:c4"), std::string::npos) << out.message;
}

TEST(DiagnoseByLaw, FindsASpringFarOutsideItsBounds) {
  const Chain chain({.masses = 10});
  std::mt19937_64 random(3);
  ChainTruth truth = chain.scattered(random);
  truth.spring[6] = 0.3;
  const auto e = examine(chain, no_row_held_out(chain.measure(truth, &random)), catalogue());
  const auto result = by_law(e);
  ASSERT_FALSE(result.effects.empty()) << result.message;
  const auto& effect = result.effects.front();
  EXPECT_NE(std::find(effect.cluster.begin(), effect.cluster.end(), "stiffness@group:g6"), effect.cluster.end());
  EXPECT_GT(result.form->gain.low, 0.0);
  EXPECT_EQ(result.form->gain.blocks.size(), 8u);
  if (effect.cause.candidate->id() == "stiffness@group:g6") {
    EXPECT_LT(effect.parameters[0].low, 0.3);
    EXPECT_GT(effect.parameters[0].high, 0.3);
    EXPECT_NEAR(std::log(effect.parameters[0].value), std::log(0.3), 0.25);
    // No narrower than the error of a size in a wrong model: 25 % of ln, at 1.645 deviations.
    EXPECT_GT(std::log(effect.parameters[0].low / effect.parameters[0].value) / std::log(effect.parameters[0].value), 0.4);
  }
}

TEST(DiagnoseByLaw, GivesTheSameTwice) {
  const Chain chain({.masses = 8, .modes = 5});
  std::mt19937_64 random(5);
  const auto features = no_row_held_out(chain.measure(chain.scattered(random), &random));
  const auto a = by_law(examine(chain, features, catalogue({"stiffness", "gain"})));
  const auto b = by_law(examine(chain, features, catalogue({"stiffness", "gain"})));
  EXPECT_EQ(a.log_odds, b.log_odds);
  EXPECT_EQ(a.form->gain.low, b.form->gain.low);
  EXPECT_EQ(a.form->frequency.level, b.form->frequency.level);
}

}  // namespace
}  // namespace twindeck::tests
