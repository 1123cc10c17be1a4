#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "ponte/generator.hpp"

/// Calibration of the bridge's unknown sizes to printed frequencies, within ranges of engineering sense.
namespace twindeck::steps {

/// A size that is fitted: it scales one or several values of bridge.toml.
struct CalibrationValue {
  std::string name, unit, reason;
  std::vector<std::string> paths;  ///< see ponte::Values
  std::vector<double> factors;     ///< one a path
  double start = 0.0, lower = 0.0, upper = 0.0;
  bool linear = false;  ///< its range is travelled evenly; otherwise in its logarithm
  /// The value at a part of its range, 0 = lower, 1 = upper, and back.
  [[nodiscard]] double at(double part) const;
  [[nodiscard]] double part_of(double value) const;
};

/// Printed frequencies of a variant, by position among its modes.
struct CalibrationTarget {
  std::string variant, source;
  std::vector<int> modes;  ///< from 1
  std::vector<double> frequency_Hz;
};

struct Calibration {
  std::vector<CalibrationTarget> targets;
  std::vector<CalibrationValue> values;
  double whole_range_costs = 0.0;  ///< weight of (part - part at the start) beside relative frequency errors
  int max_iterations = 40;
};

/// @throws InputError naming file and line
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& file);

/// The values of bridge.toml at given parts of the ranges; a path that several values name gets their product.
[[nodiscard]] ponte::Values bridge_values(const Calibration& calibration, const Eigen::VectorXd& part);

struct CalibrationResult {
  Eigen::VectorXd part;             ///< (n_values) where each value ended in its range
  Eigen::VectorXd untuned, fitted;  ///< (all targets) frequencies [Hz] at the start and at the end
  double cost = 0.0, projected_gradient = 0.0;
  int iterations = 0;
  Status status;
};

/// Bounded least squares on relative frequency errors of all targets together, with a weak pull to the start that settles what
/// frequencies cannot tell: Levenberg and Marquardt's steps as the bounds allow (updating/bounded_quadratic.hpp).
/// Derivatives are those of the eigenvalues, phi' (dK - lambda dM) phi with pulls frozen, for whatever the generator makes of a
/// value, geometry too: dK and dM are differences of assembled matrices (forward, 1e-5 of the range), not of eigenvalues.
/// The search runs on a quick mesh whose frequencies are multiplied by what the full mesh makes of them at the last point,
/// until both agree within 0.02 %.
/// @param mesh, search_mesh  names of the generator's meshes; "": its own
/// @param first  (n_values) parts of the ranges to begin with; the pull is to `start` in any case
/// @param report  called with a line after each iteration
[[nodiscard]] CalibrationResult calibrate(const Calibration& calibration, const std::filesystem::path& bridge_toml,
                                          const std::string& mesh, const std::string& search_mesh, const Eigen::VectorXd& first,
                                          const std::function<void(const std::string&)>& report);

}  // namespace twindeck::steps
