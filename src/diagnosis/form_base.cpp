#include "diagnosis/form_base.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/features/shape_turn.hpp"
#include "diagnosis/form_frame.hpp"
#include "modal/mac.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<FormLevel, 3> kLevels = {{{0.01, 0.01}, {0.02, 0.03}, {0.03, 0.10}}};
// chi² over degrees of freedom of the first fit. Up to the first number fits find their place with the least level, and a
// cause that acts in every condition may be what is left; above it the model is grossly off, and fits stand the level at which
// the second is met.
constexpr double kGrossMisfit = 10.0, kLargestMisfit = 2.0;
constexpr double kAside = 10.0;  // deviation of rows that are set aside: e^10, far beyond any change
// A measured mode has no counterpart where its MAC with the model's is below; at most this part of the modes may be such.
constexpr double kLeastMac = 0.5, kMostStrangers = 0.25;
constexpr double kSameMac = 0.8, kSameFrequency = 0.2;  // of one measured mode in two conditions: MAC above, |ln ratio| below

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

/// Modal assurance criterion of two shapes in the same rows; 0 where one of them is nil.
double shape_mac(const VectorXd& a, const VectorXd& b) {
  return a.squaredNorm() > 0.0 && b.squaredNorm() > 0.0 ? modal::mac(a, b)(0, 0) : 0.0;
}

/// Modes measured in the plainest conditions that no mode of the model resembles. If many are such, the model is not the
/// structure, or a channel is wrong: none then.
std::vector<std::size_t> strangers_of(const FeatureMap& map, const Fit& fit) {
  const std::set<int> plainest = plainest_conditions(map.features());
  std::vector<std::size_t> out;
  std::size_t looked_at = 0;
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    if (!plainest.contains(mode.condition) || mode.real_rows.empty()) continue;
    ++looked_at;
    if (fit.all.mac[m] < kLeastMac) out.push_back(m);
  }
  if (static_cast<double>(out.size()) > kMostStrangers * static_cast<double>(looked_at)) out.clear();
  return out;
}

/// Whether a mode is a stranger that was measured again, or has its shape next to it: of a mode and its hybrid nobody knows
/// which is the model's.
bool is_like(const FeatureMap& map, const MeasuredMode& mode, const MeasuredMode& stranger) {
  const CommonRows common = common_rows({mode.real_rows, mode.real_channels}, {stranger.real_rows, stranger.real_channels});
  return common.most && std::abs(std::log(mode.frequency_Hz / stranger.frequency_Hz)) < kSameFrequency &&
         shape_mac(map.values()(common.first), map.values()(common.second)) > kSameMac;
}

Strangers strangers_with_rows(const FeatureMap& map, const Fit& fit) {
  Strangers strangers;
  std::vector<std::string>& labels = strangers.labels;
  const std::vector<MeasuredMode>& modes = map.measured_modes();
  const std::vector<std::size_t> found = strangers_of(map, fit);
  for (const std::size_t s : found)
    if (std::find(labels.begin(), labels.end(), modes[s].label) == labels.end()) labels.push_back(modes[s].label);
  std::vector<int>& out = strangers.rows;
  for (const MeasuredMode& mode : modes) {
    if (std::none_of(found.begin(), found.end(), [&](std::size_t s) { return is_like(map, mode, modes[s]); })) continue;
    ++strangers.shapes;
    out.insert(out.end(), mode.real_rows.begin(), mode.real_rows.end());
    out.insert(out.end(), mode.imag_rows.begin(), mode.imag_rows.end());
    if (mode.frequency >= 0) out.push_back(mode.frequency);
    if (mode.damping >= 0) out.push_back(mode.damping);
  }
  return strangers;
}

/// Errors that set rows aside (n × n).
MatrixXd set_aside(const std::vector<int>& rows, Index n) {
  MatrixXd out = MatrixXd::Zero(n, n);
  for (const int r : rows) out(r, r) = kAside * kAside;
  return out;
}

std::vector<int> rows_outside(const FeatureSet& features, const std::set<int>& conditions) {
  std::vector<int> out;
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

/// chi² over the degrees of freedom of the fit to the plainest conditions; infinite where none can be made.
double misfit_of_plainest(const Inference& informed, const Strangers& strangers) {
  const FeatureMap& map = informed.map();
  const std::set<int> plainest = plainest_conditions(map.features()), strange(strangers.rows.begin(), strangers.rows.end());
  const std::vector<int> others = rows_outside(map.features(), plainest);
  const Fit fit = fit_without(informed, others);
  if (!fit.made()) return std::numeric_limits<double>::infinity();
  int dof = 0;
  for (std::size_t r = 0; r < map.features().rows.size(); ++r)
    if (plainest.contains(map.features().rows[r].condition) && !strange.contains(static_cast<int>(r))) ++dof;
  for (const MeasuredMode& mode : map.measured_modes())  // each shape has a free scale
    if (plainest.contains(mode.condition) && !mode.real_rows.empty() && !strange.contains(mode.real_rows.front())) --dof;
  return fit.chi_squared / std::max(dof, 1);
}

FitGround ground_at(const Inference& whole, const FeatureMap::Base& prior, const VectorXd& predicted, const FormLevel& level) {
  FitGround out{whole.map(), {}, level};
  const FeatureMap informed = with_form_error(whole.map(), prior, predicted, level);
  const Fit fit = first_fit(Inference(informed, whole.candidates()));
  if (!fit.made()) return out;
  out.strangers = strangers_with_rows(whole.map(), fit);
  if (!out.strangers.rows.empty()) out.known.add_covariance(set_aside(out.strangers.rows, predicted.size()));
  return out;
}

}  // namespace

FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base, const VectorXd& predicted,
                           const FormLevel& level) {
  FeatureMap out = plain;
  out.add_covariance(form_covariance(plain, base, {}, predicted, level.frequency, level.shape));
  return out;
}

FitGround ground_of_fits(const Inference& whole, const FeatureMap::Base& prior, const VectorXd& predicted) {
  double most = kGrossMisfit;
  for (const FormLevel& level : kLevels) {
    FitGround out = ground_at(whole, prior, predicted, level);
    const FeatureMap informed = with_form_error(out.known, prior, predicted, level);
    if (misfit_of_plainest(Inference(informed, whole.candidates()), out.strangers) < most) return out;
    most = kLargestMisfit;
  }
  return ground_at(whole, prior, predicted, kLevels.back());
}

Fit first_fit(const Inference& informed) {
  const std::vector<int> others = rows_outside(informed.map().features(), plainest_conditions(informed.map().features()));
  const Fit fit = fit_without(informed, others);
  return others.empty() || !fit.made() ? fit : informed.stand(fit.map.x);
}

}  // namespace twindeck::diagnosis
