#pragma once

#include <optional>
#include <vector>

namespace twindeck::identification {

/// A stay or hanger as a beam under tension that sags, with equal rotational springs at both ends.
struct TensionedBeam {
  double xi = 1e4;              ///< L sqrt(T/EI): 6 for a short hanger, above 1000 for a string
  double lambda_squared = 0.0;  ///< Irvine's parameter (m g L cos/T)² E A L/(T L_e) [-], >= 0
  /// Fixity s of the ends: 0 hinged, 1 clamped. Between them the rotational stiffness is s/(1 - s) sqrt(T EI), in units of the
  /// rotational stiffness of a long tensioned beam's end.
  double fixity = 0.0;
};

/// Ratio f_n/c of the n-th in-plane frequency to the taut string's c = sqrt(T/m)/(2 L). With y = cos(a x), cosh(b x) and a
/// constant over the span |x| <= 1/2,
///
///     b² = a² + xi²,   pi f/c = a sqrt(1 + a²/xi²),   kappa = xi s/(1 - s),
///     even n:  a = n pi + 2 phi,  tan(phi) = a/(b coth(b/2) + (a² + b²)/kappa),
///     odd n:   1 = 2 (A tan(a/2)/a + C tanh(b/2)/b)/(A + C) + (pi f/c)²/lambda²,
///              A = b² + kappa b tanh(b/2),  C = a² + kappa a tan(a/2).
///
/// Hinged ends without sag: f_n = n c sqrt(1 + n² pi²/xi²). A string (xi -> infinity): Irvine's equation tan(w/2) = w/2 -
/// (4/lambda²)(w/2)³ of w = pi f/c. Other springs at either end act nearly as equal ones with the mean phase phi.
/// @param number  n >= 1
/// References: Irvine (1981), Cable Structures; Ricciardi and Saitta (2008), Engineering Structures 30, 1821-1830.
[[nodiscard]] double frequency_ratio(int number, const TensionedBeam& beam);

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

/// Posterior of a stay whose bending stiffness, sag and ends are unknown, given its harmonics. It is a sum over xi and over
/// hinged ends, clamped ends and springs between. Each part is weighted by its likelihood; c and ln(1 + lambda²) follow by
/// least squares in each part,
///
///     ln f_n = ln c + ln r_n(xi, lambda², ends) + e_n,    e_n ~ s sigma_n/f_n,
///
/// where the factor s of the stated deviations is unknown too (Student's t). Priors: hinged and clamped ends 0.45 each, springs
/// 1/10; ln xi and ln(1 + lambda²) uniform over xi 4 … 4000 and lambda² 0 … 60. Where the section is known, xi² = L²
/// (T/m)/(EI/m) within ten per cent of EI.
struct StayPosterior {
  std::vector<StayPart> parts;
  double log_evidence = 0.0;  ///< logarithm of the density of ln f_n, over all models
};

/// quick: only hinged and clamped ends.
enum class Effort { quick, full };

/// @param harmonics  one or more, numbers distinct, frequencies and deviations positive
/// @throws InputError  otherwise
[[nodiscard]] StayPosterior stay_posterior(const std::vector<Harmonic>& harmonics, const StaySection& section, Effort effort);

}  // namespace twindeck::identification
