#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/files/catalogue_files.hpp"
#include "diagnosis/law_diagnosis.hpp"
#include "test_places.hpp"

namespace twindeck::tests {

/// What a chain really is: the model with factors on its springs, masses and ties added. Its modes are computed with dense
/// matrices of their own, so that nothing of the diagnosis is in them.
struct ChainTruth {
  Eigen::VectorXd spring;  ///< (n + 1) factors
  Eigen::VectorXd mass;    ///< (n) [kg]
  Eigen::VectorXd gain;    ///< (n_channels) factors
  int tie_from = -1, tie_to = -1;
  double tie_N_m = 0.0;
};

struct ChainOptions {
  int masses = 16;
  std::vector<int> channels = {};  ///< dofs with a sensor; empty: every one
  int modes = 8;
  bool shapes = true;
  bool parameters = true;  ///< springs as parameters within ± 10 %; otherwise they are known
  bool dampers = false;    ///< a damper between the middle mass and the ground
  double frequency_std = 0.003, shape_std = 0.02;
};

/// n masses of 1000 kg in a row between two walls, n + 1 springs of 2 MN/m: symmetric about its middle, without coordinates.
class Chain {
 public:
  static constexpr double kMass = 1000.0, kSpring = 2e6, kDamping = 4e3;

  explicit Chain(const ChainOptions& options = {}) : options_(options) {
    const int n = options.masses;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      system_.dofs.push_back({std::to_string(i + 1), 0, Eigen::Vector3d::Constant(std::nan(""))});
      entries.emplace_back(i, i, 0.0);
      if (i > 0) entries.emplace_back(i, i - 1, 0.0);
    }
    system_.pattern.resize(n, n);
    system_.pattern.setFromTriplets(entries.begin(), entries.end());
    const int* outer = system_.pattern.outerIndexPtr();
    for (int s = 0; s <= n; ++s) {
      const double reach = options.parameters ? 0.1 : 0.0;
      system_.parameters.push_back(
          {"g" + std::to_string(s), fe::Target::matrix_stiffness, {}, "-", 1.0, 1.0 - reach, 1.0 + reach});
      fe::Term term;
      term.coefficient.factors = {{s, 1.0, 1.0}};
      const auto add = [&](int position, double value) {
        term.position.push_back(position);
        term.value.push_back(value);
      };
      if (s > 0) add(outer[s - 1], kSpring);
      if (s > 0 && s < n) add(outer[s - 1] + 1, -kSpring);
      if (s < n) add(outer[s], kSpring);
      system_.stiffness_terms.push_back(term);
    }
    fe::Term mass;
    for (int i = 0; i < n; ++i) {
      mass.position.push_back(outer[i]);
      mass.value.push_back(kMass);
    }
    system_.mass_terms.push_back(mass);
    channels_ = options.channels;
    if (channels_.empty())
      for (int i = 0; i < n; ++i) channels_.push_back(i);
    structure_.system = &system_;
    structure_.theta = system_.initial();
    structure_.sensors = [this](const Eigen::MatrixXd& v) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(4 * static_cast<Eigen::Index>(channels_.size()), v.cols());
      for (std::size_t c = 0; c < channels_.size(); ++c)
        out.row(4 * static_cast<Eigen::Index>(c)) = out.row(4 * static_cast<Eigen::Index>(c) + 1) = v.row(channels_[c]);
      return out;
    };
    for (const int c : channels_) structure_.sensor_nodes.push_back(std::to_string(c + 1));
    places_ = diagnosis::find_places(structure_, {});
    if (options.dampers) {
      diagnosis::Place damper{"damper:D", Eigen::Vector3d::Zero(),
                              {},         {},
                              {},         {{"damping", kDamping}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 0.0}},
                              {}};
      damper.directions.resize(n, 1);
      damper.directions.insert(n / 2, 0) = 1.0;
      places_.sets["dampers"] = {damper};
    }
    reduced_ = std::make_unique<diagnosis::ReducedModel>(structure_, places_, diagnosis::ReductionOptions{});
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  [[nodiscard]] const diagnosis::ReducedModel& reduced() const { return *reduced_; }
  [[nodiscard]] const diagnosis::Structure& structure() const { return structure_; }
  [[nodiscard]] const diagnosis::Places& places() const { return places_; }

  [[nodiscard]] ChainTruth as_modelled() const {
    const auto n = static_cast<Eigen::Index>(options_.masses);
    return {Eigen::VectorXd::Ones(n + 1),
            Eigen::VectorXd::Constant(n, kMass),
            Eigen::VectorXd::Ones(static_cast<Eigen::Index>(channels_.size())),
            -1,
            -1,
            0.0};
  }
  /// Springs, masses and gains scattered as the diagnosis supposes.
  [[nodiscard]] ChainTruth scattered(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    ChainTruth truth = as_modelled();
    if (options_.parameters)
      for (double& factor : truth.spring) factor += 0.05 * std::clamp(normal(random), -2.0, 2.0);
    for (double& m : truth.mass) m *= 1.0 + 0.02 * normal(random);
    for (double& g : truth.gain) g *= 1.0 + 0.01 * normal(random);
    return truth;
  }
  [[nodiscard]] Eigen::MatrixXd stiffness(const ChainTruth& truth) const {
    const auto n = static_cast<Eigen::Index>(options_.masses);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index s = 0; s <= n; ++s) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
      if (s > 0) b[s - 1] = -1.0;
      if (s < n) b[s] = 1.0;
      k += kSpring * truth.spring[s] * b * b.transpose();
    }
    if (truth.tie_from >= 0) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
      b[truth.tie_from] = 1.0;
      b[truth.tie_to] = -1.0;
      k += truth.tie_N_m * b * b.transpose();
    }
    return k;
  }
  /// Frequencies and shapes (at the channels) of the truth as rows, with errors of the stated deviations when `random` is
  /// given.
  [[nodiscard]] diagnosis::FeatureSet measure(const ChainTruth& truth, std::mt19937_64* random = nullptr) const {
    using diagnosis::RowType;
    const Eigen::VectorXd root = truth.mass.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.asDiagonal() * stiffness(truth) * root.asDiagonal());
    std::normal_distribution<double> normal;
    const auto error = [&] { return random != nullptr ? normal(*random) : 0.0; };
    diagnosis::FeatureSet f;
    for (const int c : channels_) {
      f.channels.push_back("c" + std::to_string(c + 1));
      f.direction.push_back(Eigen::Vector3d::UnitX());
    }
    f.conditions.emplace_back();
    f.conditions.back().name = "calm";
    for (int m = 0; m < options_.modes; ++m) {
      const double hertz = std::sqrt(eigen.eigenvalues()[m]) / (2.0 * std::numbers::pi);
      const double std = options_.frequency_std * hertz;
      f.rows.push_back({RowType::frequency, std::to_string(m + 1), -1, "", 0, hertz + std * error(), std, false});
      if (!options_.shapes) continue;
      Eigen::VectorXd shape = (root.asDiagonal() * eigen.eigenvectors().col(m))(channels_).cwiseProduct(truth.gain);
      shape /= shape.cwiseAbs().maxCoeff();
      for (Eigen::Index c = 0; c < shape.size(); ++c)
        f.rows.push_back({RowType::shape, std::to_string(m + 1), static_cast<int>(c), "", 0,
                          shape[c] + options_.shape_std * error(), options_.shape_std, false});
    }
    diagnosis::hold_out_by_rule(f);
    return f;
  }

 private:
  ChainOptions options_;
  fe::ParametricSystem system_;
  std::vector<int> channels_;
  diagnosis::Structure structure_;
  diagnosis::Places places_;
  std::unique_ptr<diagnosis::ReducedModel> reduced_;
};

/// The catalogue of the product, or only these families of it.
inline std::vector<diagnosis::Hypothesis> catalogue(const std::vector<std::string>& only = {}) {
  std::vector<diagnosis::Hypothesis> all =
      diagnosis::read_catalogue(std::string(TWINDECK_SOURCE_DIR) + "/workflows/common/hypotheses");
  if (!only.empty()) std::erase_if(all, [&](const auto& h) { return std::find(only.begin(), only.end(), h.id) == only.end(); });
  return all;
}

/// A diagnosis with what it rests on kept alive.
struct Examined {
  std::unique_ptr<std::vector<diagnosis::Hypothesis>> hypotheses;
  diagnosis::Instantiated entries;
  std::unique_ptr<diagnosis::FeatureMap> map;
  std::unique_ptr<diagnosis::Inference> inference;
  diagnosis::Diagnosis result;

  [[nodiscard]] const diagnosis::Candidate& entry(const std::string& id) const {
    for (const auto& candidate : entries.candidates)
      if (candidate->id() == id) return *candidate;
    throw std::runtime_error("no entry " + id);
  }
};

/// Everything up to the inference; `diagnosed` runs it.
inline Examined examine(const Chain& chain, const diagnosis::FeatureSet& features,
                        std::vector<diagnosis::Hypothesis> hypotheses, const diagnosis::ScatterOptions& scatter = {}) {
  Examined out;
  out.hypotheses = std::make_unique<std::vector<diagnosis::Hypothesis>>(std::move(hypotheses));
  out.entries = diagnosis::instantiate(*out.hypotheses, chain.reduced(), features);
  out.map = std::make_unique<diagnosis::FeatureMap>(chain.reduced(), features, scatter);
  out.inference = std::make_unique<diagnosis::Inference>(*out.map, out.entries.candidates);
  return out;
}

inline Examined diagnosed(const Chain& chain, const diagnosis::FeatureSet& features,
                          std::vector<diagnosis::Hypothesis> hypotheses, const diagnosis::ScatterOptions& scatter = {},
                          const diagnosis::DiagnoseOptions& options = {}) {
  Examined out = examine(chain, features, std::move(hypotheses), scatter);
  out.result = diagnosis::diagnose(*out.inference, options, 1);
  return out;
}

}  // namespace twindeck::tests
