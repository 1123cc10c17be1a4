#pragma once

#include <Eigen/Core>
#include <string>

#include "diagnosis/inference.hpp"
#include "diagnosis/structure.hpp"

namespace twindeck::diagnosis {

/// Undamped frequencies of one structure by the reduced basis and by the full matrices.
struct FullCheck {
  Eigen::VectorXd reduced_Hz, full_Hz;  ///< (n_modes) ascending
  double largest_pct = 0.0;             ///< |reduced / full - 1|
  std::string message;                  ///< why the full problem has no solution, "" where it has one
};

/// The winner once more with every degree of freedom: parameters and workmanship of `fit`, its causes that act on stiffness and
/// mass in every condition; dampers, temperature and people left out on both sides. The reduced side uses the vectors that a
/// prediction of this fit uses. Rayleigh-Ritz values lie above the full ones, so what is seen is the basis' error alone.
/// @param modes  so many of the lowest
/// An extended model that cannot be solved is said in `message`: it costs the check, not the results.
[[nodiscard]] FullCheck check_against_full(const Structure& structure, const Places& places, const FeatureMap& map, const Fit& fit,
                                           int modes);

}  // namespace twindeck::diagnosis
