#pragma once

#include <Eigen/Core>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::fe {

/// Matrices that turn the bar of a stay into a cable that can vibrate between its ends. The cable is a chain of straight pieces
/// in the parabola of its own weight under the force T. Each piece has the axial stiffness E A and the string stiffness T/l
/// across it. Masses are half lumped and half consistent (their errors in frequency have opposite signs and cancel to fourth
/// order). The static stiffness of the chain between its ends, and the mass of the bar, are subtracted from the block of the
/// ends, because the bar has them. Statics therefore do not change, and bar plus cable equal the chain.
struct Cable {
  std::vector<Eigen::Vector3d> inner_x_m;  ///< (pieces - 1) nodes between the ends
  Eigen::MatrixXd stiffness;  ///< [N/m] (3 pieces + 3)²: x y z of the first end, of the second, of each inner node
  Eigen::MatrixXd mass;       ///< [kg] likewise
};

/// @param force_N > 0  @param pieces >= 2
/// @throws InputError  for a stay without a cable force
/// Reference: Irvine (1981), Cable Structures, chapters 2 and 3.
[[nodiscard]] Cable cable_beyond_bar(const Model& model, const Element& stay, double force_N, int pieces);

/// Frequencies of a cable between fixed ends in its vertical plane, ascending, [Hz] (pieces / 2), as an accelerometer on the
/// stay measures them. The last one is 1.4 % too low.
[[nodiscard]] Eigen::VectorXd in_plane_frequencies(const Model& model, const Element& stay, const Cable& cable);

/// A measured frequency of a stay.
struct StayHarmonic {
  int number = 1;  ///< 1: the first
  double frequency_Hz = 0.0, relative_std = 0.01;
};

/// Cable force [N] that fits the in-plane frequencies to the measured ones by weighted least squares, sag included.
/// @param harmonics  those beyond pieces / 2 are not used @return 0 if no harmonic is left
[[nodiscard]] double force_of_harmonics(const Model& model, const Element& stay, const std::vector<StayHarmonic>& harmonics,
                                        int pieces);

}  // namespace twindeck::fe
