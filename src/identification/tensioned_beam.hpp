#pragma once

namespace twindeck::identification {

/// A stay or hanger as a beam under tension that sags, with equal rotational springs at both ends.
struct TensionedBeam {
  double xi = 1e4;              ///< L sqrt(T/EI): 6 for a short hanger, above 1000 for a string
  double lambda_squared = 0.0;  ///< Irvine's parameter (m g L cos/T)² E A L/(T L_e) [-], >= 0
  /// Fixity s of the ends: 0 hinged, 1 clamped. Between them the rotational stiffness is s/(1 - s) sqrt(T EI), in units of what
  /// a long tensioned beam resists the rotation of its end with.
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

}  // namespace twindeck::identification
