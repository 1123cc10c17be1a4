#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/loaded_model.hpp"

/// Detects likely unit errors by measured against computed frequencies: one factor of a known slip between all of them.
namespace twindeck::dynamics {

inline constexpr double gravity_m_s2 = 9.80665;
inline constexpr double gravity_in_s2 = 386.0886;  ///< [in/s2]
inline constexpr double gravity_ft_s2 = 32.17405;  ///< [ft/s2]

/// Position of the first frequency that is no rigid body's, or the size.
[[nodiscard]] Eigen::Index first_elastic(const Eigen::VectorXd& ascending_Hz);

/// Measured modes of one condition.
struct MeasuredFrequencies {
  std::vector<std::string> names;
  Eigen::VectorXd frequency_Hz;
  /// [-] (n_computed × n_measured) MAC at the sensors, or 1 for a pair that the user gives and 0 elsewhere; NaN of a mode whose
  /// shape is not known; empty if none is.
  Eigen::MatrixXd mac = {};
};

/// The slips of units or masses that would multiply all computed frequencies by about this factor (within 15 %: a slip sits on
/// top of a model's own error), the nearest first, as a question; empty if none is known. sqrt(9.81) is a weight given as a
/// mass.
[[nodiscard]] std::optional<std::string> slip_of_factor(double computed_over_measured);

/// Measured over computed frequency, if all pairs of measured and computed modes differ by one factor of a known slip. Pairs
/// are by shape if at least two modes, and half of the measured ones, have the shapes of computed modes; else by the order of
/// frequencies, of which at least three are needed: two ratios agree by chance. Empty if other pairs of computed modes, in the
/// order of both and of the same shapes, explain the frequencies without a factor: a model has modes that no sensor sees. By
/// frequencies alone it is empty too if the computed modes end far below the measured ones.
/// @param doubted      the model's own numbers show a slip of units: the factor then needs no other sign
/// @param computed_Hz  ascending, rigid-body modes included
[[nodiscard]] std::optional<double> one_factor(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz,
                                               bool doubted = false);

/// Measured frequencies among themselves (one that stands a factor of 50 and more off the rest), and against the computed ones
/// in these pairs (a factor that is 2 pi, 60, sqrt(9.81) or a thousand rather than a model's error).
/// @param computed_Hz  ascending; empty to leave the comparison out
[[nodiscard]] std::vector<std::string> measured_slips(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz);

/// The highest measured frequency that is none of such a slip; 0 without any.
[[nodiscard]] double highest_of_band(Eigen::VectorXd measured_Hz);

/// Whether a parameter whose bounds reach the factor of a known slip may explain it: an update may be meant to find it, but a
/// diagnosis would name a material for a unit.
enum class FactorWithinBounds { passes, is_refused };

/// Refuses a measurement that one factor of a known slip explains, before anything is updated or named.
/// @param doubted  as of one_factor
/// @throws InputError  that names the condition's frequencies, the factor and the likely slip
void refuse_one_factor(const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                       const std::vector<MeasuredFrequencies>& measured, FactorWithinBounds within_bounds,
                       bool doubted = false);

}  // namespace twindeck::dynamics
