#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace twindeck::fe::verification {

/// A stay or cable as a chain of straight bars that hang in equilibrium between two anchors.
struct HangingChain {
  std::vector<Eigen::Vector3d> node_m;  ///< (n + 1) from the first anchor to the second
  std::vector<double> tension_N;        ///< (n) of each bar: its initial tension (Element::pull_N)
};

/// Shape and tensions of `n_bars` bars of equal horizontal length under their own weight (half of each at its two ends, as the
/// lumped mass has it) whose mean force along the chord is `chord_tension_N`: the horizontal component H = T cos(chord) is the
/// same in all of them, so the link polygon follows from vertical equilibrium; the weights follow the lengths, by iteration.
/// Bars with these tensions and this weight are in equilibrium as they stand, so their geometric stiffness is that about the
/// sagged shape, and axial stiffness and sag act together as in Irvine (1981), Cable Structures, chapter 3.
/// @param weight_per_length_N_m  along the bars; gravity is along -Z
/// The anchors must not stand one above the other.
inline HangingChain hang_chain(const Eigen::Vector3d& first_m, const Eigen::Vector3d& second_m, double weight_per_length_N_m,
                               double chord_tension_N, int n_bars) {
  const Eigen::Vector3d chord = second_m - first_m;
  const double span = chord.head<2>().norm();
  const double horizontal = chord_tension_N * span / chord.norm();
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

}  // namespace twindeck::fe::verification
