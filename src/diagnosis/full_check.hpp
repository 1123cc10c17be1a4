#pragma once

#include <Eigen/Core>
#include <string>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// Undamped frequencies of one structure by the reduced basis and by the full matrices.
struct FullCheck {
  Eigen::VectorXd reduced_Hz, full_Hz;  ///< (n_modes) ascending
  double largest_pct = 0.0;             ///< |reduced / full - 1|
  std::string message;                  ///< why the full problem has no solution; "" if it has one
};

/// Computes the leading fit with all degrees of freedom: parameters and element scatter of `fit`, and its causes that act on
/// stiffness and mass in every condition. Dampers, temperature and people are left out on both sides. The reduced side uses the
/// vectors of a prediction of this fit. Rayleigh-Ritz values lie above the full ones; the difference is the error of the basis.
/// @param modes  number of lowest modes
/// If the extended model cannot be solved, `message` says so. The check is then missing; the results are valid.
[[nodiscard]] FullCheck check_against_full(const Structure& structure, const Places& places, const FeatureMap& map,
                                           const Fit& fit, int modes);

/// The winner in the reduced basis against the full model, as the structure is in a state: in the modes that those measured in
/// that state are paired with, or in the lowest one where none is. Causes that act only in other states are left out.
[[nodiscard]] FullCheck check_paired_modes(const Structure& structure, const Places& places, const FeatureMap& map,
                                           const Diagnosis& result, const std::string& state);

/// Largest allowed error of frequencies by the basis [%]: small beside the errors of measurement and model.
[[nodiscard]] double allowed_basis_error_pct(const Diagnosis& result);

}  // namespace twindeck::diagnosis
