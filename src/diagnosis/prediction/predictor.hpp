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

/// A state of the structure that several conditions may share, with its modes.
struct SolvedState {
  std::vector<int> columns;  ///< of the reduced model; own degrees of freedom of causes lie behind them
  StructureState state;
  StateModes modes;
  std::map<Eigen::Index, ModeDerivative> derivatives;
  /// A part of the state that a cause scales or moves and that goes with a parameter.
  struct Followed {
    int parameter = 0;
    double amount = 0.0;                  ///< of the part, per unit of the parameter
    const ReducedMatrix* part = nullptr;  ///< null where it is a spring
    bool mass = false;
    Eigen::VectorXd spring;  ///< (n) b of the part b b', a spring of a support that was moved
    int nuisance = -1;       ///< the part goes with this unknown, not with a parameter
  };
  std::vector<Followed> followed;
};

inline constexpr double kUsualDamping_pct = 0.5;  ///< structural, of a mode that was not measured: steel decks have 0.3 to 0.8

/// What an unknown does to a matrix of a state, per unit: dense in its coordinates, or `amount` times a projected one of few
/// degrees of freedom.
struct MatrixChange {
  Eigen::MatrixXd dense;
  double amount = 0.0;
  const ReducedMatrix* local = nullptr;
  [[nodiscard]] bool empty() const { return dense.size() == 0 && local == nullptr; }
};

/// States of one base by the causes that act in them and the circumstances that they depend on; changes of the nuisances by
/// columns. Own degrees of freedom of causes lie behind the columns; nothing in x changes them.
struct StateStore {
  struct Changes {
    std::vector<int> position;  ///< among the nuisances
    std::vector<MatrixChange> stiffness, mass;
  };
  std::map<std::pair<std::vector<double>, std::vector<double>>, std::shared_ptr<SolvedState>> states;
  std::map<std::pair<std::vector<int>, Eigen::Index>, Changes> changes;              ///< by columns and size
  std::map<std::vector<int>, std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> matrices;  ///< stiffness and mass by columns
  UndampedStore undamped;

  /// Stiffness and mass in the columns behind the common ones (n × n_own): every magnitude of a candidate needs the same.
  struct OwnColumns {
    Eigen::MatrixXd stiffness, mass;
  };
  /// Those of a list of columns, computed once. Safe for several threads.
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

/// Modal assurance criterion of each mode (n_channels × n_modes) with one measured shape; 0 where nothing moves.
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
  void read_channels();
  /// What the channels show, without their gains, of some of the reduced model's coordinates (n_channels × n_columns).
  [[nodiscard]] Eigen::MatrixXd channel_rows(const std::vector<int>& columns) const;
  [[nodiscard]] bool acts(const Cause& cause, const ActionSpec& action, const Condition& condition) const;
  /// Relative change of a place's stiffness by an action on it, 0 for an action of another kind.
  [[nodiscard]] double stiffness_change(const Cause& cause, const ActionSpec& action, const Condition& condition) const;
  [[nodiscard]] StructureState build_state(const Condition& condition) const;
  void apply(const Cause& cause, const ActionSpec& action, const Condition& condition, StructureState& state) const;
  /// Adds `change` times the stiffness or mass of a place, as the parameters have made it, to the state that is being built.
  void add_change(const ReducedPlace& place, double change, bool mass, StructureState& state) const;
  /// Takes a support away and puts it up again at a position on its line, between nodes by interpolation.
  void move_support(const ReducedPlace& support, double position, StructureState& state) const;
  void apply_spring(const Candidate& candidate, const ActionSpec& action, double stiffness, StructureState& state) const;
  /// An oscillator or, as a string, a cable of this mass and circular frequency, with degrees of freedom of its own.
  void apply_body(const ReducedPlace& place, const ActionSpec& action, double mass_kg, double omega_rad_s,
                  StructureState& state) const;
  /// A spring k b b' that goes with parameters by a ratio.
  void add_spring(const Eigen::VectorXd& b, double k, const fe::Coefficient& ratio, StructureState& state) const;
  struct DamperInUse;
  [[nodiscard]] DamperInUse damper_in(const Condition& condition, const ReducedPlace& damper) const;
  void apply_dampers(const Condition& condition, StructureState& state) const;

  // states, each solved once (solved_states.cpp)
  struct Acting;
  [[nodiscard]] Acting acting_in(const Condition& condition) const;
  /// Values of a condition that its state depends on: the key of the state beside the causes.
  [[nodiscard]] std::vector<double> circumstances(const Condition& condition, const Acting& acting) const;
  [[nodiscard]] SolvedState& solved(int condition);
  /// Matrices of a state in those of the columns that do not depend on each other in it.
  void build(SolvedState& entry, const Condition& condition, const std::vector<int>& columns) const;
  [[nodiscard]] static Eigen::MatrixXd sliced(const ReducedMatrix& full, const std::vector<int>& columns, Eigen::Index size);
  [[nodiscard]] static Eigen::VectorXd sliced(const ReducedDirections& full, Eigen::Index d, const std::vector<int>& columns,
                                              Eigen::Index size);
  [[nodiscard]] const StateStore::Changes& changes(const SolvedState& state) const;
  /// Stiffness and mass without causes, in some of the reduced model's coordinates.
  [[nodiscard]] const std::pair<Eigen::MatrixXd, Eigen::MatrixXd>& matrices(const std::vector<int>& columns) const;
  [[nodiscard]] const ModeDerivative& derivative(SolvedState& solved, Eigen::Index mode);
  /// Derivatives of some modes, where they are not known yet: each changed matrix is read once for all of them.
  void differentiate_modes(SolvedState& solved, std::vector<Eigen::Index> modes) const;
  /// Those of every mode that was paired with a measured one.
  void differentiate_paired();
  /// Changes of a state's stiffness or mass times each column of x, those that causes share with a parameter included
  /// (size × n_columns n_changes).
  [[nodiscard]] Eigen::MatrixXd changed(const SolvedState& state, bool mass, const Eigen::MatrixXd& x) const;
  /// Changes of a matrix times each column of x (size × n_columns): (size × n_columns n_changes), column by column of x.
  [[nodiscard]] Eigen::MatrixXd times(const std::vector<int>& columns, const std::vector<MatrixChange>& changes,
                                      const Eigen::MatrixXd& x) const;

  // which mode is which (pairing.cpp)
  /// Model modes of what was measured in conditions that share a state: the one-to-one assignment at the least distance of
  /// frequencies, shapes and, with dampers, damping.
  void pair(const std::vector<int>& conditions);
  /// The mode whose measured shape this one should have: itself, or one of the same name.
  [[nodiscard]] const MeasuredMode& shaped_like(const MeasuredMode& measured) const;
  /// 1 - MAC of each mode of a state with a measured shape (n_modes).
  [[nodiscard]] Eigen::VectorXd unlike_measured(const MeasuredMode& shaped, const SolvedState& state);
  /// Whether a measured mode may be none of the model's: its shape tells that. What is held out is always held against the
  /// model.
  [[nodiscard]] bool may_be_none(const MeasuredMode& measured) const;
  /// Steps of frequency and damping between a measured mode and each mode of a state (n_modes).
  [[nodiscard]] Eigen::VectorXd far_from_measured(const MeasuredMode& measured, const SolvedState& state, double width) const;
  /// The same with a mode of the structure as it stands, by the whole shape (n_modes).
  [[nodiscard]] Eigen::VectorXd unlike_bound(int position, const SolvedState& state) const;

  // modes
  void predict_mode(const MeasuredMode& measured, std::size_t position);
  /// What causes do to a mode that is not in the state's matrices.
  struct AddedToMode {
    double frequency = 0.0, damping_pct = 0.0;  ///< to ln f; to the damping ratio
  };
  [[nodiscard]] AddedToMode added_to(const MeasuredMode& measured, const SolvedState& state, Eigen::Index mode) const;
  /// Change of -100 Re s / |s| with s.
  [[nodiscard]] static double damping_slope_pct(Complex s, Complex ds);
  /// Whether a nuisance is the structural damping of this name.
  [[nodiscard]] bool is_damping_of(const Nuisance& v, const std::string& damping_name) const;
  void differentiate_mode(const MeasuredMode& measured, SolvedState& state, Eigen::Index mode, const std::string& damping_name,
                          double own_pct, double total_pct);
  /// The model mode whose shape stands under this measured one: its pair, or another's where shapes were exchanged.
  [[nodiscard]] int mode_of_shape(const MeasuredMode& measured, std::size_t position) const;
  struct ScaledShape;
  [[nodiscard]] ScaledShape scaled_shape(const MeasuredMode& measured, const SolvedState& state, Eigen::Index mode);
  /// Rows of a measured shape that is none of the model's.
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
  [[nodiscard]] Eigen::Index level_of(int condition, bool floor) const;  ///< among the nuisances, -1 without one
  void predict_stays();

  // load tests (load_test_rows.cpp)
  struct SolvedLoadTest;
  void predict_load_tests(int condition);
  /// What the ground does in a condition, and how its springs follow parameters. @return false if a gauged support was moved
  [[nodiscard]] bool ground_of(const Condition& condition, int c, std::vector<GroundState>& ground) const;
  /// Right sides of K dq = df - dK q (size × unknowns), f with the springs of supports that a parameter scales; fills
  /// `relative` of the test.
  [[nodiscard]] Eigen::MatrixXd load_slopes(SolvedLoadTest& test);
  void predict_static_row(const SolvedLoadTest& test, std::size_t row);

  /// What the channels show of each mode of a state, (n_channels × n_modes), gains, signs and delays of causes included.
  [[nodiscard]] const Eigen::MatrixXcd& motion(const SolvedState& state);
  [[nodiscard]] Eigen::VectorXcd shape_at(const std::vector<int>& channels, const SolvedState& state, Eigen::Index mode);
  /// Numbers of causes whose action is this primitive: fn(candidate, coordinates, action).
  template <typename Use>
  void each_action(Primitive primitive, Use use) const {
    for (const Cause& cause : causes_)
      for (const ActionSpec& action : cause.candidate->hypothesis->actions)
        if (action.primitive == primitive) use(*cause.candidate, cause.a, action);
  }
  /// The same of causes that act in the state of the structure that a condition is of.
  template <typename Use>
  void each_action(Primitive primitive, const Condition& condition, Use use) const {
    for (const Cause& cause : causes_) {
      if (!cause.candidate->acts_in(condition)) continue;
      for (const ActionSpec& action : cause.candidate->hypothesis->actions)
        if (action.primitive == primitive) use(*cause.candidate, cause.a, action);
    }
  }
  /// A mode in a record's variance under wind, beyond white excitation (wind_load.cpp).
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
  mutable std::vector<int> columns_;                     // of the state that is being built
  mutable std::vector<SolvedState::Followed> followed_;  // likewise
  /// Rows of the sensors that a channel shows, as causes turn and exchange them, with their weights.
  std::vector<std::vector<std::pair<Eigen::Index, double>>> channel_views_;
  Eigen::VectorXd channel_factor_, channel_delay_s_;
  std::map<const SolvedState*, Eigen::MatrixXcd> motion_;
  std::map<std::pair<std::vector<double>, std::vector<double>>, std::shared_ptr<SolvedState>> own_;
  mutable std::map<std::vector<int>, std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> matrices_;
  UndampedStore undamped_;
  std::map<int, SolvedState*> of_condition_;
  Prediction out_;
  Eigen::Index scale_ = 0;
};

}  // namespace twindeck::diagnosis
