#pragma once

#include <Eigen/Core>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::fe {

/// What a stay has beyond the bar that `assemble` makes of it once it may swing between its ends: a chain of straight pieces
/// that hangs in the parabola of its own weight under its force T, with the axial stiffness E A along each piece, the string
/// stiffness T/l across it, and masses half lumped and half consistent (their errors in frequency have opposite signs and
/// cancel to fourth order). The static stiffness of the chain between its ends, and the mass of the bar, are taken out of the
/// block of the ends: the bar has them. So statics do not change, and bar and cable together are the chain.
struct Cable {
  std::vector<Eigen::Vector3d> inner_x_m;  ///< (pieces - 1) nodes between the ends
  Eigen::MatrixXd stiffness;  ///< [N/m] (3 pieces + 3)²: x y z of the first end, of the second, of each inner node
  Eigen::MatrixXd mass;       ///< [kg] likewise
};

/// @param force_N > 0  @param pieces >= 2
/// @throws InputError  for a stay without force
/// Reference: Irvine (1981), Cable Structures, chapters 2 and 3.
[[nodiscard]] Cable cable_beyond_bar(const Model& model, const Element& stay, double force_N, int pieces);

/// Frequencies of a cable between fixed ends in its vertical plane, ascending, [Hz] (pieces / 2): what an accelerometer on the
/// stay shows. With `pieces` pieces the last of them is 1.4 % too low.
[[nodiscard]] Eigen::VectorXd in_plane_frequencies(const Model& model, const Element& stay, const Cable& cable);

/// A measured frequency of a stay.
struct StayHarmonic {
  int number = 1;  ///< 1: the first
  double frequency_Hz = 0.0, relative_std = 0.01;
};

/// The force with which the cable's in-plane frequencies lie nearest to measured ones, weighted by their deviations; sag
/// included. [N]
/// @param harmonics  those beyond pieces / 2 are not used @return 0 where none is left
[[nodiscard]] double force_of_harmonics(const Model& model, const Element& stay, const std::vector<StayHarmonic>& harmonics,
                                        int pieces);

}  // namespace twindeck::fe
