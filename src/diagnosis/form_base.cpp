#include "diagnosis/form_base.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "diagnosis/form_frame.hpp"
#include "diagnosis/law_frame.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kAside = 10.0;  // deviation of rows that are set aside: e^10, far beyond any change
/// Conditions that the first fit is made to.
std::set<int> plainest_conditions(const FeatureSet& features) {
  std::set<int> out;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency || row.type == RowType::shape) out.insert(row.condition);
  const auto keep = [&](const auto& unwanted) {  // as long as one condition is left
    std::set<int> left;
    for (const int c : out)
      if (!unwanted(c)) left.insert(c);
    if (!left.empty()) out = std::move(left);
  };
  const std::vector<std::string> states = states_of(features);
  if (states.size() > 1) {
    keep([&](int c) { return features.conditions[static_cast<std::size_t>(c)].state != states.front(); });
    return out;
  }
  for (const Contrast& contrast : contrasts_of(features)) {
    const double sign = contrast.key == "temperature_C" ? -1.0 : 1.0;
    double least = std::numeric_limits<double>::infinity();
    for (const int c : out) least = std::min(least, sign * contrast.weight[c]);
    keep([&](int c) { return sign * contrast.weight[c] > least; });
  }
  return out;
}

/// Errors that set rows aside (n × n).
MatrixXd set_aside(const std::vector<int>& rows, Index n) {
  MatrixXd out = MatrixXd::Zero(n, n);
  for (const int r : rows) out(r, r) = kAside * kAside;
  return out;
}

std::vector<int> rows_outside(const FeatureSet& features, const std::set<int>& conditions) {
  std::vector<int> out;
  if (conditions.empty()) return out;  // load tests alone have no modes: all of them count
  for (std::size_t r = 0; r < features.rows.size(); ++r)
    if (!conditions.contains(features.rows[r].condition)) out.push_back(static_cast<int>(r));
  return out;
}

/// Fit in which some rows count for nothing.
Fit fit_without(const Inference& informed, const std::vector<int>& rows) {
  if (rows.empty()) return informed.fit({}, {});
  FeatureMap map = informed.map();
  map.add_covariance(set_aside(rows, std::ssize(map.features().rows)));
  return Inference(map, informed.candidates()).fit({}, {});
}

/// Form errors that the rows show at a fit, whatever else may have changed; the unit of their classes where that cannot be
/// told.
FormLevel level_at(const Inference& whole, const Fit& fit, const std::vector<Contrast>& contrasts) {
  FormLevel out{kUnitOfClasses, kUnitOfClasses};
  if (!fit.made()) return out;
  const LawSystem system = law_system(whole, fit, contrasts);
  const OneLaw law(system);
  if (!can_be_weighed(system) || !law.sound()) return out;
  LawHypothesis all{system.residual, VectorXd::Zero(1), MatrixXd(system.residual.size(), 0), {}, {}, {}};
  for (std::size_t c = 0; c < system.classes.size(); ++c)
    if (system.classes[c].cols() > 0) all.active.push_back({static_cast<int>(c), 1.0});
  const LawEvidence found = law.scored(all, VectorXd::Ones(law.classes()));
  if (found.tau[kFrequencies] > 0.0) out.frequency *= found.tau[kFrequencies];
  if (found.tau[kShapes] > 0.0) out.shape *= found.tau[kShapes];
  return out;
}

}  // namespace

FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base, const VectorXd& predicted,
                           const FormLevel& level) {
  FeatureMap out = plain;
  out.add_covariance(form_covariance(plain, base, {}, predicted, level.frequency, level.shape));
  return out;
}

FormLevel level_of_fits(const Inference& whole, const std::vector<Contrast>& contrasts, const FeatureMap::Base& prior,
                        const VectorXd& predicted) {
  const FeatureMap& map = whole.map();
  const FormLevel unfitted = level_at(whole, whole.stand(VectorXd::Zero(std::ssize(map.nuisances()))), contrasts);
  const FeatureMap informed = with_form_error(map, prior, predicted, unfitted);
  return level_at(whole, first_fit(Inference(informed, whole.candidates())), contrasts);
}

Fit first_fit(const Inference& informed) {
  const std::vector<int> others = rows_outside(informed.map().features(), plainest_conditions(informed.map().features()));
  const Fit fit = fit_without(informed, others);
  return others.empty() || !fit.made() ? fit : informed.stand(fit.map.x);
}

}  // namespace twindeck::diagnosis
