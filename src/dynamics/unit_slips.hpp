#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"

/// Detects likely unit errors: a modulus in MPa, coordinates in millimetres, a frequency in millihertz among hertz. Such
/// numbers are possible, but the structure is not plausible. Each function returns one line per likely error, with the model's
/// own figures; warn_of_unit_slips passes them to the reporter as warnings.
namespace twindeck::dynamics {

/// By the speed of waves sqrt(E / rho) of each material that elements use, the span, the slenderness of members and the size of
/// sections.
[[nodiscard]] std::vector<std::string> unit_slips(const fe::Model& model);

/// By the lowest computed frequency that is not a rigid-body mode: lower or higher than that of any structure.
/// @param computed_Hz  ascending
/// @param mass_kg      that moves in translation
/// @param span_m       0 if unknown
[[nodiscard]] std::vector<std::string> frequency_slips(const Eigen::VectorXd& computed_Hz, double mass_kg, double span_m);

/// Measured modes of one condition.
struct MeasuredFrequencies {
  std::vector<std::string> names;
  Eigen::VectorXd frequency_Hz;
};

/// The slip of units or masses that would multiply all computed frequencies by about this factor (within 15 %: a slip sits on
/// top of a model's own error), as a question; empty if none is known. sqrt(9.81) is a weight given as a mass.
[[nodiscard]] std::optional<std::string> slip_of_factor(double computed_over_measured);

/// Measured over computed frequency, if all frequencies of a measurement differ from the computed ones, in the order of both,
/// by one factor of a known slip. At least three are needed: two ratios agree by chance.
/// @param computed_Hz  ascending, rigid-body modes included
[[nodiscard]] std::optional<double> one_factor(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz);

/// Measured frequencies among themselves (one that stands a factor of 50 and more off the rest), and against the computed ones
/// in their order (a factor that is 2 pi, 60, sqrt(9.81) or a thousand rather than a model's error).
/// @param computed_Hz  ascending; empty to leave the comparison out
[[nodiscard]] std::vector<std::string> measured_slips(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz);

/// The highest measured frequency that is none of such a slip; 0 without any.
[[nodiscard]] double highest_of_band(Eigen::VectorXd measured_Hz);

/// Runs all checks, and that of the mesh (doubtful_mesh.hpp), and warns. If the model itself shows an error, the comparison
/// with the measurement is left out, because it would show the same error.
/// @param measured  one for each condition; empty without a measurement
void warn_of_unit_slips(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                        const std::vector<MeasuredFrequencies>& measured);

/// Whether a parameter whose bounds reach the factor of a known slip may explain it: an update may be meant to find it, but a
/// diagnosis would name a material for a unit.
enum class FactorWithinBounds { passes, is_refused };

/// Refuses a measurement that one factor of a known slip explains, before anything is updated or named.
/// @throws InputError  that names the condition's frequencies, the factor and the likely slip
void refuse_one_factor(const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                       const std::vector<MeasuredFrequencies>& measured, FactorWithinBounds within_bounds);

/// Both: what a step does that goes on to change or to name something.
void judge_units(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                 const std::vector<MeasuredFrequencies>& measured,
                 FactorWithinBounds within_bounds = FactorWithinBounds::passes);

}  // namespace twindeck::dynamics
