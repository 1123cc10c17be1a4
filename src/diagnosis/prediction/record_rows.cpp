#include <algorithm>
#include <cmath>

#include "diagnosis/prediction/predictor.hpp"

/// Rows of records: root mean squares under excitation, and noise floors.
namespace twindeck::diagnosis {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastDamping_pct = 0.02;  ///< of a mode under white excitation, whose variance is proportional to 1 / damping

}  // namespace

Index Predictor::level_of(int c, bool floor) const {
  for (std::size_t j = 0; j < map_.nuisances_.size(); ++j)
    if (map_.nuisances_[j].kind == Nuisance::Kind::level && map_.nuisances_[j].index == 2 * c + (floor ? 1 : 0))
      return static_cast<Index>(j);
  return -1;
}

Predictor::ExcitedMode Predictor::excited_mode(int c, SolvedState& state, Index mode) {
  const Condition& condition = map_.features().conditions[static_cast<std::size_t>(c)];
  std::string label;
  for (std::size_t m = 0; m < map_.modes_.size(); ++m)
    if (out_.paired[m] == mode && of_condition_.contains(map_.modes_[m].condition) &&
        of_condition_.at(map_.modes_[m].condition) == &state && map_.same_state(map_.modes_[m].condition, c))
      label = map_.modes_[m].label;
  const std::string damping_name = label.empty() ? "" : map_.damping_name(label, c);
  const double own_pct = label.empty() ? kUsualDamping_pct : structural_damping(damping_name);
  double zeta_pct = own_pct + 100.0 * state.modes.damping(mode);
  each_action(Primitive::wind_damping, condition, [&](const Candidate& candidate, const VectorXd& a, const ActionSpec& action) {
    zeta_pct += 100.0 * candidate.value(action.number.at("rate"), a) * condition.wind_m_s.value_or(0.0);
  });
  // White excitation: the variance of a mode's acceleration is proportional to omega / zeta.
  ExcitedMode out = wind_load(condition, state, mode, label);
  const Complex s = state.modes.s[mode];
  out.weight *= std::abs(s) / std::max(zeta_pct, kLeastDamping_pct);
  if (!with_jacobian_) return out;
  const ModeDerivative& d = derivative(state, mode);
  const auto& position = changes(state).position;
  const double per_zeta = zeta_pct > kLeastDamping_pct ? 1.0 / zeta_pct : 0.0;
  for (std::size_t j = 0; j < position.size(); ++j) {
    const double relative = (d.s[static_cast<Index>(j)] / s).real();
    out.slope[position[j]] += relative - per_zeta * damping_slope_pct(s, d.s[static_cast<Index>(j)]);
  }
  for (std::size_t j = 0; j < map_.nuisances_.size() && !label.empty(); ++j)
    if (is_damping_of(map_.nuisances_[j], damping_name))
      out.slope[static_cast<Index>(j)] -= per_zeta * map_.nuisances_[j].deviation * own_pct;
  return out;
}

void Predictor::predict_floor(std::size_t r) {
  const Row& row = map_.features().rows[r];
  const Condition& condition = map_.features().conditions[static_cast<std::size_t>(row.condition)];
  const auto at = static_cast<Index>(r);
  const Index j = level_of(row.condition, true);
  const Nuisance& level = map_.nuisances_[static_cast<std::size_t>(j)];
  double g = level.deviation * base_.x[j];
  each_action(Primitive::channel_floor, condition,
              [&](const Candidate& candidate, const VectorXd& a, const ActionSpec& action) {
                if (candidate.channels[0] == row.channel) g += std::log(candidate.value(action.number.at("factor"), a));
              });
  each_action(Primitive::channel_gain, condition, [&](const Candidate& candidate, const VectorXd& a, const ActionSpec& action) {
    if (candidate.channels[0] == row.channel) g += 2.0 * std::log(candidate.value(action.number.at("factor"), a));
  });
  out_.g[at] = g;
  if (with_jacobian_) out_.jacobian(at, j) = level.deviation;
}

void Predictor::predict_rms(std::size_t r, SolvedState& state, const std::vector<ExcitedMode>& excited) {
  const Row& row = map_.features().rows[r];
  const auto at = static_cast<Index>(r);
  double variance = 0.0;
  VectorXd slope = VectorXd::Zero(with_jacobian_ ? static_cast<Index>(map_.nuisances_.size()) : 0);
  const Reading& read = reading(row.condition);
  const Eigen::RowVectorXd sensor = read.factor[row.channel] * channel_rows(read, state.columns).row(row.channel);
  for (Index i = 0; i < state.modes.s.size(); ++i) {
    const ExcitedMode& mode = excited[static_cast<std::size_t>(i)];
    const double square = std::norm(motion(state, read)(row.channel, i));
    variance += mode.weight * square;
    if (!with_jacobian_) continue;
    const ModeDerivative& d = derivative(state, i);
    const auto& position_of = changes(state).position;
    const Complex h = sensor.cast<Complex>() * state.modes.shapes.col(i).head(sensor.size());  // without the channel's delay
    const Eigen::RowVectorXcd dh = sensor.cast<Complex>() * d.shapes.topRows(sensor.size()) + h * d.along.transpose();
    for (std::size_t j = 0; j < position_of.size(); ++j)
      slope[position_of[j]] += mode.weight * 2.0 * (std::conj(h) * dh[static_cast<Index>(j)]).real();
    slope += mode.weight * square * mode.slope;
  }
  double gain = 1.0;
  each_action(Primitive::channel_limit, map_.features().conditions[static_cast<std::size_t>(row.condition)],
              [&](const Candidate& candidate, const VectorXd& a, const ActionSpec& action) {
                if (candidate.channels[0] == row.channel) gain *= candidate.value(action.number.at("factor"), a);
              });
  const Index j = level_of(row.condition, false);
  const Nuisance& level = map_.nuisances_[static_cast<std::size_t>(j)];
  out_.g[at] = 0.5 * std::log(std::max(variance, 1e-300)) + std::log(gain) + level.deviation * base_.x[j];
  if (!with_jacobian_) return;
  out_.jacobian.row(at) = slope.transpose() / (2.0 * std::max(variance, 1e-300));
  out_.jacobian(at, j) = level.deviation;
  for (std::size_t k = 0; k < map_.nuisances_.size(); ++k) {
    const Nuisance& v = map_.nuisances_[k];
    if (v.kind == Nuisance::Kind::gain && v.index == row.channel)
      out_.jacobian(at, static_cast<Index>(k)) = v.deviation / (1.0 + v.deviation * base_.x[static_cast<Index>(k)]);
  }
}

void Predictor::predict_load(int c) {
  const auto& rows = map_.features().rows;
  const bool records =
      std::ranges::any_of(rows, [&](const Row& row) { return row.condition == c && row.type == RowType::rms; });
  SolvedState* state = records ? &solved(c) : nullptr;
  std::vector<ExcitedMode> excited;
  for (Index i = 0; records && i < state->modes.s.size(); ++i) excited.push_back(excited_mode(c, *state, i));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].condition != c) continue;
    if (rows[r].type == RowType::psd_floor) predict_floor(r);
    if (rows[r].type == RowType::rms) predict_rms(r, *state, excited);
  }
}

}  // namespace twindeck::diagnosis
