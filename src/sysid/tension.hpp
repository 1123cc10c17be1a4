#pragma once

#include <vector>

namespace twindeck::sysid {

/// A stay's harmonic, measured.
struct Harmonic {
  int number = 0;  ///< n, from 1
  double frequency_Hz = 0.0;
  double deviation_Hz = 0.0;  ///< standard deviation, > 0
};

/// A quantity with the bounds of its interval at the requested level.
struct Bounded {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Force and sag of a stay.
struct StayFit {
  Bounded c_Hz;                                   ///< frequency of the taut string
  Bounded tension_per_mass;                       ///< T/m = (2 L c)² [m²/s²]
  Bounded lambda_squared;                         ///< Irvine's parameter (m g L cos/T)² E A L/(T L_e) [-]
  double bending = 0.0, bending_deviation = 0.0;  ///< b of f_n² = n² c² (1 + b n²), b = pi² EI/(T L²); 0 if not requested
  bool bending_seen = false;  ///< the data support it: b exceeds three deviations; otherwise the fit is that of the string
  double residual = 0.0;      ///< RMS of the normalised residuals of n >= 2
  int harmonics = 0;
};

/// Ratio f_1/c of the first symmetric in-plane mode to the taut string's frequency, the root w = pi f_1/c of
///
///     tan(w/2) = w/2 - (4/lambda²) (w/2)³,    pi <= w <= 3 pi.
///
/// @param lambda_squared >= 0
/// Reference: Irvine (1981), Cable Structures, eq. (3.14); Irvine and Caughey (1974), Proc. R. Soc. London A 341, 299-315.
[[nodiscard]] double first_frequency_ratio(double lambda_squared);
/// Its inverse; 0 for ratios of at most 1. @param ratio f_1/c < 3
[[nodiscard]] double lambda_squared_of(double ratio);

/// Ratio f_n/(n c) of the n-th in-plane mode for odd n, the root of the same equation for n half-waves; 1 for even n, because
/// sag does not affect these. At lambda² = 2.6 the third is raised by 0.13 %. @param number >= 1
[[nodiscard]] double frequency_ratio(int number, double lambda_squared);

/// Effects that are included.
struct StayModel {
  bool bending = true;        ///< try the bending term
  bool sag_of_higher = true;  ///< the sag's small effect on the third and further odd harmonics; false: f_n = c n for n >= 2
  bool known_length = true;   ///< false: c's deviation leaves out the excess length of the arc, which depends on L
};

/// Cable parameters from the harmonics of a stay (Irvine): c from n >= 2 by weighted least squares of f_n = c n r_n(lambda²),
/// lambda² from f_1/c, alternately until both converge. Intervals follow by first-order propagation to c and f_1/c. Their
/// bounds are then mapped to lambda², because lambda² is nonlinear and >= 0. The deviation of c includes what the parabola
/// neglects, the excess length (g L/(T/m))²/24 of the arc over the chord. With at least five harmonics above the first, the
/// bending term is tried and kept if the data support it.
/// @param harmonics  at least two, one of them with n >= 2 @param length_m  L
/// @param quantile   of the normal law: 1.96 for 95 %
/// @throws InputError  without two harmonics, with a harmonic twice, or a frequency or deviation that isn't positive
[[nodiscard]] StayFit fit_stay(const std::vector<Harmonic>& harmonics, double length_m, double quantile = 1.96,
                               StayModel model = {});

/// Numbers identified frequencies as harmonics of one stay: the spacing c for which the most frequencies lie within `tolerance`
/// c of a multiple of it (the first from its own value to 0.5 c above it, because sag only raises it). If several c are equal
/// in this, the largest.
/// @param frequencies_Hz ascending @param lowest_Hz, highest_Hz  range of c
/// @return (position in frequencies, harmonic), at most one a harmonic
[[nodiscard]] std::vector<std::pair<std::size_t, int>> number_harmonics(const std::vector<double>& frequencies_Hz,
                                                                        double lowest_Hz, double highest_Hz,
                                                                        double tolerance = 0.08);

}  // namespace twindeck::sysid
