#pragma once

#include <Eigen/Core>
#include <memory>

#include "wind/component.hpp"

/// Spectra of the turbulence, one-sided per Hz, over n = f L / V with L the component's length scale along the wind.
namespace twindeck::wind {

/// von Karman spectrum:
///
///     along            f S / sigma² = 4 n / (1 + 70.8 n²)^(5/6)                          paper Eq. (16)
///     across, vertical f S / sigma² = 4 n (1 + 755.2 n²) / (1 + 283.2 n²)^(11/6)
///
/// The paper prints only the first and uses it "both for the horizontal and the vertical component"; isotropic turbulence
/// requires the second. Both integrate to sigma² (to the four digits of their constants).
/// @param f_Hz  >= 0  @param sigma  [m/s]  @param length_m  L  @param speed_m_s  V
/// @return  S [(m/s)²/Hz]
/// Reference: Teunissen (1980), Boundary-Layer Meteorol. 19, 187-221.
[[nodiscard]] double von_karman_spectrum(Component component, double f_Hz, double sigma, double length_m, double speed_m_s);

/// A measured spectrum of one component, f S / sigma² at points of n. Between two points ln S is linear in ln n. S is constant
/// below the first point and falls with n^(-5/3) above the last.
class SpectrumTable {
 public:
  /// @param n  (k) ascending, > 0  @param f_s_over_variance  (k) f S / sigma², > 0; at least two points
  SpectrumTable(const Eigen::Ref<const Eigen::VectorXd>& n, const Eigen::Ref<const Eigen::VectorXd>& f_s_over_variance);
  /// S V / (sigma² L).
  [[nodiscard]] double density(double n) const;
  /// Integral of the density over all n: 1 for a table that belongs to its sigma.
  [[nodiscard]] double variance() const;

 private:
  Eigen::VectorXd log_n_, log_density_;
};

enum class SpectrumLaw {
  von_karman,
  kaimal,       ///< f S / sigma² = 4 n / (1 + 6 n)^(5/3): Kaimal et al. (1972) as IEC 61400-1, annex B, has it
  en_1991_1_4,  ///< f S / sigma² = 6.8 n / (1 + 10.2 n)^(5/3): EN 1991-1-4 (B.2), which gives the along-wind component alone
  table
};

/// The spectrum of one component; Kaimal's and the code's have one form for all components, each with its own L.
struct Spectrum {
  SpectrumLaw law = SpectrumLaw::von_karman;
  std::shared_ptr<const SpectrumTable> table;  ///< of the law `table`
  /// @return  S [(m/s)²/Hz], parameters as those of von_karman_spectrum
  [[nodiscard]] double at(Component component, double f_Hz, double sigma, double length_m, double speed_m_s) const;
};

}  // namespace twindeck::wind
