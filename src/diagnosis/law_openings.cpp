#include "diagnosis/law_openings.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of a mode among the training rows, and their variance if it is none of the model's. Within a state one name is one
/// mode: it is the model's in all conditions or in none, and no hypothesis may say that it is another at a large amplitude.
struct OpenRows {
  std::vector<int> modes;  ///< measured ones
  std::vector<int> rows;
  std::vector<double> variance;
  [[nodiscard]] double log_prior() const { return static_cast<double>(modes.size()) * log_prior_of_open(); }
};

std::vector<OpenRows> modes_that_may_open(const Inference& plain, const LawSystem& system) {
  const FeatureMap& map = plain.map();
  std::map<std::pair<std::string, std::string>, OpenRows> by_name;  // state, label
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    if (mode.real_rows.size() < 2) continue;  // no shape tells it from others
    const VectorXd all = variance_of_open(map, mode);
    OpenRows here{{static_cast<int>(m)}, {}, {}};
    bool is_open = true;  // already, or set aside: all its rows are; free scales make some rows of any shape as wide
    for (std::size_t at = 0; at < plain.training().size(); ++at) {
      const double variance = all[plain.training()[at]];
      if (variance <= 0.0) continue;
      here.rows.push_back(static_cast<int>(at));
      here.variance.push_back(variance);
      is_open = is_open && system.sigma(static_cast<Index>(at), static_cast<Index>(at)) > variance;
    }
    if (is_open) continue;
    OpenRows& open = by_name[{map.features().conditions[static_cast<std::size_t>(mode.condition)].state, mode.label}];
    open.modes.insert(open.modes.end(), here.modes.begin(), here.modes.end());
    open.rows.insert(open.rows.end(), here.rows.begin(), here.rows.end());
    open.variance.insert(open.variance.end(), here.variance.begin(), here.variance.end());
  }
  std::vector<OpenRows> out;
  for (auto& [name, open] : by_name) out.push_back(std::move(open));
  return out;
}

double log_density(const VectorXd& e, const MatrixXd& covariance) {
  const MatrixXd lower = linalg::cholesky_factor(covariance);
  if (lower.size() == 0) return -1e300;
  return -0.5 * linalg::lower_solve(lower, e).squaredNorm() - lower.diagonal().array().log().sum();
}

/// What each mode gains by being open at these scales, those that gain nothing left out, the best first. A mode's rows are held
/// against what all other rows predict of them.
std::vector<std::pair<double, int>> gains_of_opening(const LawSystem& system, const LawHypothesis& hypothesis,
                                                     const LawEvidence& at, const std::vector<OpenRows>& modes) {
  MatrixXd sigma = system.sigma;
  for (std::size_t c = 0; c < system.classes.size(); ++c)
    if (const double tau = at.tau[static_cast<Index>(c)]; tau > 0.0) sigma += tau * tau * linalg::square(system.classes[c]);
  const MatrixXd lower = linalg::cholesky_factor(std::move(sigma));
  std::vector<std::pair<double, int>> out;
  if (lower.size() == 0) return out;
  const MatrixXd precision = linalg::inverse_of_factored(lower);
  Index best = 0;
  at.weight.maxCoeff(&best);
  VectorXd left = hypothesis.left.col(best);
  if (hypothesis.slopes.cols() > 0) left -= hypothesis.slopes * at.shift;
  const VectorXd weighed = precision * left;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const OpenRows& open = modes[k];
    const auto n = std::ssize(open.rows);
    const MatrixXd covariance = precision(open.rows, open.rows).ldlt().solve(MatrixXd::Identity(n, n));
    const VectorXd e = covariance * weighed(open.rows);
    const VectorXd variance = Eigen::Map<const VectorXd>(open.variance.data(), n);
    const double gain =
        log_density(e, covariance + MatrixXd(variance.asDiagonal())) - log_density(e, covariance) + open.log_prior();
    if (gain > 0.0) out.emplace_back(gain, static_cast<int>(k));
  }
  std::sort(out.rbegin(), out.rend());
  return out;
}

}  // namespace

FeatureMap with_open(FeatureMap map, const std::vector<int>& modes) {
  VectorXd variance = VectorXd::Zero(map.values().size());
  for (const int m : modes) variance += variance_of_open(map, map.measured_modes()[static_cast<std::size_t>(m)]);
  map.add_covariance(variance.asDiagonal());
  return map;
}

Fit fit_with_open(const Inference& inference, const std::vector<int>& modes, const std::vector<Cause>& causes,
                  const VectorXd& start) {
  const FeatureMap map = with_open(inference.map(), modes);
  return Inference(map, inference.candidates()).fit(causes, start);
}

OpenedEvidence scored_with_openings(const Inference& plain, LawSystem& system, const LawHypothesis& hypothesis,
                                    const VectorXd& start) {
  OpenedEvidence out;
  if (const OneLaw law(system); law.sound()) out.evidence = law.scored(hypothesis, start);
  std::vector<OpenRows> modes = modes_that_may_open(plain, system);
  bool more = out.evidence.weight.size() > 0;
  while (more) {
    more = false;
    const auto gains = gains_of_opening(system, hypothesis, out.evidence, modes);
    // All that gain by themselves, or else the one that gains most: two that explain each other need not both be open.
    for (std::size_t count = gains.size(); count > 0 && !more; count = count > 1 ? 1 : 0) {
      const VectorXd before = system.sigma.diagonal();
      const double prior = system.log_prior;
      for (std::size_t k = 0; k < count; ++k) {
        const OpenRows& open = modes[static_cast<std::size_t>(gains[k].second)];
        for (std::size_t r = 0; r < open.rows.size(); ++r) system.sigma(open.rows[r], open.rows[r]) += open.variance[r];
        system.log_prior += open.log_prior();
      }
      LawEvidence evidence;
      if (const OneLaw law(system); law.sound()) evidence = law.scored(hypothesis, out.evidence.tau);
      more = evidence.weight.size() > 0 && evidence.log_evidence > out.evidence.log_evidence;
      if (!more) {
        system.sigma.diagonal() = before;
        system.log_prior = prior;
        continue;
      }
      out.evidence = std::move(evidence);
      for (std::size_t k = 0; k < count; ++k) {
        OpenRows& open = modes[static_cast<std::size_t>(gains[k].second)];
        out.opened.insert(out.opened.end(), open.modes.begin(), open.modes.end());
        open.rows.clear();
      }
      std::erase_if(modes, [](const OpenRows& m) { return m.rows.empty(); });
    }
  }
  return out;
}

}  // namespace twindeck::diagnosis
