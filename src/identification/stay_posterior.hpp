#pragma once

#include <optional>
#include <vector>

#include "identification/tensioned_beam.hpp"

namespace twindeck::identification {

/// A stay's harmonic, measured.
struct Harmonic {
  int number = 0;  ///< n, from 1
  double frequency_Hz = 0.0;
  double deviation_Hz = 0.0;  ///< standard deviation, > 0
};

/// What is known of a stay beside its frequencies.
struct StaySection {
  double length_m = 0.0;                ///< L; 0: unknown
  double bending_per_mass_m4_s2 = 0.0;  ///< EI/m of the section; 0: unknown, then it is fitted. Needs the length
  std::optional<double> fixity = {};    ///< of the ends; empty: unknown
};

/// A small part of the parameter space with its share of the probability.
struct StayPart {
  double log_weight = 0.0;                ///< logarithm of the probability, not normalised
  double log_c = 0.0;                     ///< mean of ln(c/1 Hz) there: the taut string's frequency
  double log_c_deviation = 0.0;           ///< its standard deviation
  TensionedBeam beam;                     ///< with the mean of the sag there
  double sag = 0.0, sag_deviation = 0.0;  ///< of ln(1 + lambda²)
};

/// What the harmonics say of a stay whose bending stiffness, sag and ends are unknown: a sum over hinged ends, clamped ends and
/// springs between, and over xi, each part weighted by its likelihood; c and ln(1 + lambda²) follow by least squares in each,
///
///     ln f_n = ln c + ln r_n(xi, lambda², ends) + e_n,    e_n ~ s sigma_n/f_n,
///
/// where the factor s of the stated deviations is unknown too (Student's t). Priors: hinged and clamped ends 0.45 each, springs
/// 1/10; ln xi and ln(1 + lambda²) uniform over xi 4 … 4000 and lambda² 0 … 60. Where the section is known, xi² = L²
/// (T/m)/(EI/m) within ten per cent of EI.
struct StayPosterior {
  std::vector<StayPart> parts;
  double log_evidence = 0.0;  ///< logarithm of the density of ln f_n under all models together
};

/// Quick: hinged and clamped ends alone.
enum class Effort { quick, full };

/// @param harmonics  one or more, numbers distinct, frequencies and deviations positive
/// @throws InputError  otherwise
[[nodiscard]] StayPosterior stay_posterior(const std::vector<Harmonic>& harmonics, const StaySection& section, Effort effort);

}  // namespace twindeck::identification
