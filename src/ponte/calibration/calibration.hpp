#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "ponte/generator.hpp"
#include "updating/structure_fit.hpp"

/// Calibration of the bridge's unknown sizes to printed frequencies, known cable forces and masses per metre, within ranges of
/// engineering sense. What is computed stands in updating/structure_fit.hpp.
namespace twindeck::ponte {

/// A size that is fitted: it scales one or several values of bridge.toml.
struct CalibrationValue {
  std::string name, unit, reason;
  std::vector<std::string> paths;  ///< see Values
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

/// Cable forces of a variant from one source.
struct CalibrationForces {
  std::string variant, source, reason;
  std::vector<std::string> stays;
  std::vector<double> force_N;
  double relative_std = 0.0;  ///< [-]
};

/// Mass per metre of a part of a variant, and the range that it should lie in.
struct CalibrationMass {
  std::string variant, reason;
  updating::KnownMass known;
  double lower_kg_m = 0.0, upper_kg_m = 0.0;
};

/// Largest vertical displacement of the stays' anchors under dead load.
struct CalibrationLimit {
  std::string variant, reason;
  updating::DisplacementLimit limit;
};

/// A shape of the trusses: values of bridge.toml that stay as given. A fitted value all of whose paths it gives is not fitted.
struct CalibrationForm {
  std::string name, meaning;
  Values set;
};

/// A fit for the table of the trade between frequencies, forces and masses.
struct CalibrationTrial {
  std::string name, form;
  std::array<double, updating::n_data_kinds> weight{};  ///< 1: fitted, 0: shown, by updating::DataKind
  double whole_range_costs = 0.0;
};

struct Calibration {
  std::vector<CalibrationTarget> targets;
  std::vector<CalibrationForces> forces;
  std::vector<CalibrationMass> masses;
  std::vector<CalibrationLimit> limits;
  std::vector<CalibrationValue> values;
  std::vector<CalibrationForm> forms;
  std::vector<CalibrationTrial> trials;
  double frequency_std = 0.01;                                               ///< relative
  double whole_range_costs = 0.0;                                            ///< see updating::FitObjective
  std::array<double, updating::n_data_kinds> weight = {1.0, 0.0, 0.0, 0.0};  ///< of the kinds; frequencies alone
  Values set;                                                                ///< of the form
  int max_iterations = 40;
};

/// The calibration with a trial's form, kinds of data and pull.
/// @throws InputError for a trial that is not there
[[nodiscard]] Calibration for_trial(Calibration calibration, const std::string& trial);

/// The values of bridge.toml at given parts of the ranges, with the form's; a path that several values name gets their product.
[[nodiscard]] Values bridge_values(const Calibration& calibration, const Eigen::VectorXd& part);

/// The starts of all values as parts of their ranges. (n_values)
[[nodiscard]] Eigen::VectorXd starts(const Calibration& calibration);

struct CalibrationResult {
  Eigen::VectorXd part;             ///< (n_values) where each value ended in its range
  Eigen::VectorXd untuned, fitted;  ///< (all targets) frequencies [Hz] at the start and at the end
  std::vector<updating::StructureAnswer> untuned_answers, answers;  ///< of the targets' variants
  std::array<double, updating::n_data_kinds + 1> costs{};           ///< at the end, by kind; last: the pull to the start
  double cost = 0.0, projected_gradient = 0.0;
  int iterations = 0;
  Status status;
};

/// Bounded least squares on all targets together, with a weak pull to the start that settles what the data cannot tell.
/// The search runs on a quick mesh whose frequencies are multiplied by what the full mesh makes of them at the last point,
/// until both agree within 0.02 %.
/// @param mesh, search_mesh  names of the generator's meshes; "": its own
/// @param first  (n_values) parts of the ranges to begin with; the pull is to `start` in any case
/// @param report  called with a line after each iteration
[[nodiscard]] CalibrationResult calibrate(const Calibration& calibration, const std::filesystem::path& bridge_toml,
                                          const std::string& mesh, const std::string& search_mesh, const Eigen::VectorXd& first,
                                          const std::function<void(const std::string&)>& report);

}  // namespace twindeck::ponte
