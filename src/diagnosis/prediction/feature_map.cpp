#include "diagnosis/prediction/feature_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "diagnosis/features/shape_turn.hpp"
#include "diagnosis/prediction/predictor.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
constexpr double kFree = std::numeric_limits<double>::infinity();
/// [prior deviations] Bound of element scatter and gains. A reversed sensor is a gain 140 deviations off; it must remain a
/// misfit and not be fitted.
constexpr double kWorst = 6.0;

/// [-] Error of a load-test row by the form of the model, over the largest value of its type and condition; fully correlated
/// for a channel under one load. Fitted models are 0.4 to 1.8 % off in frequency, up to about 3 % in flexibility.
constexpr double kStaticForm = 0.03;

constexpr double kCloseModes = 0.06;  ///< [-] relative gap of frequencies above which the errors of two shapes are independent
/// [rad] Rotation of two shapes by errors, times the relative gap of their frequencies: from errors of 1.5 % in a mode's part
/// of stiffness and mass.
constexpr double kTurnTimesGap = 0.015;
/// [rad] Largest rotation, however close two modes are. Above 45 degrees each shape resembles the other mode more and has its
/// name. A uniform law up to 45 degrees has the standard deviation pi / (4 sqrt 3).
constexpr double kLargestTurn = 0.25 * std::numbers::pi * std::numbers::inv_sqrt3;

}  // namespace

FeatureMap::FeatureMap(const ReducedModel& model, const FeatureSet& features, const ScatterOptions& scatter)
    : model_(model), features_(features), states_(states_of(features)), damping_by_dampers_(scatter.damping_by_dampers) {
  collect_modes();
  transform(scatter);
  list_nuisances(scatter);
}

void FeatureMap::collect_modes() {
  std::map<std::pair<int, std::string>, std::size_t> at;
  for (std::size_t r = 0; r < features_.rows.size(); ++r) {
    const Row& row = features_.rows[r];
    const bool modal = row.type == RowType::frequency || row.type == RowType::damping || row.type == RowType::shape ||
                       row.type == RowType::shape_imag;
    if (!modal) continue;
    const auto [where, is_new] = at.try_emplace({row.condition, row.mode}, modes_.size());
    if (is_new) {
      modes_.emplace_back();
      modes_.back().label = row.mode;
      modes_.back().condition = row.condition;
    }
    MeasuredMode& mode = modes_[where->second];
    const auto position = static_cast<int>(r);
    if (row.type == RowType::frequency) {
      mode.frequency = position;
      mode.frequency_Hz = row.value;
      highest_Hz_ = std::max(highest_Hz_, 1.6 * row.value);
    } else if (row.type == RowType::damping) {
      mode.damping = position;
    } else if (row.type == RowType::shape) {
      mode.real_rows.push_back(position);
      mode.real_channels.push_back(row.channel);
    } else {
      mode.imag_rows.push_back(position);
      mode.imag_channels.push_back(row.channel);
    }
  }
  // A far too stiff model has fewer modes below this frequency than were measured. Then as many of its modes as were measured
  // are used.
  std::map<int, Index> measured;
  Index most = 0;
  for (const MeasuredMode& mode : modes_) most = std::max(most, ++measured[mode.condition]);
  most = std::min(most, model_.frequency_Hz.size());
  if (highest_Hz_ > 0.0 && most > 0 && model_.frequency_Hz[most - 1] > highest_Hz_)
    highest_Hz_ = 1.01 * model_.frequency_Hz[most - 1];
  if (highest_Hz_ == 0.0) highest_Hz_ = 1.01 * model_.frequency_Hz[std::min<Index>(9, model_.frequency_Hz.size() - 1)];
  for (const MeasuredMode& mode : modes_)
    if (!mode.real_rows.empty()) n_scales_ += mode.imag_rows.empty() ? 1 : 2;
}

void FeatureMap::transform(const ScatterOptions& scatter) {
  const auto n = static_cast<Index>(features_.rows.size());
  values_.resize(n);
  Eigen::VectorXd slope = Eigen::VectorXd::Ones(n);  // d transformed / d value
  for (Index r = 0; r < n; ++r) {
    const Row& row = features_.rows[static_cast<std::size_t>(r)];
    values_[r] = is_logarithmic(row.type) ? std::log(row.value) : row.value;
    if (is_logarithmic(row.type)) slope[r] = 1.0 / row.value;
  }
  if (features_.covariance.size() > 0) {
    covariance_ = slope.asDiagonal() * features_.covariance * slope.asDiagonal();
  } else {
    covariance_ = Eigen::MatrixXd::Zero(n, n);
    for (Index r = 0; r < n; ++r) covariance_(r, r) = std::pow(features_.rows[static_cast<std::size_t>(r)].std * slope[r], 2);
  }
  covariance_ *= scatter.noise * scatter.noise;
  for (Index r = 0; r < n; ++r) {  // floors: identification is never better than this
    const RowType type = features_.rows[static_cast<std::size_t>(r)].type;
    double floor = 0.0;
    if (type == RowType::frequency) floor = scatter.frequency_floor;
    if (type == RowType::damping) floor = scatter.damping_floor;
    covariance_(r, r) = std::max(covariance_(r, r), floor * floor);
    if (type == RowType::rms) covariance_(r, r) += scatter.load_model * scatter.load_model;
  }
  for (const MeasuredMode& a : modes_)
    for (const MeasuredMode& b : modes_)
      if (a.frequency >= 0 && b.frequency >= 0 && a.label == b.label && same_state(a.condition, b.condition))
        covariance_(a.frequency, b.frequency) += scatter.model_form * scatter.model_form;
  add_static_form();
  for (const MeasuredMode& mode : modes_) {
    double largest = 0.0;
    for (const int r : mode.real_rows) largest = std::max(largest, std::abs(values_[r]));
    const double floor = std::pow(scatter.shape_floor * largest, 2);
    for (const auto* rows : {&mode.real_rows, &mode.imag_rows})
      for (const int r : *rows) covariance_(r, r) = std::max(covariance_(r, r), floor);
  }
  // Close modes: small changes rotate their shapes into each other, so that only their plane is known well.
  for (const MeasuredMode& a : modes_) {
    for (const MeasuredMode& b : modes_) {
      if (a.condition != b.condition || !(a.frequency_Hz < b.frequency_Hz)) continue;
      const double gap = b.frequency_Hz / a.frequency_Hz - 1.0;
      if (gap > kCloseModes || a.real_rows.empty() || b.real_rows.empty()) continue;
      const ShapeTurn turn = turn_of_shapes({a.real_rows, a.real_channels}, {b.real_rows, b.real_channels}, values_);
      const double variance = std::pow(std::min(kTurnTimesGap / gap, kLargestTurn), 2);
      covariance_ += variance * turn.together * turn.together.transpose();
      covariance_.diagonal() += variance * turn.alone.cwiseAbs2();
    }
  }
}

void FeatureMap::add_static_form() {
  std::map<std::pair<int, RowType>, double> largest;
  for (const Row& row : features_.rows)
    if (is_static(row.type)) {
      double& value = largest[{row.condition, row.type}];
      value = std::max(value, std::abs(row.value));
    }
  for (std::size_t a = 0; a < features_.rows.size(); ++a) {
    const Row& one = features_.rows[a];
    if (!is_static(one.type)) continue;
    for (std::size_t b = 0; b < features_.rows.size(); ++b) {
      const Row& other = features_.rows[b];
      const auto load_of_row = [&](const Row& row) { return features_.condition_of(row).load; };
      if (one.type != other.type || one.channel != other.channel || load_of_row(one) != load_of_row(other)) continue;
      covariance_(static_cast<Index>(a), static_cast<Index>(b)) +=
          kStaticForm * kStaticForm * largest.at({one.condition, one.type}) * largest.at({other.condition, other.type});
    }
  }
}

void FeatureMap::list_places(const ScatterOptions& scatter) {
  const auto add = [&](const std::string& set, bool mass, double deviation, auto has) {
    const auto found = model_.sets.find(set);
    if (found == model_.sets.end()) return;
    for (std::size_t i = 0; i < found->second.size(); ++i)
      if (const ReducedPlace& p = found->second[i]; has(p))
        nuisances_.push_back({Nuisance::Kind::place, static_cast<int>(i), p.id + (mass ? " mass" : " stiffness"), 0.0,
                              scatter.fine * deviation, -kWorst, kWorst, set, mass});
  };
  const auto any = [](const ReducedPlace&) { return true; };
  // A spring that replaces a rigid support has no meaningful size. Several bearings have an error each.
  const auto is_flexible = [](const ReducedPlace& p) {
    const auto high = p.attributes.find("f_high");
    return (high == p.attributes.end() || high->second > 1.0) && !p.attributes.contains(kSeveralBearings);
  };
  add("zones", false, scatter.element_stiffness, any);
  add("zones", true, scatter.element_mass, any);
  add("nodes", true, scatter.node_mass, [](const ReducedPlace& p) { return p.mass.size() > 0; });
  add("stays", false, scatter.stay_stiffness, any);
  add("supports", false, scatter.support_stiffness, is_flexible);
  add("foundations", false, scatter.support_stiffness, is_flexible);
}

void FeatureMap::list_nuisances(const ScatterOptions& scatter) {
  const auto add = [&](Nuisance::Kind kind, int index, const std::string& name, double mean, double deviation,
                       double lower = -kWorst, double upper = kWorst) {
    nuisances_.push_back({kind, index, name, mean, deviation, lower, upper});
  };
  for (std::size_t p = 0; p < model_.parameters.size(); ++p) {
    const fe::Parameter& parameter = model_.parameters[p];
    const double deviation = 0.25 * (parameter.upper - parameter.lower);
    if (!(deviation > 0.0)) continue;
    // Step 6 may have fitted the value to these very data, which must not serve as the prior too.
    const double mean = parameter.nominal.value_or(model_.theta[static_cast<Index>(p)]);
    add(Nuisance::Kind::parameter, static_cast<int>(p), parameter.name, mean, deviation, (parameter.lower - mean) / deviation,
        (parameter.upper - mean) / deviation);
  }
  list_places(scatter);
  std::set<std::string> stay_rows;
  for (const Row& row : features_.rows)
    if (row.type == RowType::stay_frequency) stay_rows.insert("stay:" + row.stay);
  if (const auto stays = model_.sets.find("stays"); stays != model_.sets.end())
    for (std::size_t i = 0; i < stays->second.size(); ++i)
      if (const std::string& id = stays->second[i].id; stay_rows.contains(id))
        add(Nuisance::Kind::stay_pull, static_cast<int>(i), id + " pull", 0.0, scatter.stay_pull);
  std::map<int, bool> channels;
  std::map<int, bool> levels;
  for (const Row& row : features_.rows) {
    if (row.channel >= 0 && row.type != RowType::psd_floor) channels[row.channel] = true;
    if (row.type == RowType::rms || row.type == RowType::psd_floor)
      levels[2 * row.condition + (row.type == RowType::psd_floor ? 1 : 0)] = true;
    const std::string own = damping_name(row.mode, row.condition);
    if (row.type == RowType::damping && !contains(damping_modes_, own)) damping_modes_.push_back(own);
  }
  for (const auto& [channel, used] : channels)
    add(Nuisance::Kind::gain, channel, "channel:" + features_.channels[static_cast<std::size_t>(channel)] + " gain", 0.0,
        scatter.fine * scatter.gain);
  for (std::size_t i = 0; i < damping_modes_.size(); ++i)  // prior of ln zeta around 0.5 %, a factor e wide
    add(Nuisance::Kind::mode_damping, static_cast<int>(i), "mode " + damping_modes_[i] + " structural damping", std::log(0.5),
        1.0, -kFree, kFree);
  for (const auto& [level, used] : levels) {
    const Condition& condition = features_.conditions[static_cast<std::size_t>(level / 2)];
    add(Nuisance::Kind::level, level, condition.name + (level % 2 ? " noise level" : " load level"), 0.0, 10.0, -kFree, kFree);
  }
  standing_ = Eigen::VectorXd::Zero(std::ssize(nuisances_));
  for (std::size_t j = 0; j < nuisances_.size(); ++j)
    if (const Nuisance& v = nuisances_[j]; v.kind == Nuisance::Kind::parameter)
      standing_[static_cast<Index>(j)] = (model_.theta[v.index] - v.mean) / v.deviation;
}

bool FeatureMap::same_state(int a, int b) const {
  return features_.conditions[static_cast<std::size_t>(a)].state == features_.conditions[static_cast<std::size_t>(b)].state;
}

std::string FeatureMap::damping_name(const std::string& label, int condition) const {
  const Condition& c = features_.conditions[static_cast<std::size_t>(condition)];
  std::string name = label;
  if (c.state != states_.front()) name += " of state " + c.state;
  if (damping_by_dampers_ && c.dampers_on.value_or(false)) name += " with dampers";
  return name;
}

void FeatureMap::set_values(const Eigen::VectorXd& values) {
  TWINDECK_ASSERT(values.size() == values_.size());
  values_ = values;
  for (std::size_t r = 0; r < features_.rows.size(); ++r) {
    Row& row = features_.rows[r];
    const double value = is_logarithmic(row.type) ? std::exp(values[static_cast<Index>(r)]) : values[static_cast<Index>(r)];
    if (is_logarithmic(row.type)) row.std *= value / row.value;  // deviations are relative there
    row.value = value;
  }
  for (MeasuredMode& mode : modes_)
    if (mode.frequency >= 0) mode.frequency_Hz = std::exp(values_[mode.frequency]);
}

const ReducedPlace& FeatureMap::place_of(const Nuisance& v) const {
  return model_.sets.at(v.set)[static_cast<std::size_t>(v.index)];
}

const ReducedMatrix& FeatureMap::scattered(const Nuisance& v) const {
  return v.of_mass ? place_of(v).mass : place_of(v).stiffness;
}

FeatureMap::Base FeatureMap::base(const Eigen::VectorXd& x) const {
  Base base;
  base.x = x;
  base.theta = model_.theta;
  base.store = std::make_shared<StateStore>();
  for (std::size_t j = 0; j < nuisances_.size(); ++j) {
    const Nuisance& v = nuisances_[j];
    if (v.kind == Nuisance::Kind::parameter) base.theta[v.index] = v.mean + v.deviation * x[static_cast<Index>(j)];
  }
  for (const auto& term : model_.stiffness) base.stiffness_parts.emplace_back(term.coefficient.value(base.theta), &term.matrix);
  for (const auto& term : model_.mass) base.mass_parts.emplace_back(term.coefficient.value(base.theta), &term.matrix);
  for (std::size_t j = 0; j < nuisances_.size(); ++j) {
    const Nuisance& v = nuisances_[j];
    const double amount = v.deviation * x[static_cast<Index>(j)];
    if (amount == 0.0) continue;
    if (v.kind != Nuisance::Kind::place) continue;
    (v.of_mass ? base.mass_parts : base.stiffness_parts).emplace_back(amount, &scattered(v));
  }
  const Index c = model_.common;
  const auto sum = [c](const std::vector<Base::Part>& parts) {  // symmetric: reading half of the entries takes half the time
    Eigen::MatrixXd total = Eigen::MatrixXd::Zero(c, c);
    for (const auto& [amount, matrix] : parts)
      for (Index j = 0; j < c; ++j) total.col(j).head(j + 1) += amount * matrix->common().col(j).head(j + 1);
    total.triangularView<Eigen::StrictlyLower>() = total.transpose();
    return total;
  };
  base.common_stiffness = sum(base.stiffness_parts);
  base.common_mass = sum(base.mass_parts);
  return base;
}

/// Columns after the common ones of a sum of the reduced model's matrices (n × n_own).
Eigen::MatrixXd own_columns(const std::vector<FeatureMap::Base::Part>& parts, const std::vector<int>& columns) {
  const ReducedBasis& basis = parts.front().second->basis();
  const Index n = std::ssize(columns), c = basis.common();
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(n, n - c);
  Eigen::MatrixXd own, force;  // of all local matrices together, which are projected once
  for (const auto& [amount, matrix] : parts) {
    if (!matrix->is_local()) {
      matrix->add_own(amount, columns, total);
      continue;
    }
    if (own.size() == 0) {
      own = basis.own(columns);
      force = Eigen::MatrixXd::Zero(own.rows(), own.cols());
    }
    matrix->add_image(amount, own, force);
  }
  if (force.size() > 0) total += basis.projected(own, force);
  return total;
}

Eigen::VectorXd change_between(const Prediction& from, const Prediction& to) {
  Eigen::VectorXd change = to.g - from.g;
  for (const Prediction* p : {&from, &to}) change(p->open).setZero();
  return change;
}

std::pair<Eigen::MatrixXd, Eigen::MatrixXd> FeatureMap::matrices(const Base& base, const std::vector<int>& columns) const {
  const Index n = std::ssize(columns), c = model_.common;
  TWINDECK_ASSERT(n >= c && (c == 0 || columns[static_cast<std::size_t>(c) - 1] == c - 1));
  if (n == c) return {base.common_stiffness, base.common_mass};
  const StateStore::OwnColumns* own = base.store->own_columns(columns, [&] {
    return StateStore::OwnColumns{own_columns(base.stiffness_parts, columns), own_columns(base.mass_parts, columns)};
  });
  const auto assemble = [&](const Eigen::MatrixXd& common, const Eigen::MatrixXd& others) {
    Eigen::MatrixXd total(n, n);
    total.topLeftCorner(c, c) = common;
    total.rightCols(n - c) = others;
    total.bottomLeftCorner(n - c, c) = others.topRows(c).transpose();
    return total;
  };
  return {assemble(base.common_stiffness, own->stiffness), assemble(base.common_mass, own->mass)};
}

}  // namespace twindeck::diagnosis
