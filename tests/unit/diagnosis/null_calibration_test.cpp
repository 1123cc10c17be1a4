// Null data sets. Oracle: with nothing hidden, the residual statistic has the mean and deviation of its chi-square law, and the
// quantile of the largest odds lies below what the union bound promises.
#include "diagnosis/null_calibration.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

TEST(NullCalibration, HaveTheLawOfNothingAndAreTheSameWhateverTheThreads) {
  const Chain chain({.masses = 8, .modes = 6});
  auto features = chain.measure(chain.as_modelled());
  diagnosis::hold_out_by_rule(features);
  const auto hypotheses = catalogue({"stiffness", "mass", "gain", "pol"});
  const auto run = [&] { return diagnosis::run_null_calibration(chain.reduced(), features, {}, hypotheses, {}, 60, 3, {}); };
  const auto nulls = run();
  ASSERT_EQ(nulls.chi_squared.size(), 60u);
  const double dof = 5.0 * 9.0 - 5.0;  // five modes in the fit, a frequency and eight shape values less a scale each
  double mean = 0.0;
  for (const double x : nulls.chi_squared) mean += x / 60.0;
  // sqrt(2 dof / 60) = 1.2; parameters end at two deviations, which takes a little off.
  EXPECT_NEAR(mean, dof, 5.0);
  auto odds = nulls.log_odds;
  std::sort(odds.begin(), odds.end());
  const Examined e = examine(chain, features, hypotheses);
  EXPECT_LT(odds[57], diagnosis::analytic_threshold(*e.inference, 0.05) + 1.0);
  EXPECT_EQ(run().log_odds, nulls.log_odds);
}

TEST(NullCalibration, AnalyticThresholdRisesAsFewerFalseAlarmsAreAllowed) {
  const Chain chain({.masses = 8, .modes = 6});
  const Examined e = examine(chain, chain.measure(chain.as_modelled()), catalogue());
  EXPECT_GT(diagnosis::analytic_threshold(*e.inference, 0.001), diagnosis::analytic_threshold(*e.inference, 0.01) + 1.0);
}

}  // namespace
}  // namespace twindeck::tests
