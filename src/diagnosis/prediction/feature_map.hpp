#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/causes/candidate.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/features/form_columns.hpp"
#include "diagnosis/reduction/reduced_model.hpp"
#include "diagnosis/reduction/state_modes.hpp"

namespace twindeck::diagnosis {

/// Standard deviations of the element scatter (small errors of every model), and floors of identification errors.
struct ScatterOptions {
  double element_stiffness = 0.03, element_mass = 0.02, node_mass = 0.02, stay_stiffness = 0.03, stay_pull = 0.10, gain = 0.01,
         support_stiffness = 0.03;  ///< of each bearing or foundation, as of an element
  double frequency_floor = 0.001, damping_floor = 0.05, shape_floor = 0.01;  ///< relative; of the shape's largest value
  double load_model = 0.10;  ///< of RMS values, on ln: uncertainty of a simple load model
  double model_form =
      0.0;  ///< of a frequency, on ln, the same in all conditions of a mode; for a model that is known to be inaccurate
  bool damping_by_dampers =
      false;  ///< separate structural damping of the conditions with dampers, because stuck dampers dissipate by friction
  double fine = 1.0;   ///< common factor of the first line (estimated by marginal likelihood)
  double noise = 1.0;  ///< common factor of identification errors (likewise)
};

/// A nuisance parameter in units of its prior: mean 0, deviation 1.
struct Nuisance {
  enum class Kind { parameter, place, stay_pull, gain, mode_damping, level };
  Kind kind = Kind::parameter;
  int index = 0;     ///< position among the parameters, places of `set`, channels, damping modes or levels
  std::string name;  ///< "E_s", "element:17 stiffness", "mode 3 damping", for tables
  double mean = 0.0, deviation = 1.0;
  double lower, upper;   ///< hard bounds in prior units (parameters), ± infinity otherwise
  std::string set = {};  ///< of a location: "zones", "nodes", "stays", "supports" or "foundations" …
  bool of_mass = false;  ///< … true: factor on its mass, false: on its stiffness
};

/// A measured mode of one condition.
struct MeasuredMode {
  std::string label;
  int condition = 0;
  int frequency = -1, damping = -1;       ///< rows
  std::vector<int> real_rows, imag_rows;  ///< of the shape
  std::vector<int> real_channels, imag_channels;
  double frequency_Hz = 0.0;
};

/// Predicted values of the rows.
struct Prediction {
  bool valid = false;
  Eigen::VectorXd g;                 ///< (n_rows) transformed as `FeatureMap::values`
  Eigen::MatrixXd jacobian;          ///< (n_rows × n_nuisances), if asked for
  Eigen::MatrixXd scales;            ///< (n_rows × n_scales) directions of the free shape scales
  std::vector<double> frequency_Hz;  ///< (n_measured_modes) of the paired model modes
  std::vector<int> paired;           ///< (n_measured_modes) position of the paired model mode in its state, -1
  std::vector<double> mac;           ///< (n_measured_modes) with the paired mode, NaN without shape
  std::vector<int> open;             ///< rows of measured modes without a mode of the model; g has the measured values there
};
/// Difference of two predictions g (n_rows), 0 in rows that either leaves open, because their values are not predicted.
[[nodiscard]] Eigen::VectorXd change_between(const Prediction& from, const Prediction& to);

/// Undamped modes of the model at the channels, in each measured structure (the first condition's first), and the pairs of
/// measured modes with them.
struct FormModes {
  std::vector<ModelModes> structures;
  std::vector<PairedMode> paired;  ///< (n_measured_modes), empty if the model predicts none of these rows
};

/// g(x, a): rows of the measurement as functions of the nuisance parameters x and of causes. Frequencies, damping, RMS, floors
/// and stay frequencies are in ln. Shapes are scaled to the measured ones. Rows of load tests have their own unit.
class FeatureMap {
 public:
  FeatureMap(const ReducedModel& model, const FeatureSet& features, const ScatterOptions& scatter);

  /// Binds measured labels to modes of the unchanged model, used if there is no shape: label -> position (0-based).
  void bind_modes(const std::map<std::string, int>& positions) { bound_modes_ = positions; }

  /// Reduced structure at x: data that all predictions at one x share, with the states solved so far. Each thread needs its own
  /// base.
  struct Base {
    Eigen::VectorXd x, theta;
    using Part = std::pair<double, const ReducedMatrix*>;  ///< amount, matrix (r × r) of the reduced model
    std::vector<Part> stiffness_parts, mass_parts;
    Eigen::MatrixXd common_stiffness, common_mass;  ///< over the common columns, which all states use
    std::shared_ptr<struct StateStore> store;
    bool keeps = false;  ///< states with causes are kept too, because the same causes are predicted again
  };
  [[nodiscard]] Base base(const Eigen::VectorXd& x) const;
  /// (n_nuisances) x of the model as it stands. Parameters that were fitted to measurements differ from their prior's mean.
  [[nodiscard]] const Eigen::VectorXd& standing() const { return standing_; }

  /// Location of a nuisance parameter, and the matrix that it scales.
  [[nodiscard]] const ReducedPlace& place_of(const Nuisance& v) const;
  [[nodiscard]] const ReducedMatrix& scattered(const Nuisance& v) const;
  /// Stiffness and mass at a base in some of the reduced model's coordinates, the common ones first (n × n each). Most of the
  /// others belong to causes at other locations and are not used.
  [[nodiscard]] std::pair<Eigen::MatrixXd, Eigen::MatrixXd> matrices(const Base& base, const std::vector<int>& columns) const;
  [[nodiscard]] Prediction predict(const Base& base, const std::vector<Cause>& causes, bool with_jacobian) const;

  /// Motion of the nodes where a sensor could be, in each measured mode: "node:17 z" -> (n_measured_modes), each mode scaled to
  /// a largest motion of 1.
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> node_motion(const Base& base, const std::vector<Cause>& causes) const;

  /// Data for the errors of the model's form (model_modes.cpp).
  [[nodiscard]] FormModes form_modes(const Base& base, const std::vector<Cause>& causes) const;

  [[nodiscard]] const ReducedModel& model() const { return model_; }
  [[nodiscard]] const FeatureSet& features() const { return features_; }
  [[nodiscard]] const std::vector<Nuisance>& nuisances() const { return nuisances_; }
  [[nodiscard]] const std::vector<MeasuredMode>& measured_modes() const { return modes_; }
  [[nodiscard]] const Eigen::VectorXd& values() const { return values_; }          ///< (n_rows) y, transformed
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }  ///< (n_rows × n_rows) Sigma_id, transformed
  /// Whether the structure was the same in two conditions.
  [[nodiscard]] bool same_state(int a, int b) const;
  [[nodiscard]] int scales() const { return n_scales_; }
  /// Replaces the measured values by others (bootstrap, tests), in transformed units.
  void set_values(const Eigen::VectorXd& values);
  /// Adds a covariance to that of the identification errors, in transformed units (n_rows × n_rows).
  void add_covariance(const Eigen::MatrixXd& further);

 private:
  friend class Predictor;
  /// Key of a mode's structural damping: its label, the state of the structure, and, if it matters, the state of the dampers.
  [[nodiscard]] std::string damping_name(const std::string& label, int condition) const;
  void collect_modes();
  void list_places(const ScatterOptions& scatter);
  void list_nuisances(const ScatterOptions& scatter);
  void transform(const ScatterOptions& scatter);
  void add_static_form();  ///< adds the error of load-test rows by the form of the model

  const ReducedModel& model_;
  FeatureSet features_;
  std::vector<std::string> states_;  ///< of the structure; the others are compared with the first
  std::vector<MeasuredMode> modes_;
  std::vector<Nuisance> nuisances_;
  Eigen::VectorXd standing_;
  std::vector<std::string> damping_modes_;
  bool damping_by_dampers_ = false;
  std::map<std::string, int> bound_modes_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd covariance_;
  int n_scales_ = 0;
  double highest_Hz_ = 0.0;
};

}  // namespace twindeck::diagnosis
