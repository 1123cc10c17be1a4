#include "ponte/virtual_bridge/tuning.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "sensitivity/frequency_jacobian.hpp"

namespace twindeck::ponte {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kMovesDecks = 0.5;  ///< [-] of the kinetic energy in stays: a mode with less is one of the decks

/// The modes that calibration starts from: the so many-th of those with less than half of their kinetic energy in the stays.
std::vector<Index> starting_modes(const BridgeState& state, const CampaignSettings& settings) {
  std::vector<Index> deck;
  for (Index j = 0; j < state.stay_share.size(); ++j) {
    if (state.stay_share[j] < kMovesDecks) deck.push_back(j);
  }
  std::vector<Index> named;
  for (const NamedMode& mode : settings.named) {
    if (mode.deck_mode > std::ssize(deck)) {
      throw InputError({"", 0, "mode.deck_mode"},
                       fmt::format("is {}, but only {} of the modes are the deck's", mode.deck_mode, deck.size()),
                       "raise `modes`");
    }
    named.push_back(deck[static_cast<std::size_t>(mode.deck_mode - 1)]);
  }
  return named;
}

}  // namespace

BridgeTuning tune(const VirtualBridge& bridge, const CampaignSettings& settings, const Reporter& reporter) {
  constexpr int kSteps = 40;
  constexpr double kLongestStep = 0.08;  // of a logarithm: further, modes pass each other unseen
  constexpr double kGood = 2e-4;         // a tenth of the 0.2 % allowed
  const Index n = std::ssize(settings.named), p = bridge.uncorrected.size();
  BridgeTuning found{bridge.uncorrected, VectorXd::Zero(n), {false, "no step was made"}};
  std::optional<BridgeState> before;
  for (int step = 0; step < kSteps; ++step) {
    BridgeState state = solve_bridge(bridge, settings, found.theta, settings.modes);
    state.named = before ? follow_named(*before, state) : starting_modes(state, settings);
    const MatrixXd slope = sensitivity::frequency_jacobian(state.system, found.theta, state.modes);
    MatrixXd jacobian(n, p);  // d ln f / d ln theta
    for (Index i = 0; i < n; ++i) {
      const Index at = state.named[static_cast<std::size_t>(i)];
      const double f = state.modes.frequency_Hz[at];
      found.error[i] = std::log(f / settings.named[static_cast<std::size_t>(i)].frequency_Hz);
      jacobian.row(i) = slope.row(at).cwiseProduct(found.theta.transpose()) / f;
    }
    reporter.say(fmt::format("calibration, step {}: largest error {:.4f} %, largest correction {:.2f}", step,
                             100.0 * found.error.cwiseAbs().maxCoeff(),
                             (found.theta.array() / bridge.uncorrected.array()).log().abs().maxCoeff()));
    if (found.error.cwiseAbs().maxCoeff() < kGood) {
      found.status = {true, ""};
      return found;
    }
    // min |e + J d|² / w² + |x + d|² / s² over the change d of the logarithms x.
    const VectorXd x = (found.theta.array() / bridge.uncorrected.array()).log();
    const double w = 1.0 / (settings.frequency_weight * settings.frequency_weight),
                 s = 1.0 / (settings.correction_spread * settings.correction_spread);
    const MatrixXd normal = w * jacobian.transpose() * jacobian + s * MatrixXd::Identity(p, p);
    const VectorXd change = normal.ldlt().solve(-w * jacobian.transpose() * found.error - s * x);
    const double longest = change.cwiseAbs().maxCoeff();
    found.theta = found.theta.array() * (change.array() * std::min(1.0, kLongestStep / longest)).exp();
    before = std::move(state);
    found.status = {false, fmt::format("after {} steps a named frequency is still off by {:.3f} %", step + 1,
                                       100.0 * found.error.cwiseAbs().maxCoeff())};
  }
  return found;
}

}  // namespace twindeck::ponte
