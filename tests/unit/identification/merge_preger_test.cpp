// Oracles: exact correlations of a chain in closed form, so that poles and shapes are its own to rounding; other excitation and
// gain of a setup change nothing (property of PreGER).
#include "identification/merge_preger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "chain.hpp"
#include "core/error.hpp"

namespace twindeck::identification {
namespace {

const test::Chain kThreeMasses(3, 12.0, 0.02, 20.0);
constexpr Eigen::Index kExactRows = 12;

/// One setup's exact correlations. @param channels  of the chain; the first `n_references` stay
SetupCorrelations exact_setup(const std::vector<Eigen::Index>& channels, Eigen::Index n_references, double gain) {
  SetupCorrelations setup{"S", channels, {}, {}};
  for (Eigen::Index r = 0; r < n_references; ++r) setup.references.push_back(r);
  const std::vector<Eigen::Index> references(channels.begin(), channels.begin() + n_references);
  for (const Eigen::MatrixXd& lag : kThreeMasses.exact_correlations(2 * kExactRows))
    setup.lags.emplace_back(gain * gain * lag(channels, references));
  return setup;
}

/// All poles are those of the chain. The pseudo-inverse of the states is regularised by 1e-10 of their mean square, which may
/// take as much of a weak mode's entries: 1e-4. Frequencies and damping come from all rows: 1e-5.
void expect_chain(const std::vector<Pole>& poles, const std::vector<Eigen::Index>& measured, Eigen::Index n_channels) {
  ASSERT_EQ(poles.size(), 3U);
  for (int r = 0; r < 3; ++r) {
    const Pole& pole = poles[static_cast<std::size_t>(r)];
    EXPECT_NEAR(pole.frequency_Hz / kThreeMasses.frequency_Hz(r), 1.0, 1e-5);
    EXPECT_NEAR(pole.damping_ratio, 0.02, 1e-5);
    ASSERT_EQ(pole.shape.size(), n_channels);
    const Eigen::VectorXcd shape = pole.shape(measured);
    EXPECT_LT((shape - normalised_shape(kThreeMasses.shape(r).cast<std::complex<double>>())).norm(), 1e-4) << r;
    EXPECT_NEAR(pole.shape.norm(), 1.0, 1e-12);
  }
}

TEST(MergePregerExact, TwoSetupsGiveTheWholeChain) {
  const auto poles = merge_preger({exact_setup({0, 1}, 1, 1.0), exact_setup({0, 2}, 1, 1.0)}, 3, kExactRows, {6}, 20.0);
  ASSERT_EQ(poles.size(), 1U);
  expect_chain(poles[0], {0, 1, 2}, 3);
  EXPECT_EQ(poles[0][0].order, 6);
}

TEST(MergePregerExact, ASetupsGainChangesNothing) {
  const auto poles = merge_preger({exact_setup({0, 1}, 1, 1e3), exact_setup({0, 2}, 1, 1e-3)}, 3, kExactRows, {6}, 20.0);
  expect_chain(poles[0], {0, 1, 2}, 3);
}

TEST(MergePregerExact, TheOrderOfSetupsChangesNothing) {
  const auto poles = merge_preger({exact_setup({0, 2}, 1, 1.0), exact_setup({0, 1}, 1, 1.0)}, 3, kExactRows, {6}, 20.0);
  expect_chain(poles[0], {0, 1, 2}, 3);
}

// One setup's modes are excited otherwise: each column of a setup's correlations is multiplied by one number a mode.
TEST(MergePregerExact, OtherExcitationOfASetupChangesNothing) {
  SetupCorrelations second = exact_setup({0, 2}, 1, 1.0);
  const auto one = kThreeMasses.exact_correlations(2 * kExactRows);
  for (std::size_t k = 0; k < second.lags.size(); ++k) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3, 3);
    for (int r = 0; r < 3; ++r) {
      const Eigen::VectorXd phi = kThreeMasses.shape(r);
      all += (1.0 + 2.0 * r) * phi.dot(one[k] * phi) * phi * phi.transpose();
    }
    second.lags[k] = all(std::vector<Eigen::Index>{0, 2}, std::vector<Eigen::Index>{0});
  }
  expect_chain(merge_preger({exact_setup({0, 1}, 1, 1.0), second}, 3, kExactRows, {6}, 20.0)[0], {0, 1, 2}, 3);
}

// References that do not stand first among a setup's outputs, and a list of channels with gaps.
TEST(MergePregerExact, ChannelsAreInTheirPlaces) {
  SetupCorrelations first{"S", {4, 0}, {1}, {}}, second{"T", {0, 2}, {0}, {}};  // channel 0 stays; mass 1 at 4, mass 2 at 2
  for (const Eigen::MatrixXd& lag : kThreeMasses.exact_correlations(2 * kExactRows)) {
    first.lags.emplace_back(lag(std::vector<Eigen::Index>{1, 0}, std::vector<Eigen::Index>{0}));
    second.lags.emplace_back(lag(std::vector<Eigen::Index>{0, 2}, std::vector<Eigen::Index>{0}));
  }
  const auto poles = merge_preger({first, second}, 5, kExactRows, {6}, 20.0);
  expect_chain(poles[0], {0, 4, 2}, 5);
  for (const Pole& pole : poles[0]) EXPECT_EQ(std::abs(pole.shape[1]) + std::abs(pole.shape[3]), 0.0);  // not measured
}

// All sensors stay: a setup without moving ones.
TEST(MergePregerExact, OneSetupOfReferencesAlone) {
  expect_chain(merge_preger({exact_setup({0, 1, 2}, 3, 1.0)}, 3, kExactRows, {6}, 20.0)[0], {0, 1, 2}, 3);
}

TEST(MergePregerExact, EachOrderHasItsPoles) {
  const auto poles = merge_preger({exact_setup({0, 1}, 1, 1.0), exact_setup({0, 2}, 1, 1.0)}, 3, kExactRows, {2, 4, 6}, 20.0);
  ASSERT_EQ(poles.size(), 3U);
  expect_chain(poles[2], {0, 1, 2}, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Pole& pole : poles[k]) EXPECT_EQ(pole.order, static_cast<int>(2 * (k + 1)));
  }
}

// An order of more states than the records have: the pseudo-inverse is of a matrix without full rank, and stays finite.
TEST(MergePregerExact, ATooHighOrderKeepsThePolesOfTheChain) {
  const auto poles = merge_preger({exact_setup({0, 1}, 1, 1.0), exact_setup({0, 2}, 1, 1.0)}, 3, kExactRows, {8}, 20.0);
  ASSERT_EQ(poles.size(), 1U);
  for (int r = 0; r < 3; ++r) {
    const Eigen::VectorXcd expected = normalised_shape(kThreeMasses.shape(r).cast<std::complex<double>>());
    const bool there = std::any_of(poles[0].begin(), poles[0].end(), [&](const Pole& pole) {
      return std::abs(pole.frequency_Hz / kThreeMasses.frequency_Hz(r) - 1.0) < 1e-4 && (pole.shape - expected).norm() < 1e-3;
    });
    EXPECT_TRUE(there) << r;
  }
}

// (p - 1) r = 11 orders at most.
TEST(MergePregerExact, MoreOrdersThanTheReferencesCarryAreRefused) {
  const std::vector<SetupCorrelations> setups = {exact_setup({0, 1}, 1, 1.0), exact_setup({0, 2}, 1, 1.0)};
  EXPECT_NO_THROW(static_cast<void>(merge_preger(setups, 3, kExactRows, {11}, 20.0)));
  EXPECT_THROW(static_cast<void>(merge_preger(setups, 3, kExactRows, {6, 12}, 20.0)), InputError);
  EXPECT_THROW(static_cast<void>(merge_preger({}, 3, kExactRows, {6}, 20.0)), InternalError);
  EXPECT_THROW(static_cast<void>(merge_preger(setups, 3, kExactRows, {}, 20.0)), InternalError);
}

}  // namespace
}  // namespace twindeck::identification
