#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>

#include "wind/component.hpp"
#include "wind/spectrum.hpp"

namespace twindeck::wind {

/// A measured coherence of one component, the root of the squared one with its sign, over the reduced separation
/// x = f sqrt(sum_a (C_a d_a)²) / V. With decays C_a of 1, x is f d / V. The exponential law is exp(-x). Values between two
/// points are linear in x, and beyond the last point they are 0.
class CoherenceTable {
 public:
  /// @param x  (k) ascending from 0  @param gamma  (k) from 1 at x = 0, within [-1, 1]; at least two points
  CoherenceTable(Eigen::VectorXd x, Eigen::VectorXd gamma);
  [[nodiscard]] double at(double x) const;

 private:
  Eigen::VectorXd x_, gamma_;
};

/// Turbulence over one kind of terrain according to a code; a row of data/wind/turbulence_sets.csv.
///
/// Intensity and length scale of the along-wind component (EN 1991-1-4, 4.4 and annex B.1; CNR-DT 207/2008, 3.2.5, 3.2.6):
///
///     I(z) = 1 / ln(z / z0),   L(z) = 300 m (z / 200 m)^kappa,   kappa = 0.67 + 0.05 ln z0,   z = max(z, z_min).
///
/// The other components follow by ratios (Solari and Piccardo, 2001, Prob. Eng. Mech. 16, 73-86). All length scales run along
/// the wind.
struct TurbulenceSet {
  std::string name;               ///< "CNR-DT 207 I"
  double roughness_m = 0.0;       ///< z0
  double minimum_height_m = 0.0;  ///< z_min: the profile is constant below
  double kappa = 0.0;             ///< exponent of the length scale
  PerComponent sigma_ratio{};     ///< standard deviation over that of the along-wind component
  PerComponent scale_ratio{};     ///< length scale over that of the along-wind component
  /// Decay C of Eq. (17) of each component with separations along, across and vertical.
  std::array<PerComponent, 3> decay{};
  std::array<Spectrum, 3> spectrum{};                                ///< of each component
  std::array<std::shared_ptr<const CoherenceTable>, 3> coherence{};  ///< of each component; none: exp(-x)
};

/// Standard deviation of a component [m/s] at height z in a mean wind of V(z).
[[nodiscard]] double standard_deviation(const TurbulenceSet& set, Component component, double z_m, double mean_speed_m_s);
/// Along-wind length scale of a component [m].
[[nodiscard]] double length_scale(const TurbulenceSet& set, Component component, double z_m);

}  // namespace twindeck::wind
