#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::fe {

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
/// @throws InputError for anchors one above the other (a hanging rope has no sag), no tension, a sag above a third of the span
[[nodiscard]] HangingChain hang_chain(const Eigen::Vector3d& first_m, const Eigen::Vector3d& second_m,
                                      double weight_per_length_N_m, double chord_tension_N, int n_bars);

}  // namespace twindeck::fe
