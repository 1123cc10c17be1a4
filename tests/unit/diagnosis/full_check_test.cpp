// The reduced basis against all degrees of freedom. Oracles: a chain's own dense matrices for the full frequencies, the bounds
// of Rayleigh and Ritz (reduced frequencies never lie below the full ones), and 0.1 % as what a diagnosis may lose.
#include "diagnosis/full_check.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

using Eigen::VectorXd;

/// Check of a chain of 120 masses, of which a prediction uses some vectors, with one cause at given magnitudes.
diagnosis::FullCheck check_with(const Chain& chain, const std::string& id, const VectorXd& physical) {
  const auto features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"mass", "tie", "osc", "stiffness"}));
  const auto& candidate = e.entry(id);
  diagnosis::Cause cause{&candidate, physical};
  for (Eigen::Index i = 0; i < physical.size(); ++i)
    if (candidate.log[static_cast<std::size_t>(i)]) cause.a[i] = std::log(physical[i]);
  diagnosis::Fit fit;
  fit.causes = {cause};
  fit.base = e.map->base(VectorXd::Zero(static_cast<Eigen::Index>(e.map->nuisances().size())));
  return diagnosis::check_against_full(chain.structure(), chain.places(), *e.map, fit, 6);
}

TEST(FullCheck, ReducedFrequenciesOfAnExtendedChainAreTheFullOnes) {
  ChainOptions options;
  options.masses = 120;
  options.channels = {9, 29, 49, 69, 89, 109};
  options.modes = 6;
  options.parameters = false;
  const Chain chain(options);
  ASSERT_LT(chain.reduced().common, 60);
  const std::string place = chain.places().sets.at("nodes").front().id;
  const int node = std::atoi(place.substr(place.find(':') + 1).c_str()) - 1;

  const diagnosis::FullCheck heavier = check_with(chain, "mass@" + place, VectorXd::Constant(1, 4000.0));
  ChainTruth truth = chain.as_modelled();
  truth.mass[node] += 4000.0;
  const VectorXd root = truth.mass.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.asDiagonal() * chain.stiffness(truth) * root.asDiagonal());
  for (int m = 0; m < 6; ++m) {
    EXPECT_NEAR(heavier.full_Hz[m], std::sqrt(eigen.eigenvalues()[m]) / (2.0 * std::numbers::pi), 1e-9 * heavier.full_Hz[m]);
    EXPECT_GE(heavier.reduced_Hz[m], heavier.full_Hz[m] * (1.0 - 1e-10));
  }
  EXPECT_LT(heavier.largest_pct, 0.1);

  VectorXd hung(2);
  hung << 3000.0, 1.1 * heavier.full_Hz[1];
  const diagnosis::FullCheck swinging = check_with(chain, "osc@" + place, hung);
  EXPECT_LT(swinging.largest_pct, 0.1);
  // A body on a spring is one more mode: the sixth lies lower than without it.
  EXPECT_LT(swinging.full_Hz[5], 0.97 * heavier.full_Hz[5]);
}

}  // namespace
}  // namespace twindeck::tests
