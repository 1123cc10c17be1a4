// A diagnosis whose model may be wrong in form. Oracles: exchanged channels are the same rows under other names; data of the
// model itself; a truth with a spring that the model lacks.
#include "diagnosis/form_diagnosis.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "diagnosis/form_search.hpp"

namespace twindeck::tests {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

diagnosis::FeatureSet all_rows(diagnosis::FeatureSet f) {
  for (auto& row : f.rows) row.held_out = false;
  return f;
}

diagnosis::Diagnosis with_form(const Examined& e) { return diagnosis::diagnose_with_form(*e.inference, {}, 1); }

diagnosis::FormSearch searched(const Examined& e) {
  const diagnosis::FormSetting setting{*e.inference, *e.inference, e.inference->dof(),
                                       diagnosis::contrasts_of(e.map->features()), diagnosis::scale_grid()};
  return diagnosis::search_with_form(setting, e.inference->fit({}, {}), {});
}

TEST(FormModes, AreThoseOfTheModelAndExchangeWithTheChannels) {
  const Chain chain({.masses = 10, .modes = 5});
  const Examined e = examine(chain, chain.measure(chain.as_modelled()), catalogue({"swap"}));
  const auto base = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
  const auto modes = e.map->form_modes(base, {});
  ASSERT_EQ(modes.paired.size(), 5u);
  // Mass-normalised shapes and frequencies of the dense eigenproblem.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(chain.stiffness(chain.as_modelled()) / Chain::kMass);
  for (int m = 0; m < 5; ++m) {
    EXPECT_EQ(modes.paired[static_cast<std::size_t>(m)].model_mode, m);
    EXPECT_NEAR(modes.modes.omega_rad_s[m] / std::sqrt(eigen.eigenvalues()[m]), 1.0, 1e-6);
    const VectorXd shape = eigen.eigenvectors().col(m) / std::sqrt(Chain::kMass);
    EXPECT_NEAR(std::abs(modes.modes.shapes.col(m).dot(shape)) / shape.squaredNorm(), 1.0, 1e-6);
  }
  const auto& swap = e.entry("swap@channels:c3,c7");
  const auto exchanged = e.map->form_modes(base, {{&swap, VectorXd()}});
  EXPECT_LT((exchanged.modes.shapes.row(2) - modes.modes.shapes.row(6)).norm(), 1e-12);
  EXPECT_LT((exchanged.modes.shapes.row(6) - modes.modes.shapes.row(2)).norm(), 1e-12);
  EXPECT_LT((exchanged.modes.shapes.row(4) - modes.modes.shapes.row(4)).norm(), 1e-12);
}

// Oracle: by definition each hypothesis has the same share of an RMS change of the frequencies of one; what moves no frequency,
// acts in one condition alone or is a fault of the sensors has none.
TEST(ManySmallCauses, ShareTheFormErrorByHypothesis) {
  const Chain chain({.masses = 10, .modes = 5});
  const Examined e =
      examine(chain, all_rows(chain.measure(chain.as_modelled())), catalogue({"swap", "gain", "mass", "stiffness"}));
  const diagnosis::Fit fit = e.inference->fit({}, {});
  const Eigen::MatrixXd many = diagnosis::many_small_causes(*e.inference, fit, diagnosis::contrasts_of(e.map->features()));
  ASSERT_GT(many.cols(), 2);
  double sum = 0.0;
  int frequencies = 0;
  for (std::size_t r = 0; r < e.inference->training().size(); ++r) {
    if (e.map->features().rows[static_cast<std::size_t>(e.inference->training()[r])].type != diagnosis::RowType::frequency)
      continue;
    sum += many.row(static_cast<Index>(r)).squaredNorm();
    ++frequencies;
  }
  EXPECT_NEAR(sum / frequencies, 1.0, 1e-9);
  const Examined sensors = examine(chain, all_rows(chain.measure(chain.as_modelled())), catalogue({"swap", "gain"}));
  EXPECT_EQ(diagnosis::many_small_causes(*sensors.inference, sensors.inference->fit({}, {}), {}).cols(), 0);
}

// With deviations of 1e-8 the products need more digits than there are.
TEST(FormSearch, RowsThatAreTooExactAreRefused) {
  const Chain chain({.masses = 10, .modes = 5, .frequency_std = 1e-8, .shape_std = 1e-8});
  diagnosis::ScatterOptions no_floors;
  no_floors.frequency_floor = no_floors.shape_floor = 0.0;
  const Examined e = examine(chain, all_rows(chain.measure(chain.as_modelled())), catalogue({"mass"}), no_floors);
  EXPECT_THROW((void)with_form(e), InputError);
}

TEST(FormSearch, ACauseWhereNoneMayBeTakenIsUnknown) {
  const Chain chain({.masses = 10, .modes = 5});
  ChainTruth truth = chain.as_modelled();
  truth.gain[3] = -1.0;
  const Examined e = examine(chain, all_rows(chain.measure(truth)), catalogue({"pol"}));
  diagnosis::DiagnoseOptions options;
  options.most_causes = 0;
  const diagnosis::Diagnosis out = diagnosis::diagnose_with_form(*e.inference, options, 1);
  EXPECT_EQ(out.verdict, diagnosis::Verdict::unknown);
  EXPECT_TRUE(out.effects.empty());
  EXPECT_NE(out.message.find("most_causes allows none"), std::string::npos) << out.message;
  EXPECT_NE(out.message.find("pol@channel:c4"), std::string::npos) << out.message;
}

TEST(FormSearch, ExchangedChannelsAreTheSameRowsUnderOtherNames) {
  // The evidence of the rows as measured without a cause is that of the exchanged rows under "exchanged": the columns go with
  // the channels.
  const Chain chain({.masses = 10, .modes = 5});
  std::mt19937_64 random(12);
  ChainTruth truth = chain.scattered(random);
  auto right = all_rows(chain.measure(truth, &random)), wrong = right;
  for (auto& row : wrong.rows)
    if (row.channel == 2 || row.channel == 6) row.channel = 8 - row.channel;
  const Examined a = examine(chain, right, catalogue({"swap", "gain"})), b = examine(chain, wrong, catalogue({"swap", "gain"}));
  const auto of_right = searched(a), of_wrong = searched(b);
  const auto& leader = of_wrong.entries.front();
  EXPECT_EQ(leader.candidate->id(), "swap@channels:c3,c7");
  EXPECT_TRUE(leader.refined);
  EXPECT_NEAR(leader.evidence.log_evidence, of_right.none.log_evidence, 0.05);
  EXPECT_GT(leader.evidence.log_evidence, of_wrong.none.log_evidence + 20.0);
}

TEST(DiagnoseWithForm, SaysNoneOfDataOfTheModelItself) {
  const Chain chain({.masses = 10});
  const auto hypotheses = catalogue();
  for (unsigned i = 0; i < 6; ++i) {
    std::mt19937_64 random(40 + i);
    const auto result = with_form(examine(chain, all_rows(chain.measure(chain.scattered(random), &random)), hypotheses));
    EXPECT_EQ(result.verdict, diagnosis::Verdict::none) << i << ": " << result.message;
    ASSERT_TRUE(result.form);
    EXPECT_LT(result.form->frequency.level, 0.01) << i;  // the model is exact but for scatter
    EXPECT_NE(result.message.find("form is off by about"), std::string::npos);
  }
}

TEST(DiagnoseWithForm, FindsASpringFarOutsideItsBounds) {
  const Chain chain({.masses = 10});
  std::mt19937_64 random(3);
  ChainTruth truth = chain.scattered(random);
  truth.spring[6] = 0.3;
  const auto e = examine(chain, all_rows(chain.measure(truth, &random)), catalogue());
  const auto result = with_form(e);
  ASSERT_FALSE(result.effects.empty()) << result.message;
  const auto& effect = result.effects.front();
  EXPECT_NE(std::find(effect.cluster.begin(), effect.cluster.end(), "stiffness@group:g6"), effect.cluster.end());
  EXPECT_GT(result.form->gain.low, 0.0);
  EXPECT_EQ(result.form->gain.blocks.size(), 8u);
  if (effect.cause.candidate->id() == "stiffness@group:g6") {
    EXPECT_LT(effect.parameters[0].low, 0.3);
    EXPECT_GT(effect.parameters[0].high, 0.3);
    EXPECT_NEAR(std::log(effect.parameters[0].value), std::log(0.3), 0.25);
    // No narrower than the error of a size in a wrong model: 10 % of ln, at 1.645 deviations.
    EXPECT_GT(std::log(effect.parameters[0].low / effect.parameters[0].value) / std::log(effect.parameters[0].value), 0.15);
  }
}

TEST(DiagnoseWithForm, IsDeterministic) {
  const Chain chain({.masses = 8, .modes = 5});
  std::mt19937_64 random(5);
  const auto features = all_rows(chain.measure(chain.scattered(random), &random));
  const auto a = with_form(examine(chain, features, catalogue({"stiffness", "gain"})));
  const auto b = with_form(examine(chain, features, catalogue({"stiffness", "gain"})));
  EXPECT_EQ(a.log_odds, b.log_odds);
  EXPECT_EQ(a.form->gain.low, b.form->gain.low);
  EXPECT_EQ(a.form->frequency.level, b.form->frequency.level);
}

}  // namespace
}  // namespace twindeck::tests
