#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <memory>
#include <vector>

#include "diagnosis/feature_map.hpp"

/// Private to src/diagnosis: one evaluation of g(x, a).
namespace twindeck::diagnosis {

/// A state of the structure that several conditions may share, with its modes.
struct SolvedState {
  StructureState state;
  StateModes modes;
  std::map<Eigen::Index, ModeDerivative> derivatives;
};

class Predictor {
 public:
  Predictor(const FeatureMap& map, const FeatureMap::Base& base, const std::vector<Cause>& causes, bool with_jacobian);
  [[nodiscard]] Prediction run();
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> node_motion();

 private:
  using Complex = std::complex<double>;

  // structure (structure_of_causes.cpp)
  void choose_columns();
  [[nodiscard]] StructureState build_state(const Condition& condition) const;
  void apply(const Cause& cause, const ActionSpec& action, const Condition& condition, StructureState& state) const;
  void apply_dampers(const Condition& condition, StructureState& state) const;
  [[nodiscard]] SolvedState& solved(int condition);
  [[nodiscard]] Eigen::MatrixXd sliced(const Eigen::MatrixXd& full, Eigen::Index size) const;
  [[nodiscard]] Eigen::VectorXd sliced(const Eigen::VectorXd& full, Eigen::Index size) const;
  [[nodiscard]] const ModeDerivative& derivative(SolvedState& solved, Eigen::Index mode);

  // measurement (prediction.cpp)
  void pair(int condition);
  void predict_mode(const MeasuredMode& measured, std::size_t position);
  void predict_shape(const MeasuredMode& measured, SolvedState& state, Eigen::Index mode, const Eigen::VectorXcd& phi);
  void predict_load(int condition);
  void predict_stays();
  /// Row of the basis that channel c measures, as causes turn it and exchange it; `factor` is its gain with sign and delay.
  [[nodiscard]] Eigen::RowVectorXd channel_row(int channel, double frequency_Hz, Eigen::Index size, Complex& factor) const;
  [[nodiscard]] Eigen::VectorXcd shape_at(const std::vector<int>& channels, const Eigen::VectorXcd& phi, double frequency_Hz) const;
  /// Numbers of causes whose action has this kind: fn(candidate, coordinates, action).
  template <typename Use>
  void each_action(const std::string& kind, Use use) const {
    for (const Cause& cause : causes_)
      for (const ActionSpec& action : cause.candidate->hypothesis->actions)
        if (action.kind == kind) use(*cause.candidate, cause.a, action);
  }
  /// Weight of a mode in a record's variance under wind, beyond white excitation (wind_load.cpp).
  [[nodiscard]] double wind_weight(const Condition& condition, const SolvedState& state, Eigen::Index mode, const std::string& label) const;
  [[nodiscard]] double structural_damping(const std::string& label) const;  ///< in per cent

  const FeatureMap& map_;
  const FeatureMap::Base& base_;
  const std::vector<Cause>& causes_;
  bool with_jacobian_;
  std::vector<int> columns_;
  std::vector<Eigen::MatrixXd> d_stiffness_, d_mass_;  // structural nuisances, sliced
  std::vector<int> structural_;                        // their positions among the nuisances
  std::map<std::vector<double>, std::unique_ptr<SolvedState>> states_;
  std::map<int, SolvedState*> of_condition_;
  Prediction out_;
  Eigen::Index scale_ = 0;
};

}  // namespace twindeck::diagnosis
