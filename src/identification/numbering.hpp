#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "identification/stay_posterior.hpp"

namespace twindeck::identification {

/// Number of a harmonic to the position of its frequency in the list.
using Numbers = std::map<int, std::size_t>;

/// The frequencies that lie near the harmonics of a beam.
/// @param frequencies_Hz  ascending @param reach  [-] largest distance as a share of the spacing of neighbouring harmonics
/// @param least  [-] relative distance that always counts as near
[[nodiscard]] Numbers numbers_near(const std::vector<double>& frequencies_Hz, double c_Hz, const TensionedBeam& beam,
                                   double reach, double least = 0.0);

/// Numberings worth comparing: those of a coarse grid of beams, each put through each frequency under each number, the ones
/// that explain the most first. @param lowest_Hz, highest_Hz  range of c; highest 0: any
[[nodiscard]] std::vector<Numbers> candidate_numbers(const std::vector<double>& frequencies_Hz, double lowest_Hz,
                                                     double highest_Hz);

}  // namespace twindeck::identification
