#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.hpp"
#include "diagnosis/predictor.hpp"

/// Rows of load tests: K u = f in the state that a condition is of, and what its channels show of u.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Whether the force of a support is measured in a condition.
bool support_is_gauged(const FeatureSet& features, const LoadTests& tests, int condition, int ground) {
  return std::any_of(features.rows.begin(), features.rows.end(), [&](const Row& row) {
    return row.type == RowType::static_force && row.condition == condition &&
           tests.forces[static_cast<std::size_t>(row.channel)].ground == ground;
  });
}

}  // namespace

void Predictor::predict_load_tests(int c) {
  const FeatureSet& features = map_.features();
  const Condition& condition = features.conditions[static_cast<std::size_t>(c)];
  const LoadTests& tests = map_.model().load_tests;
  const auto named = std::find(tests.cases.begin(), tests.cases.end(), condition.load);
  TWINDECK_ASSERT(named != tests.cases.end());
  const auto load_case = static_cast<Index>(named - tests.cases.begin());

  // What the ground does here, and how its springs follow parameters.
  std::vector<GroundState> ground(tests.grounds.size());
  bool moved_away = false;
  for (std::size_t g = 0; g < ground.size(); ++g) {
    const Ground& support = tests.grounds[g];
    if (support.parameter >= 0 && map_.model().theta[support.parameter] != 0.0)
      ground[g].factor = base_.theta[support.parameter] / map_.model().theta[support.parameter];
    for (const Cause& cause : causes_) {
      const Candidate& candidate = *cause.candidate;
      if (candidate.location != support.support || !candidate.acts_in(condition)) continue;
      for (const ActionSpec& action : candidate.hypothesis->actions) {
        if (candidate.hypothesis->set == "supports") ground[g].factor += stiffness_change(cause, action, condition);
        if (action.kind == "support.settle") ground[g].settled_m += candidate.value(action.number.at("rise"), cause.a);
        if (action.kind == "support.move")
          moved_away = moved_away || support_is_gauged(features, tests, c, static_cast<int>(g));
      }
    }
  }
  if (moved_away) {
    out_.valid = false;  // its gauge stands elsewhere too, and nobody has said where
    return;
  }

  SolvedState& state = solved(c);
  const auto n = static_cast<Index>(state.columns.size()), size = state.state.stiffness.rows();
  VectorXd load = VectorXd::Zero(size);
  load.head(n) = load_of(tests, load_case, ground)(state.columns);
  const Eigen::LLT<MatrixXd> factor(state.state.stiffness);
  if (factor.info() != Eigen::Success) {
    out_.valid = false;  // a structure that falls shows nothing
    return;
  }
  const VectorXd answer = factor.solve(load);
  VectorXd q = VectorXd::Zero(map_.model().size());
  q(state.columns) = answer.head(n);

  // Derivatives: K dq = df - dK q, f with the springs of supports that a parameter scales.
  const Index unknowns = with_jacobian_ ? static_cast<Index>(map_.nuisances().size()) : 0;
  MatrixXd loads = MatrixXd::Zero(size, unknowns), relative = MatrixXd::Zero(static_cast<Index>(ground.size()), unknowns);
  for (Index j = 0; j < unknowns; ++j) {
    const Nuisance& v = map_.nuisances()[static_cast<std::size_t>(j)];
    if (v.kind != Nuisance::Kind::parameter) continue;
    for (std::size_t g = 0; g < ground.size(); ++g) {
      if (tests.grounds[g].parameter != v.index || !(map_.model().theta[v.index] != 0.0)) continue;
      const double slope = v.deviation / map_.model().theta[v.index];
      relative(static_cast<Index>(g), j) = slope;
      const VectorXd held = tests.grounds[g].moved.col(load_case) + ground[g].settled_m * tests.grounds[g].settle;
      loads.col(j).head(n) += slope * held(state.columns);
    }
  }
  if (with_jacobian_) {  // without it the base's store is read by several threads, and `changes` may write to it
    const auto& change = changes(state);
    for (std::size_t k = 0; k < change.position.size(); ++k)
      if (change.stiffness[k].size() > 0) loads.col(change.position[k]) -= change.stiffness[k] * answer;
  }
  const MatrixXd slopes = factor.solve(loads);

  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    const Row& row = features.rows[r];
    if (row.condition != c || !is_static(row.type)) continue;
    const auto at = static_cast<Index>(r);
    const double gain = channel_factor_[row.channel];
    RowVectorXd shown;  // d row / d q
    double value = 0.0;
    VectorXd direct = VectorXd::Zero(unknowns);  // beside what q does
    if (row.type == RowType::static_force) {
      const ForceGauge& gauge = tests.forces[static_cast<std::size_t>(row.channel)];
      const GroundState& here = ground[static_cast<std::size_t>(gauge.ground)];
      shown = -here.factor * gauge.pull.transpose();
      value = force_of(tests, row.channel, load_case, ground, q);
      if (here.factor != 0.0) direct = value / here.factor * relative.row(gauge.ground).transpose();
    } else {
      shown = row.type == RowType::static_displacement ? RowVectorXd(channel_rows_.row(row.channel))
              : row.type == RowType::static_rotation   ? RowVectorXd(tests.rotation.row(row.channel))
                                                       : RowVectorXd(tests.strain.row(row.channel));
      value = shown.dot(q);
    }
    out_.g[at] = gain * value;
    if (!with_jacobian_) continue;
    out_.jacobian.row(at) += gain * (shown(state.columns) * slopes.topRows(n) + direct.transpose());
    for (Index j = 0; j < unknowns; ++j) {
      const Nuisance& v = map_.nuisances()[static_cast<std::size_t>(j)];
      if (v.kind == Nuisance::Kind::gain && v.index == row.channel)
        out_.jacobian(at, j) += v.deviation * out_.g[at] / (1.0 + v.deviation * base_.x[j]);
    }
  }
}

}  // namespace twindeck::diagnosis
