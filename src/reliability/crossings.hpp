#pragma once

#include <Eigen/Core>

namespace twindeck::reliability {

/// Spectral moments of a stationary Gaussian response, lambda_k = integral of (2 pi f)^k G(f) df over the one-sided spectrum G.
struct SpectralMoments {
  double variance = 0.0;  ///< lambda_0 [unit²]
  double first = 0.0;     ///< lambda_1 [unit² rad/s]
  double second = 0.0;    ///< lambda_2 [unit² rad²/s²], variance of the rate
  double fourth = 0.0;    ///< lambda_4 [unit² rad⁴/s⁴]
  /// Upward crossings of the mean [1/s]: sqrt(lambda_2/lambda_0)/(2 pi).
  [[nodiscard]] double mean_rate_Hz() const;
  /// The moments of the response times a factor.
  [[nodiscard]] SpectralMoments scaled(double factor) const {
    const double square = factor * factor;
    return {square * variance, square * first, square * second, square * fourth};
  }
  /// Vanmarcke's bandwidth [-]: sqrt(1 - lambda_1²/(lambda_0 lambda_2)), 0 for a single frequency.
  [[nodiscard]] double bandwidth() const;
};
/// Trapezoidal rule. @param f_Hz (n) ascending  @param spectrum (n) one-sided [unit²/Hz]
[[nodiscard]] SpectralMoments spectral_moments(const Eigen::Ref<const Eigen::VectorXd>& f_Hz,
                                               const Eigen::Ref<const Eigen::VectorXd>& spectrum);

/// Rice's mean rate of upward crossings of a level by a Gaussian process with mean zero [1/s].
/// Reference: Rice (1945), Bell Syst. Tech. J. 24, 46-156, section 3.3.
[[nodiscard]] double crossing_rate_Hz(const SpectralMoments& moments, double level);

/// Probability that |x| exceeds the level within a duration, from the start in the stationary state.
/// `poisson` takes the crossings as independent. `vanmarcke` takes out those that come in clumps, which a narrow band makes,
/// and counts the chance to start above the level. Reference: Vanmarcke (1975), J. Appl. Mech. 42, 215-220, with the bandwidth
/// to the power 1.2.
struct FirstExcursion {
  double poisson = 0.0, vanmarcke = 0.0;
};
[[nodiscard]] FirstExcursion first_excursion(const SpectralMoments& moments, double level, double duration_s);

}  // namespace twindeck::reliability
