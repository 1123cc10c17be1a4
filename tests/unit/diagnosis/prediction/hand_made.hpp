#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/prediction/feature_map.hpp"
#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {

/// A cause of one action with plain numbers, without a catalogue.
class HandMade {
 public:
  HandMade(const std::string& kind, const std::map<std::string, double>& numbers,
           const std::vector<const diagnosis::ReducedPlace*>& places = {}) {
    diagnosis::ActionSpec action;
    action.primitive = diagnosis::primitive_named(kind).value();
    for (const auto& [name, value] : numbers) action.number[name] = {value, "", 0};
    hypothesis.id = kind;
    hypothesis.actions = {action};
    candidate.hypothesis = &hypothesis;
    candidate.places = places;
  }
  HandMade(const HandMade&) = delete;
  HandMade& operator=(const HandMade&) = delete;

  HandMade& with_text(const std::string& key, const std::string& value) {
    hypothesis.actions[0].text[key] = value;
    return *this;
  }
  HandMade& on_channels(const std::vector<int>& channels) {
    candidate.channels = channels;
    return *this;
  }
  [[nodiscard]] diagnosis::Cause cause() const { return {&candidate, Eigen::VectorXd()}; }

  diagnosis::Hypothesis hypothesis;
  diagnosis::Candidate candidate;
};

/// A structure of matrices with rows that are predicted. Channel c is dof c; `features` starts with one condition, "calm".
class Predicted {
 public:
  Predicted(const std::vector<fe::DofLabel>& dofs, const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
            const std::vector<MatrixModel::Part>& parts = {}, const std::function<void(diagnosis::Places&)>& more = {},
            const diagnosis::LoadTests& tests = {}, const diagnosis::ReductionOptions& reduction = {})
      : model_(dofs, stiffness, mass, parts), structure_(model_.structure()), places_(find_places(structure_, {})) {
    structure_.load_tests = tests;
    if (more) more(places_);
    reduced_ = std::make_unique<diagnosis::ReducedModel>(structure_, places_, reduction);
    for (std::size_t c = 0; c < dofs.size(); ++c) {
      features.channels.push_back("c" + std::to_string(c));
      features.direction.push_back(Eigen::Vector3d::Unit(dofs[c].direction % 3));
    }
    add_condition("calm");
  }
  Predicted(const Predicted&) = delete;
  Predicted& operator=(const Predicted&) = delete;

  diagnosis::Condition& add_condition(const std::string& name) {
    features.conditions.emplace_back();
    features.conditions.back().name = name;
    return features.conditions.back();
  }
  /// A row of the last condition. @return its position
  Eigen::Index add_row(diagnosis::RowType type, const std::string& mode, int channel, double value, double std = 0.01) {
    features.rows.push_back({type, mode, channel, "", static_cast<int>(features.conditions.size()) - 1, value, std, false});
    return std::ssize(features.rows) - 1;
  }
  /// Frequency rows "1", "2" … of the last condition.
  void add_frequencies(const Eigen::VectorXd& hertz) {
    for (Eigen::Index i = 0; i < hertz.size(); ++i)
      add_row(diagnosis::RowType::frequency, std::to_string(i + 1), -1, hertz[i], 0.01 * hertz[i]);
  }
  [[nodiscard]] const diagnosis::ReducedPlace* place(const std::string& set, const std::string& id) const {
    return reduced_->place(set, id);
  }
  [[nodiscard]] const diagnosis::ReducedModel& reduced() const { return *reduced_; }
  [[nodiscard]] const diagnosis::Structure& structure() const { return structure_; }
  [[nodiscard]] const diagnosis::Places& places() const { return places_; }
  [[nodiscard]] diagnosis::FeatureMap map(const diagnosis::ScatterOptions& scatter = {}) const {
    return {*reduced_, features, scatter};
  }
  [[nodiscard]] diagnosis::Prediction predict(const std::vector<diagnosis::Cause>& causes = {}) const {
    const diagnosis::FeatureMap map = this->map();
    return map.predict(map.base(Eigen::VectorXd::Zero(std::ssize(map.nuisances()))), causes, false);
  }

  diagnosis::FeatureSet features;

 private:
  MatrixModel model_;
  diagnosis::Structure structure_;
  diagnosis::Places places_;
  std::unique_ptr<diagnosis::ReducedModel> reduced_;
};

/// Frequencies of dense matrices, ascending.
inline Eigen::VectorXd dense_hertz(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(stiffness, mass);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

}  // namespace twindeck::tests
