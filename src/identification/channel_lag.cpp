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
constexpr double kOwnTurn_rad = 0.1;     // of a component in a structure with dampers
constexpr double kStepsToNear = 200.0;   // of the search, per quarter period of the highest mode

/// Brings an angle into [-pi/2, pi/2].
double half_turn(double angle) { return angle - pi * std::round(angle / pi); }

double cost(const std::vector<Phase>& phases, double tau, double own_variance) {
  double sum = 0.0;
  for (const Phase& p : phases)
    sum += std::pow(half_turn(p.angle_rad + p.omega_rad_s * tau), 2) / (1.0 / p.weight + own_variance);
  return sum;
}

}  // namespace

bool Lag::matters(double highest_Hz) const {
  return std::abs(seconds) > kLagDeviations * deviation_s && 360.0 * highest_Hz * std::abs(seconds) > kLagTurn_deg;
}

std::optional<Lag> fitted_lag(const std::vector<Phase>& phases) {
  if (phases.size() < 2) return {};
  double highest = 0.0, lowest = phases.front().omega_rad_s, information = 0.0;
  for (const Phase& p : phases) {
    highest = std::max(highest, p.omega_rad_s);
    lowest = std::min(lowest, p.omega_rad_s);
    information += p.weight * p.omega_rad_s * p.omega_rad_s;
  }
  const double near = 0.5 * pi / highest, step = near / kStepsToNear, reach = pi / lowest;
  const auto score = [&](double tau) {  // -2 ln of likelihood × prior
    return cost(phases, tau, kOwnTurn_rad * kOwnTurn_rad) + 2.0 * std::log1p(std::pow(tau / near, 2));
  };
  double best = 0.0, least = score(0.0);
  for (double size = step; size <= reach; size += step)
    for (const double tau : {-size, size})
      if (const double value = score(tau); value < least) {
        least = value;
        best = tau;
      }
  // One Gauss-Newton step on the branch found.
  double gradient = 0.0;
  for (const Phase& p : phases) gradient += p.weight * p.omega_rad_s * half_turn(p.angle_rad + p.omega_rad_s * best);
  best -= gradient / information;
  // Mode shapes are slightly complex, so the residual of the lag counts too.
  const double scatter = std::max(1.0, cost(phases, best, 0.0) / static_cast<double>(phases.size() - 1));
  return Lag{best, std::sqrt(scatter / information)};
}

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
    const auto lag = at == 0 ? std::optional<Lag>(Lag{}) : fitted_lag(phases);
    if (!lag) continue;
    for (ChannelQuality& quality : conditioned.quality) {
      if (quality.channel != conditioned.channels[c].name) continue;
      quality.lag_s = lag->seconds;
      quality.lag_std_s = lag->deviation_s;
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
    if (!Lag{lag_s, *row->lag_std_s}.matters(highest_Hz)) continue;
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
