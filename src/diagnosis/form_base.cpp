#include "diagnosis/form_base.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "diagnosis/form_frame.hpp"
#include "diagnosis/law_openings.hpp"
#include "diagnosis/law_search.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<FormLevel, 3> kLevels = {{{0.01, 0.01}, {0.02, 0.03}, {0.03, 0.10}}};
// chi² over degrees of freedom of the first fit. Up to the first number, fits assume the least form error, because the misfit
// may come from a cause that acts in every condition. Above it the model is grossly wrong, and fits assume the form error at
// which the second number is met.
constexpr double kGrossMisfit = 10.0, kLargestMisfit = 2.0;
/// Conditions used by the first fit.
std::set<int> plainest_conditions(const FeatureSet& features) {
  std::set<int> out;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency || row.type == RowType::shape) out.insert(row.condition);
  const auto keep = [&](const auto& unwanted) {  // unless no condition would be left
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

/// Errors that exclude rows from a fit (n × n).
MatrixXd set_aside(const std::vector<int>& rows, Index n) {
  MatrixXd out = MatrixXd::Zero(n, n);
  for (const int r : rows) out(r, r) = kAside * kAside;
  return out;
}

std::vector<int> rows_outside(const FeatureSet& features, const std::set<int>& conditions) {
  std::vector<int> out;
  if (conditions.empty()) return out;  // load tests alone have no modes; all their rows count
  for (std::size_t r = 0; r < features.rows.size(); ++r)
    if (!conditions.contains(features.rows[r].condition)) out.push_back(static_cast<int>(r));
  return out;
}

Fit fit_without(const Inference& informed, const std::vector<int>& rows) {
  if (rows.empty()) return informed.fit({}, {});
  FeatureMap map = informed.map();
  map.add_covariance(set_aside(rows, std::ssize(map.features().rows)));
  return Inference(map, informed.candidates()).fit({}, {});
}

/// chi² over degrees of freedom of the fit to the plainest conditions; infinite if there is no fit.
double misfit_of_plainest(const Inference& informed) {
  const FeatureMap& map = informed.map();
  const std::set<int> plainest = plainest_conditions(map.features());
  const std::vector<int> others = rows_outside(map.features(), plainest);
  const Fit fit = fit_without(informed, others);
  if (!fit.made()) return std::numeric_limits<double>::infinity();
  const std::set<int> open(fit.all.open.begin(), fit.all.open.end());
  int dof = 0;
  for (std::size_t r = 0; r < map.features().rows.size(); ++r)
    if (plainest.contains(map.features().rows[r].condition) && !open.contains(static_cast<int>(r))) ++dof;
  for (const MeasuredMode& mode : map.measured_modes())  // each shape has a free scale
    if (plainest.contains(mode.condition) && !mode.real_rows.empty() && !open.contains(mode.real_rows.front())) --dof;
  return fit.chi_squared / std::max(dof, 1);
}

}  // namespace

FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base, const VectorXd& predicted,
                           const FormLevel& level) {
  FeatureMap out = plain;
  out.add_covariance(form_covariance(plain, base, {}, predicted, level.frequency, level.shape));
  return out;
}

FormLevel level_of_fits(const Inference& whole, const FeatureMap::Base& prior, const VectorXd& predicted) {
  double most = kGrossMisfit;
  for (const FormLevel& level : kLevels) {
    const FeatureMap informed = with_form_error(whole.map(), prior, predicted, level);
    if (misfit_of_plainest(Inference(informed, whole.candidates())) < most) return level;
    most = kLargestMisfit;
  }
  return kLevels.back();
}

Fit first_fit(const Inference& plain, const Inference& informed) {
  const FeatureMap& map = plain.map();
  const std::vector<int> others = rows_outside(map.features(), plainest_conditions(map.features()));
  const MatrixXd aside = set_aside(others, std::ssize(map.features().rows));
  FeatureMap exact_map = map, quiet_map = informed.map();
  exact_map.add_covariance(aside);
  quiet_map.add_covariance(aside);
  const Inference exact(exact_map, plain.candidates()), quiet(quiet_map, plain.candidates());
  Fit fit = quiet.fit({}, {});
  std::vector<int> opened;
  while (fit.made()) {  // each round opens more modes than the last one
    FitSystem system = law_system(exact, fit, {});
    if (!can_be_weighed(system)) break;
    const LawHypothesis none{system.residual,        VectorXd::Zero(1), MatrixXd(system.residual.size(), 0), {}, {},
                             lasting_classes(system)};
    std::vector<int> now = scored_with_openings(exact, system, none, VectorXd::Ones(std::ssize(system.classes))).opened;
    if (now.size() <= opened.size()) break;
    Fit again = fit_with_open(quiet, now, {}, fit.map.x);
    if (!again.made()) break;
    fit = std::move(again);
    opened = std::move(now);
  }
  return !fit.made() || (others.empty() && opened.empty()) ? fit : informed.stand(fit.map.x);
}

}  // namespace twindeck::diagnosis
