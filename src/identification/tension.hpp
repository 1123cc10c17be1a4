#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "identification/stay_posterior.hpp"

namespace twindeck::identification {

/// A quantity with the bounds of its interval at the requested level. The value is the median.
struct Bounded {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Frequencies numbered as harmonics of one stay.
struct Numbering {
  std::vector<Harmonic> harmonics;     ///< ascending in number
  std::vector<std::size_t> positions;  ///< positions of the harmonics among the frequencies
  double probability = 0.0;            ///< among the compared numberings
};

/// Force, sag, bending stiffness and ends of a stay.
struct StayFit {
  Bounded c_Hz;                        ///< frequency of the taut string, sqrt(T/m)/(2 L)
  Bounded tension_per_mass;            ///< T/m = (2 L c)² [m²/s²]
  Bounded lambda_squared;              ///< Irvine's parameter
  Bounded xi;                          ///< L sqrt(T/EI)
  double hinged = 0.0, clamped = 0.0;  ///< probabilities of the ends; the rest belongs to springs
  double residual = 0.0;               ///< RMS of the normalised residuals of the likeliest beam
  Numbering numbering;                 ///< the most probable
  std::vector<Numbering> others;       ///< other numberings above one per cent, the most probable first
};

/// Numbers the frequencies of a stay as harmonics, and estimates its force, sag and ends. Numberings compete by their evidence
/// (stay_posterior). A frequency that is no harmonic may have any value. A harmonic below the highest one is missing with a
/// probability of fifteen per cent. The intervals include all numberings, all kinds of ends, and the error of the parabola, the
/// excess length (g L/(T/m))²/24 of the arc over the chord.
/// @param frequencies  modes of the record, ascending; their numbers are not read
/// @param lowest_Hz, highest_Hz  range of c; highest 0: any
/// @return  without harmonics where fewer than two frequencies belong together
[[nodiscard]] StayFit fit_stay(const std::vector<Harmonic>& frequencies, const StaySection& section, double level,
                               double lowest_Hz = 0.0, double highest_Hz = 0.0);

/// The same with the numbers as given.
/// @param harmonics  two or more @throws InputError  for fewer, or as stay_posterior
[[nodiscard]] StayFit fit_numbered(const std::vector<Harmonic>& harmonics, const StaySection& section, double level);

/// Number of a harmonic to the position of its frequency in the list.
using Numbers = std::map<int, std::size_t>;

/// The frequencies that lie near the harmonics of a beam.
/// @param frequencies_Hz  ascending @param reach  [-] largest distance as a share of the spacing of neighbouring harmonics
/// @param least  [-] relative distance that always counts as near
[[nodiscard]] Numbers numbers_near(const std::vector<double>& frequencies_Hz, double c_Hz, const TensionedBeam& beam,
                                   double reach, double least = 0.0);

/// Numberings worth comparing: those of a coarse grid of beams, each scaled so that each frequency is each harmonic; numberings
/// with the most explained frequencies come first. @param lowest_Hz, highest_Hz  range of c; highest 0: any
[[nodiscard]] std::vector<Numbers> candidate_numbers(const std::vector<double>& frequencies_Hz, double lowest_Hz,
                                                     double highest_Hz);

}  // namespace twindeck::identification
