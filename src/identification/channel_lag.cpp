#include "identification/channel_lag.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace twindeck::identification {

using std::numbers::pi;

namespace {

constexpr double kLagDeviations = 10.0;  // damped modes have complex shapes, which look like a lag of up to six deviations
constexpr double kLagTurn_deg = 10.0;    // at the highest mode found; it lowers the collinearity of a two-channel shape by 3 %

struct Phase {
  double omega = 0.0, angle = 0.0, weight = 0.0;  ///< angle relative to the first channel; weight 1/variance
};

/// Brings an angle into [-pi/2, pi/2), because the sign of a shape is arbitrary.
double half_turn(double angle) { return angle - pi * std::round(angle / pi); }

struct Lag {
  double seconds = 0.0, deviation = 0.0;
};

std::optional<Lag> fitted(const std::vector<Phase>& phases) {
  if (phases.size() < 2) return {};
  double highest = 0.0, information = 0.0;
  for (const Phase& p : phases) {
    highest = std::max(highest, p.omega);
    information += p.weight * p.omega * p.omega;
  }
  const double reach = 0.5 * pi / highest;
  const auto cost = [&](double tau) {
    double sum = 0.0;
    for (const Phase& p : phases) sum += p.weight * std::pow(half_turn(p.angle + p.omega * tau), 2);
    return sum;
  };
  double best = 0.0, least = cost(0.0);
  for (int k = -200; k <= 200; ++k) {
    const double tau = reach * k / 200.0, value = cost(tau);
    if (value < least) {
      least = value;
      best = tau;
    }
  }
  // One Gauss-Newton step on the branch found.
  double gradient = 0.0;
  for (const Phase& p : phases) gradient += p.weight * p.omega * half_turn(p.angle + p.omega * best);
  best -= gradient / information;
  // Mode shapes are slightly complex, so the residual of the lag counts too.
  const double scatter = std::max(1.0, cost(best) / static_cast<double>(phases.size() - 1));
  return Lag{best, std::sqrt(scatter / information)};
}

}  // namespace

void estimate_lags(Conditioned& conditioned, const Identification& found) {
  for (std::size_t c = 0; c < conditioned.channels.size(); ++c) {
    const auto at = static_cast<Eigen::Index>(c);
    std::vector<Phase> phases;
    for (std::size_t m = 0; m < found.modes.size() && m < found.deviations.size(); ++m) {
      const Eigen::VectorXcd& shape = found.modes[m].shape;
      const double size = std::abs(shape[at]), first = std::abs(shape[0]);
      const double deviation = found.deviations[m].shape_imag[at], first_deviation = found.deviations[m].shape_imag[0];
      // A component no larger than its noise has no phase.
      if (size < 5.0 * deviation || first < 5.0 * first_deviation || deviation <= 0.0) continue;
      const double variance = std::pow(deviation / size, 2) + std::pow(first_deviation / first, 2);
      phases.push_back({2.0 * pi * found.modes[m].frequency_Hz, std::arg(shape[at] * std::conj(shape[0])), 1.0 / variance});
    }
    const auto lag = at == 0 ? std::optional<Lag>(Lag{}) : fitted(phases);
    if (!lag) continue;
    for (ChannelQuality& quality : conditioned.quality) {
      if (quality.channel != conditioned.channels[c].name) continue;
      quality.lag_s = lag->seconds;
      quality.lag_std_s = lag->deviation;
    }
  }
}

std::string lag_warning(const Conditioned& conditioned, const Identification& found) {
  double highest_Hz = 0.0;
  for (const Cluster& mode : found.modes) highest_Hz = std::max(highest_Hz, mode.frequency_Hz);
  std::vector<std::string> off;
  for (const records::CampaignChannel& channel : conditioned.channels) {
    const auto row = std::ranges::find_if(conditioned.quality,
                                          [&](const ChannelQuality& q) { return q.channel == channel.name && q.lag_s; });
    if (row == conditioned.quality.end() || !row->lag_std_s) continue;
    const double lag_s = *row->lag_s, turn_deg = 360.0 * highest_Hz * std::abs(lag_s);
    if (std::abs(lag_s) <= kLagDeviations * *row->lag_std_s || turn_deg <= kLagTurn_deg) continue;
    off.push_back(fmt::format("{} is {:.3g} ± {:.2g} ms {} ({:.3g} degrees at {:.4g} Hz)", channel.name, 1e3 * std::abs(lag_s),
                              1e3 * *row->lag_std_s, lag_s > 0.0 ? "behind" : "ahead", turn_deg, highest_Hz));
  }
  if (off.empty()) return "";
  return fmt::format(
      "setup {}: not on the clock of {}: {}: shapes are bent and modes may be missing; shift the channel in its record, or "
      "leave it out (--set exclude=…)",
      conditioned.setup, conditioned.channels.front().name, fmt::join(off, ", "));
}

}  // namespace twindeck::identification
