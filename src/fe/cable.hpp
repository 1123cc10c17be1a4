#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
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

/// A stay that shall vibrate.
struct SwingingStay {
  int element = -1;      ///< position in Model::elements
  double force_N = 0.0;  ///< cable force that determines its frequencies
};

/// The model with vibrating stays. Each stay keeps its element, with its stiffness between the ends, its cable force, its name
/// and its parameters. A matrix element "cable_NE8" of group "cables" is added over both ends and `pieces - 1` new nodes
/// between them (fe/cable.hpp). Statics and prestress do not change, and the modes are those of a cable in several elements.
/// The result can be written as a model folder.
///
/// New nodes follow those of the model; their numbers begin at the next full million, so that they cannot match a sensor by
/// accident.
/// @throws InputError  for a stay without force
[[nodiscard]] Model with_swinging_stays(Model model, const std::vector<SwingingStay>& stays, int pieces);

/// Name of a stay: as in elements.csv, else its number.
[[nodiscard]] std::string stay_name(const Element& stay);

/// A model whose stays are chains of pieces with inner nodes, so that the stays have their own modes.
struct StayChains {
  Model model;
  PrestressState state;                           ///< cable forces and axial forces for `assemble`
  std::map<std::string, std::vector<int>> nodes;  ///< stay -> its nodes from end to end (pieces + 1)
};

/// Divides stays into `pieces` on the parabola of the stay under its own weight,
///
///     drop(xi) = 4 d xi (1 - xi),   d = m g L² / (8 T),   xi = 0 … 1 along the chord,
///
/// vertically below the chord of length L, cable force T, mass per length m. With the axial stiffness along its pieces and the
/// string stiffness T/l across them, the chain has Irvine's modes, sag included, in and out of plane. Between its ends it has
/// the static stiffness of Dischinger's modulus. Half of each piece's mass is at each of its ends. New nodes and pieces follow
/// those of the model, so that its degrees of freedom keep their numbers.
/// @param state   cable forces of the undivided stays, axial forces of all other elements
/// @param pieces  >= 2
/// @param names   stays that are divided; the others stay as they are
/// @throws InputError  for a stay without a cable force, or a name that is not a stay
/// Reference: Irvine (1981), Cable Structures, chapters 2 and 3.
[[nodiscard]] StayChains with_stay_chains(const Model& model, const PrestressState& state, int pieces,
                                          const std::vector<std::string>& names);

}  // namespace twindeck::fe
