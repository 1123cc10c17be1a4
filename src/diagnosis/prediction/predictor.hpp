#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "diagnosis/prediction/feature_map.hpp"
#include "diagnosis/reduction/mode_derivative.hpp"

/// Private to src/diagnosis: one evaluation of g(x, a).
namespace twindeck::diagnosis {

/// A state of the structure, shared by conditions, with its modes.
struct SolvedState {
  std::vector<int> columns;  ///< of the reduced model; own degrees of freedom of causes come after them
  StructureState state;
  StateModes modes;
  std::map<Eigen::Index, ModeDerivative> derivatives;
  /// A part of the state that a cause scales or moves and that depends on a parameter.
  struct Followed {
    int parameter = 0;
    double amount = 0.0;                  ///< of the part, per unit of the parameter
    const ReducedMatrix* part = nullptr;  ///< null for a spring
    bool mass = false;
    Eigen::VectorXd spring;  ///< (n) b of the part b b', the spring of a moved support
    int nuisance = -1;       ///< the part depends on this nuisance parameter instead
  };
  std::vector<Followed> followed;
};

inline constexpr double kUsualDamping_pct = 0.5;  ///< structural damping of an unmeasured mode; steel decks have 0.3 to 0.8

/// Change of a state's matrix per unit of a nuisance parameter: dense, or `amount` times a local reduced matrix.
struct MatrixChange {
  Eigen::MatrixXd dense;
  double amount = 0.0;
  const ReducedMatrix* local = nullptr;
  [[nodiscard]] bool empty() const { return dense.size() == 0 && local == nullptr; }
};

/// Solved states of one base, by the causes that act and the circumstances. Changes by nuisance parameters are stored by
/// columns; the own degrees of freedom of causes do not change with x.
struct StateStore {
  struct Changes {
    std::vector<int> position;  ///< among the nuisances
    std::vector<MatrixChange> stiffness, mass;
  };
  std::map<std::pair<std::vector<double>, std::vector<double>>, std::shared_ptr<SolvedState>> states;
  std::map<std::pair<std::vector<int>, Eigen::Index>, Changes> changes;              ///< by columns and size
  std::map<std::vector<int>, std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> matrices;  ///< stiffness and mass by columns
  UndampedStore undamped;

  /// Stiffness and mass in the columns after the common ones (n × n_own), the same for every magnitude of a candidate.
  struct OwnColumns {
    Eigen::MatrixXd stiffness, mass;
  };
  /// Own columns for a list of columns, computed once. Safe for several threads.
  template <typename Compute>
  const OwnColumns* own_columns(const std::vector<int>& columns, Compute compute) {
    {
      const std::scoped_lock lock(own_mutex);
      if (const auto at = own.find(columns); at != own.end()) return &at->second;
    }
    OwnColumns here = compute();
    const std::scoped_lock lock(own_mutex);
    return &own.try_emplace(columns, std::move(here)).first->second;
  }
  std::mutex own_mutex;
  std::map<std::vector<int>, OwnColumns> own;
};

/// MAC of each mode (n_channels × n_modes) with one measured shape; 0 for modes at rest.
[[nodiscard]] Eigen::VectorXd likeness(const Eigen::MatrixXcd& shapes, const Eigen::VectorXcd& measured);

class Predictor {
 public:
  Predictor(const FeatureMap& map, const FeatureMap::Base& base, const std::vector<Cause>& causes, bool with_jacobian);
  [[nodiscard]] Prediction run();
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> node_motion();
  [[nodiscard]] FormModes form_modes();

 private:
  using Complex = std::complex<double>;

  // structure (structure_of_causes.cpp)
  /// What the channels read: rows of the sensors with weights, after rotations and exchanges by causes; gains and signs;
  /// delays.
  struct Reading {
    std::vector<std::vector<std::pair<Eigen::Index, double>>> views;
    Eigen::VectorXd factor, delay_s;
  };
  void read_channels();
  [[nodiscard]] Reading reading_in(const Condition& condition) const;
  [[nodiscard]] const Reading& reading(int condition) const { return *reading_of_[static_cast<std::size_t>(condition)]; }
  /// Motion at the channels, without gains, per unit of some of the reduced model's coordinates (n_channels × n_columns).
  [[nodiscard]] Eigen::MatrixXd channel_rows(const Reading& reading, const std::vector<int>& columns) const;
  [[nodiscard]] bool acts(const Cause& cause, const ActionSpec& action, const Condition& condition) const;
  /// Relative change of a location's stiffness by an action, 0 for an action of another kind.
  [[nodiscard]] double stiffness_change(const Cause& cause, const ActionSpec& action, const Condition& condition) const;
  [[nodiscard]] StructureState build_state(const Condition& condition) const;
  void apply(const Cause& cause, const ActionSpec& action, const Condition& condition, StructureState& state) const;
  /// Adds `change` times the stiffness or mass of a location, with the factors of the parameters, to the state being built.
  void add_change(const ReducedPlace& place, double change, bool mass, StructureState& state) const;
  /// Takes a support away and puts it up again at a position on its line, between nodes by interpolation.
  void move_support(const ReducedPlace& support, double position, StructureState& state) const;
  void apply_spring(const Candidate& candidate, const ActionSpec& action, double stiffness, StructureState& state) const;
  /// An oscillator or, as a string, a cable of this mass and circular frequency, with degrees of freedom of its own.
  void apply_body(const ReducedPlace& place, const ActionSpec& action, double mass_kg, double omega_rad_s,
                  StructureState& state) const;
  /// Adds a spring k b b' that depends on parameters by a ratio.
  void add_spring(const Eigen::VectorXd& b, double k, const fe::Coefficient& ratio, StructureState& state) const;
  struct DamperInUse;
  [[nodiscard]] DamperInUse damper_in(const Condition& condition, const ReducedPlace& damper) const;
  void apply_dampers(const Condition& condition, StructureState& state) const;

  // states, each solved once (solved_states.cpp)
  struct Acting;
  [[nodiscard]] Acting acting_in(const Condition& condition) const;
  /// Values of a condition that its state depends on; part of the state's key.
  [[nodiscard]] std::vector<double> circumstances(const Condition& condition, const Acting& acting) const;
  [[nodiscard]] SolvedState& solved(int condition);
  /// Builds the matrices of a state in those of the columns that are independent in it.
  void build(SolvedState& entry, const Condition& condition, const std::vector<int>& columns) const;
  [[nodiscard]] static Eigen::MatrixXd sliced(const ReducedMatrix& full, const std::vector<int>& columns, Eigen::Index size);
  [[nodiscard]] static Eigen::VectorXd sliced(const ReducedDirections& full, Eigen::Index d, const std::vector<int>& columns,
                                              Eigen::Index size);
  [[nodiscard]] const StateStore::Changes& changes(const SolvedState& state) const;
  /// Stiffness and mass without causes, in some of the reduced model's coordinates.
  [[nodiscard]] const std::pair<Eigen::MatrixXd, Eigen::MatrixXd>& matrices(const std::vector<int>& columns) const;
  [[nodiscard]] const ModeDerivative& derivative(SolvedState& solved, Eigen::Index mode);
  /// Computes missing derivatives of some modes together, so that each changed matrix is read once.
  void differentiate_modes(SolvedState& solved, std::vector<Eigen::Index> modes) const;
  /// Computes the derivatives of all modes paired with measured ones.
  void differentiate_paired();
  /// Motion of all degrees of freedom by the columns of some x that are not zero, for matrices of few of them.
  struct Moved {
    Eigen::MatrixXd own, motion;  ///< vectors behind the common ones (n × n_own), motion (n × n_columns)
  };
  /// Changes of a state's stiffness or mass times each column of x, including parts that causes share with a parameter (size ×
  /// n_columns n_changes).
  /// @param moved  of the same x; filled where it is empty
  [[nodiscard]] Eigen::MatrixXd changed(const SolvedState& state, bool mass, const Eigen::MatrixXd& x, Moved& moved) const;
  /// Changes of a matrix times each column of x (size × n_columns): (size × n_columns n_changes), column by column of x.
  [[nodiscard]] Eigen::MatrixXd times(const std::vector<int>& columns, const std::vector<MatrixChange>& changes,
                                      const Eigen::MatrixXd& x, Moved& moved) const;

  // which mode is which (pairing.cpp)
  /// Pairs the measured modes of conditions in one state with modes of the model: one-to-one, at the least cost of frequencies,
  /// shapes and, with dampers, damping.
  void pair(const std::vector<int>& conditions);
  /// The measured mode whose shape is used: itself, or one of the same label.
  [[nodiscard]] const MeasuredMode& shaped_like(const MeasuredMode& measured) const;
  /// 1 - MAC of each mode of a state with a measured shape (n_modes).
  [[nodiscard]] Eigen::VectorXd unlike_measured(const MeasuredMode& shaped, const SolvedState& state);
  /// Whether a measured mode may have no mode of the model. This needs a shape. Held-out modes are always compared with the
  /// model.
  [[nodiscard]] bool may_be_none(const MeasuredMode& measured) const;
  /// Steps of frequency and damping between a measured mode and each mode of a state (n_modes).
  [[nodiscard]] Eigen::VectorXd far_from_measured(const MeasuredMode& measured, const SolvedState& state, double width) const;
  /// 1 - MAC with a mode of the unchanged structure, over the whole shape (n_modes).
  [[nodiscard]] Eigen::VectorXd unlike_bound(int position, const SolvedState& state) const;

  // modes
  void predict_mode(const MeasuredMode& measured, std::size_t position);
  /// Changes of a mode by causes that are not in the state's matrices.
  struct AddedToMode {
    double frequency = 0.0, damping_pct = 0.0;  ///< change of ln f; change of the damping ratio
  };
  [[nodiscard]] AddedToMode added_to(const MeasuredMode& measured, const SolvedState& state, Eigen::Index mode) const;
  /// Change of -100 Re s / |s| with s.
  [[nodiscard]] static double damping_slope_pct(Complex s, Complex ds);
  /// Whether a nuisance is the structural damping of this name.
  [[nodiscard]] bool is_damping_of(const Nuisance& v, const std::string& damping_name) const;
  void differentiate_mode(const MeasuredMode& measured, SolvedState& state, Eigen::Index mode, const std::string& damping_name,
                          double own_pct, double total_pct);
  /// The model mode for the shape of a measured one: its pair, or another mode's if shapes were exchanged.
  [[nodiscard]] int mode_of_shape(const MeasuredMode& measured, std::size_t position) const;
  struct ScaledShape;
  [[nodiscard]] ScaledShape scaled_shape(const MeasuredMode& measured, const SolvedState& state, Eigen::Index mode);
  /// Leaves the rows of a shape open that has no mode of the model.
  void leave_shape_open(const MeasuredMode& measured);
  void predict_shape(const MeasuredMode& measured, SolvedState& state, Eigen::Index mode);
  void differentiate_shape(const MeasuredMode& measured, SolvedState& state, Eigen::Index mode, const ScaledShape& shape);

  // records (record_rows.cpp) and cables
  void predict_load(int condition);
  void predict_floor(std::size_t row);
  /// Variance of a mode's motion under the excitation, up to a common factor.
  struct ExcitedMode {
    double weight = 1.0;
    Eigen::VectorXd slope;  ///< (n_nuisances) of ln weight; empty without a Jacobian
  };
  [[nodiscard]] ExcitedMode excited_mode(int condition, SolvedState& state, Eigen::Index mode);
  void predict_rms(std::size_t row, SolvedState& state, const std::vector<ExcitedMode>& excited);
  [[nodiscard]] Eigen::Index level_of(int condition, bool floor) const;  ///< among the nuisance parameters, -1 without one
  void predict_stays();

  // load tests (load_test_rows.cpp)
  struct SolvedLoadTest;
  void predict_load_tests(int condition);
  /// State of the ground in a condition, with the dependence of its springs on parameters. @return false if a gauged support
  /// was moved
  [[nodiscard]] bool ground_of(const Condition& condition, int c, std::vector<GroundState>& ground) const;
  /// Right-hand sides of K dq = df - dK q (size × unknowns); df includes supports scaled by a parameter. Fills `relative` of
  /// the test.
  [[nodiscard]] Eigen::MatrixXd load_slopes(SolvedLoadTest& test);
  void predict_static_row(const SolvedLoadTest& test, std::size_t row);

  /// Motion of each mode of a state at the channels (n_channels × n_modes), including gains, signs and delays of causes.
  [[nodiscard]] const Eigen::MatrixXcd& motion(const SolvedState& state, const Reading& reading);
  /// Calls fn(candidate, coordinates, action) for all causes with an action of this primitive in the state of a condition.
  template <typename Use>
  void each_action(Primitive primitive, const Condition& condition, Use use) const {
    for (const Cause& cause : causes_) {
      if (!cause.candidate->acts_in(condition)) continue;
      for (const ActionSpec& action : cause.candidate->hypothesis->actions)
        if (action.primitive == primitive) use(*cause.candidate, cause.a, action);
    }
  }
  /// Contribution of a mode to a record's variance under wind, relative to white excitation (wind_load.cpp).
  struct WindNumbers;
  [[nodiscard]] WindNumbers wind_numbers(const Condition& condition, const std::string& label) const;
  struct MotionInWind;
  [[nodiscard]] MotionInWind motion_in_wind(const Eigen::Vector2d& along, double lee, SolvedState& state, Eigen::Index mode);
  [[nodiscard]] ExcitedMode wind_load(const Condition& condition, SolvedState& state, Eigen::Index mode,
                                      const std::string& label);
  [[nodiscard]] double structural_damping(const std::string& label) const;  ///< in per cent

  const FeatureMap& map_;
  const FeatureMap::Base& base_;
  const std::vector<Cause>& causes_;
  bool with_jacobian_;
  mutable std::vector<int> columns_;                        // of the state being built
  mutable std::vector<SolvedState::Followed> followed_;     // likewise
  std::vector<std::shared_ptr<const Reading>> reading_of_;  // of each condition
  std::map<std::pair<const SolvedState*, const Reading*>, Eigen::MatrixXcd> motion_;
  std::map<std::pair<std::vector<double>, std::vector<double>>, std::shared_ptr<SolvedState>> own_;
  mutable std::map<std::vector<int>, std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> matrices_;
  UndampedStore undamped_;
  std::map<int, SolvedState*> of_condition_;
  Prediction out_;
  Eigen::Index scale_ = 0;
};

}  // namespace twindeck::diagnosis
