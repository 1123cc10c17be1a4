#include "fe/hanging_chain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::fe {

HangingChain hang_chain(const Eigen::Vector3d& first_m, const Eigen::Vector3d& second_m, double weight_per_length_N_m,
                        double chord_tension_N, int n_bars) {
  TWINDECK_ASSERT(n_bars >= 1);
  const Eigen::Vector3d chord = second_m - first_m;
  const double span = chord.head<2>().norm();
  const auto refuse = [](const std::string& problem, const std::string& mend) { throw InputError({}, problem, mend); };
  if (!(span > 1e-6 * chord.norm()))
    refuse("the anchors of the cable stand one above the other, expected a horizontal distance", "model it by one bar");
  if (!(chord_tension_N > 0.0)) refuse(fmt::format("the cable's tension is {:g} N", chord_tension_N), "give it a pull");
  const double horizontal = chord_tension_N * span / chord.norm();
  const double sag = weight_per_length_N_m * chord.norm() * span / (8.0 * horizontal);
  if (sag > span / 3.0)
    refuse(fmt::format("the cable would sag by {:g} m over a span of {:g} m", sag, span), "raise its tension");

  const auto n = static_cast<std::size_t>(n_bars);
  const double dx = span / n_bars;
  std::vector<double> vertical(n), length(n, chord.norm() / n_bars);
  // The error falls by about (sag / span)² in each round.
  for (int round = 0; round < 60; ++round) {
    double sum = 0.0;  // of the vertical forces above that of the first bar
    vertical[0] = 0.0;
    for (std::size_t i = 1; i < n; ++i) {
      vertical[i] = vertical[i - 1] + 0.5 * weight_per_length_N_m * (length[i - 1] + length[i]);
      sum += vertical[i];
    }
    const double first = (chord.z() * horizontal / dx - sum) / n_bars;
    double change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      vertical[i] += first;
      const double now = std::hypot(dx, dx * vertical[i] / horizontal);
      change = std::max(change, std::abs(now - length[i]));
      length[i] = now;
    }
    if (change < 1e-15 * chord.norm()) break;
  }
  HangingChain chain;
  chain.node_m.push_back(first_m);
  const Eigen::Vector3d step(dx * chord.x() / span, dx * chord.y() / span, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    chain.node_m.push_back(chain.node_m.back() + step + Eigen::Vector3d(0.0, 0.0, dx * vertical[i] / horizontal));
    chain.tension_N.push_back(std::hypot(horizontal, vertical[i]));
  }
  chain.node_m.back() = second_m;
  return chain;
}

}  // namespace twindeck::fe
