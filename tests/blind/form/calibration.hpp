#pragma once

#include "blind/form/truth.hpp"
#include "fe/parametric_system.hpp"

/// How far a coarse model stays from a truth of another class after a fit, and the severity that leaves it as far as was drawn.
namespace twindeck::blind::form {

/// A fit of the model's parameters to frequencies and shapes without errors: Gauss-Newton inside the bounds, with a weak pull
/// to the initial values.
struct SimpleFit {
  Eigen::VectorXd theta;   ///< (n_parameters)
  double rms = 0.0;        ///< of ln f_model / f_truth that is left
  double shape_rms = 0.0;  ///< of shapes at the channels whose largest value is 1
  double least_mac = 1.0;  ///< of a pair, at the channels
};
/// @param system  of coarse_model(truth.layout) @param seen  modes to fit to
[[nodiscard]] SimpleFit simple_fit(const fe::ParametricSystem& system, const Layout& layout, const SeenModes& seen);

struct Calibrated {
  Form form;                            ///< with its severity
  double reached = 0.0;                 ///< RMS frequency error after the fit
  double shape = 0.0, least_mac = 0.0;  ///< of the same fit
  int draws = 0;                        ///< forms that were drawn until one reached the level
};

/// Draws forms until one leaves `level` within a tenth, by bisection on its severity, with a counterpart in the model for each
/// mode; the nearest of twelve if none does.
[[nodiscard]] Calibrated calibrate(const fe::ParametricSystem& system, const Truth& without_form, double level, Stream& random);

/// The part of the form error that one feature alone leaves after a fit, at the form's severity.
[[nodiscard]] double rms_of_feature_alone(const fe::ParametricSystem& system, Truth truth, int feature);

}  // namespace twindeck::blind::form
