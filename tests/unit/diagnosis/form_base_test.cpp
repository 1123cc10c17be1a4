// Oracles: a fit to the rows of one condition alone; covariances of independent errors; modes that are made to be like no
// other.
#include "diagnosis/form_base.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

FeatureSet none_held_out(FeatureSet f) {
  for (auto& row : f.rows) row.held_out = false;
  return f;
}

/// Rows of two measurements in one list; the second is of the condition that `change` makes of the first.
template <typename Change>
FeatureSet measured_twice(const FeatureSet& first, const FeatureSet& second, const Change& change) {
  FeatureSet out = none_held_out(first);
  out.conditions.push_back(out.conditions.front());
  out.conditions.back().name = "second";
  change(out.conditions[0], out.conditions[1]);
  for (auto row : second.rows) {
    row.held_out = false;
    row.condition = 1;
    out.rows.push_back(row);
  }
  return out;
}

ChainTruth with_spring(const Chain& chain, int spring, double factor) {
  ChainTruth truth = chain.as_modelled();
  truth.spring[spring] = factor;
  return truth;
}

/// Values of the parameters and of the scatter at a fit; levels that belong to a condition are left out.
VectorXd springs_of(const Examined& e, const diagnosis::Fit& fit) {
  std::vector<double> out;
  for (std::size_t j = 0; j < e.map->nuisances().size(); ++j)
    if (e.map->nuisances()[j].kind == diagnosis::Nuisance::Kind::parameter) out.push_back(fit.map.x[static_cast<Index>(j)]);
  return Eigen::Map<const VectorXd>(out.data(), std::ssize(out));
}

void expect_first_fit_is_that_of(const Chain& chain, const FeatureSet& both, const FeatureSet& one) {
  const Examined all = examine(chain, both, catalogue({"gain"})),
                 alone = examine(chain, none_held_out(one), catalogue({"gain"}));
  const VectorXd found = springs_of(all, diagnosis::first_fit(*all.inference, *all.inference));
  const VectorXd expected = springs_of(alone, alone.inference->fit({}, {}));
  ASSERT_EQ(found.size(), chain.structure().system->parameters.size());
  EXPECT_LT((found - expected).norm(), 0.02 * expected.norm());
  const VectorXd compromise = springs_of(all, all.inference->fit({}, {}));
  EXPECT_GT((compromise - expected).norm(), 0.2 * expected.norm());
}

TEST(FirstFit, IsToTheFirstState) {
  const Chain chain({.masses = 8, .modes = 5});
  const FeatureSet sound = chain.measure(with_spring(chain, 2, 1.05)), changed = chain.measure(with_spring(chain, 5, 0.93));
  expect_first_fit_is_that_of(
      chain, measured_twice(sound, changed, [](auto&, diagnosis::Condition& second) { second.state = "after"; }), sound);
}

TEST(FirstFit, IsToTheHighestTemperature) {
  const Chain chain({.masses = 8, .modes = 5});
  const FeatureSet warm = chain.measure(with_spring(chain, 2, 1.05)), cold = chain.measure(with_spring(chain, 5, 0.93));
  const auto temperatures = [](double one, double two) {
    return [=](diagnosis::Condition& first, diagnosis::Condition& second) {
      first.temperature_C = one;
      second.temperature_C = two;
    };
  };
  expect_first_fit_is_that_of(chain, measured_twice(warm, cold, temperatures(25.0, -5.0)), warm);
  expect_first_fit_is_that_of(chain, measured_twice(cold, warm, temperatures(-5.0, 25.0)), warm);
}

TEST(FirstFit, IsToTheLeastAmplitudeWindAndCrowd) {
  const Chain chain({.masses = 8, .modes = 5});
  const FeatureSet calm = chain.measure(with_spring(chain, 2, 1.05)), busy = chain.measure(with_spring(chain, 5, 0.93));
  expect_first_fit_is_that_of(chain,
                              measured_twice(calm, busy,
                                             [](diagnosis::Condition& first, diagnosis::Condition& second) {
                                               first.wind_m_s = 1.0;
                                               second.wind_m_s = 15.0;
                                             }),
                              calm);
}

TEST(WithFormError, AddsErrorsWhoseVarianceGoesWithTheSquareOfTheLevel) {
  const Chain chain({.masses = 8, .modes = 5});
  const Examined e = examine(chain, none_held_out(chain.measure(chain.as_modelled())), catalogue({"gain"}));
  const auto base = e.map->base(VectorXd::Zero(std::ssize(e.map->nuisances())));
  const VectorXd g = e.map->predict(base, {}, false).g;
  const auto added = [&](double frequency, double shape) -> MatrixXd {
    return diagnosis::with_form_error(*e.map, base, g, {frequency, shape}).covariance() - e.map->covariance();
  };
  EXPECT_EQ(added(0.0, 0.0).norm(), 0.0);
  const MatrixXd frequency = added(0.01, 0.0), shape = added(0.0, 0.02);
  for (std::size_t r = 0; r < e.map->features().rows.size(); ++r) {
    const auto at = static_cast<Index>(r);
    const bool is_frequency = e.map->features().rows[r].type == RowType::frequency;
    EXPECT_NEAR(frequency(at, at), is_frequency ? 1e-4 : 0.0, 1e-9) << r;  // of ln f
    EXPECT_TRUE(shape(at, at) == 0.0 || !is_frequency) << r;
  }
  EXPECT_GT(shape.trace(), 0.0);
  EXPECT_LT((added(0.03, 0.0) - 9.0 * frequency).norm(), 1e-9 * frequency.norm());
  EXPECT_LT((added(0.0, 0.06) - 9.0 * shape).norm(), 1e-9 * shape.norm());
  EXPECT_LT((added(0.01, 0.02) - frequency - shape).norm(), 1e-9 * shape.norm());
}

diagnosis::FormLevel level_of(const Examined& e) {
  const auto prior = e.map->base(VectorXd::Zero(std::ssize(e.map->nuisances())));
  return diagnosis::level_of_fits(*e.inference, prior, e.map->predict(prior, {}, false).g);
}

TEST(LevelOfFits, StandsALargerErrorWhereTheModelIsFarOff) {
  const Chain chain({.masses = 10, .modes = 8});
  EXPECT_EQ(level_of(examine(chain, none_held_out(chain.measure(chain.as_modelled())), catalogue({"gain"}))).shape, 0.01);
  ChainTruth off = chain.as_modelled();
  for (int s = 0; s <= 10; ++s) off.spring[s] = s % 3 == 0 ? 0.45 : 1.9;
  EXPECT_GT(level_of(examine(chain, none_held_out(chain.measure(off)), catalogue({"gain"}))).shape, 0.01);
}

}  // namespace
}  // namespace twindeck::tests
