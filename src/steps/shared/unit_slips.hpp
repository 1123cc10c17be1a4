#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "steps/shared/measured.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/shared/run_step.hpp"

/// Units that a program cannot refuse but an engineer would: a modulus in MPa, coordinates in millimetres, a frequency in
/// millihertz among hertz. Each is a number that is possible and a structure that is not; the functions name the likely slip by
/// the model's own figures, one line each, and the steps warn with them.
namespace twindeck::steps {

/// By the speed of waves sqrt(E / rho) of each material that elements use, the span, the slenderness of members and the size of
/// sections.
[[nodiscard]] std::vector<std::string> unit_slips(const fe::Model& model);

/// By the lowest computed frequency that belongs to no rigid body: slower or faster than any structure.
/// @param computed_Hz  ascending
/// @param mass_kg      that moves in translation
/// @param span_m       0 where it is not known
[[nodiscard]] std::vector<std::string> frequency_slips(const Eigen::VectorXd& computed_Hz, double mass_kg, double span_m);

/// What was measured at a time: modes of one condition.
struct MeasuredFrequencies {
  std::vector<std::string> names;
  Eigen::VectorXd frequency_Hz;
};
/// Measured frequencies among themselves (one that stands a factor of 50 and more off the rest), and against the computed ones
/// in their order (a factor that is 2 pi, 60 or a thousand rather than a model's error).
/// @param computed_Hz  ascending; empty to leave the comparison out
[[nodiscard]] std::vector<std::string> measured_slips(const MeasuredFrequencies& measured, const Eigen::VectorXd& computed_Hz);

/// What a step that compares with one condition has.
[[nodiscard]] std::vector<MeasuredFrequencies> frequencies_of(const std::optional<Measured>& measured);

/// Warns of all of them. Where the model itself shows a slip, the comparison with the measurement is left out: it would say the
/// same again.
/// @param measured  one for each condition; empty where nothing is measured
void warn_of_unit_slips(StepContext& context, const LoadedModel& loaded, const Eigen::VectorXd& computed_Hz,
                        const std::vector<MeasuredFrequencies>& measured);

}  // namespace twindeck::steps
