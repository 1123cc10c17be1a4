#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/loaded_model.hpp"
#include "dynamics/measured_slips.hpp"
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

/// Runs all checks, and that of the mesh (doubtful_mesh.hpp), and warns. If the model itself shows an error, the comparison
/// with the measurement is left out, because it would show the same error.
/// @param measured  one for each condition; empty without a measurement
/// @return whether the model itself shows one
bool warn_of_unit_slips(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                        const std::vector<MeasuredFrequencies>& measured);

/// Both: what a step does that goes on to change or to name something.
void judge_units(Reporter& reporter, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                 const std::vector<MeasuredFrequencies>& measured,
                 FactorWithinBounds within_bounds = FactorWithinBounds::passes);

}  // namespace twindeck::dynamics
