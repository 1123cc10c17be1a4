// Gain on held-out rows. Oracles: an effect that is there predicts rows that the fit never saw; shuffled rows cannot be
// predicted; the numbers of a hand-made case.
#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

/// Modes 6 to 8 held out, so that there are three blocks to resample.
diagnosis::FeatureSet held_out(diagnosis::FeatureSet f) {
  for (auto& row : f.rows) row.held_out = std::stoi(row.mode) >= 6;
  return f;
}

struct Fits {
  Examined e;
  diagnosis::Fit before, after;
};

Fits fits(const Chain& chain, const diagnosis::FeatureSet& f) {
  Fits out{examine(chain, f, catalogue({"stiffness"})), {}, {}};
  out.before = out.e.inference->fit({}, {});
  out.after = out.e.inference->fit({{&out.e.entry("stiffness@group:g3"), Eigen::VectorXd::Constant(1, std::log(0.5))}}, {});
  return out;
}

TEST(Gain, IsThereForTheTruthAndVanishesForShuffledRows) {
  const Chain chain({.masses = 10, .frequency_std = 0.001});
  std::mt19937_64 random(9);
  ChainTruth truth = chain.scattered(random);
  truth.spring[3] = 0.5;
  auto features = held_out(chain.measure(truth, &random));
  const Fits right = fits(chain, features);
  const auto gain = diagnosis::held_out_gain(*right.e.inference, right.before, right.after, 2000, 1);
  EXPECT_EQ(gain.rows, 33);
  EXPECT_GT(gain.reduction_pct, 40.0);
  EXPECT_GT(gain.low_pct, 0.0);
  EXPECT_LE(gain.low_pct, gain.reduction_pct);
  EXPECT_GE(gain.high_pct, gain.reduction_pct);
  // A leak of held-out values into the fit would keep a gain when they are exchanged among themselves. Chance makes single
  // draws better or worse; their mean is nothing within 10 %, and none comes near the gain that is there.
  double mean = 0.0;
  constexpr int draws = 20;
  for (int i = 0; i < draws; ++i) {
    auto shuffled = features;
    std::vector<std::size_t> at;
    for (std::size_t r = 0; r < shuffled.rows.size(); ++r)
      if (shuffled.rows[r].held_out && shuffled.rows[r].channel >= 0) at.push_back(r);
    for (std::size_t k = at.size() - 1; k > 0; --k)
      std::swap(shuffled.rows[at[k]].value, shuffled.rows[at[random() % (k + 1)]].value);
    const Fits wrong = fits(chain, shuffled);
    const auto none = diagnosis::held_out_gain(*wrong.e.inference, wrong.before, wrong.after, 200, 1);
    EXPECT_LT(none.reduction_pct, 0.75 * gain.reduction_pct);
    mean += none.reduction_pct / draws;
    // The fit itself knows nothing of the held-out rows.
    EXPECT_DOUBLE_EQ(wrong.after.chi_squared, right.after.chi_squared);
  }
  EXPECT_LT(mean, 10.0);
}

TEST(Gain, IntervalIsDeterministicAndNarrowsToThePointOfEqualBlocks) {
  const Chain chain({.masses = 10});
  ChainTruth truth = chain.as_modelled();
  truth.spring[3] = 0.5;
  const Fits f = fits(chain, held_out(chain.measure(truth)));
  const auto a = diagnosis::held_out_gain(*f.e.inference, f.before, f.after, 500, 4);
  const auto b = diagnosis::held_out_gain(*f.e.inference, f.before, f.after, 500, 4);
  EXPECT_EQ(a.low_pct, b.low_pct);
  EXPECT_EQ(a.high_pct, b.high_pct);
  // The same fit on both sides: every block has the ratio one, so the interval is a point at nothing.
  const auto none = diagnosis::held_out_gain(*f.e.inference, f.before, f.before, 500, 4);
  EXPECT_DOUBLE_EQ(none.reduction_pct, 0.0);
  EXPECT_DOUBLE_EQ(none.low_pct, 0.0);
  EXPECT_DOUBLE_EQ(none.high_pct, 0.0);
}

TEST(Gain, OneBlockClaimsNothing) {
  const Chain chain({.masses = 10});
  ChainTruth truth = chain.as_modelled();
  truth.spring[3] = 0.5;
  auto features = chain.measure(truth);
  for (auto& row : features.rows) row.held_out = row.mode == "8";
  const Fits f = fits(chain, features);
  const auto gain = diagnosis::held_out_gain(*f.e.inference, f.before, f.after, 500, 4);
  EXPECT_GT(gain.reduction_pct, 0.0);
  EXPECT_LE(gain.low_pct, 0.0);
}

TEST(Gain, StandardisedResidualsAreTheDifferencesOverTheDeviations) {
  const Chain chain({.masses = 6, .modes = 4});
  ChainTruth truth = chain.as_modelled();
  truth.spring[1] = 0.8;
  const auto features = chain.measure(truth);
  const Examined e = examine(chain, features, catalogue({"gain"}));
  const auto fit = e.inference->fit({}, {});
  const Eigen::VectorXd z = diagnosis::standardised_residuals(*e.inference, fit);
  // Row 0 is the first frequency: in ln, deviation 0.3 %.
  EXPECT_NEAR(z[0], (std::log(features.rows[0].value) - fit.all.g[0]) / 0.003, 1e-9);
  EXPECT_NEAR(z[1], (features.rows[1].value - fit.all.g[1]) / 0.02, 1e-9);
}

}  // namespace
}  // namespace twindeck::tests
