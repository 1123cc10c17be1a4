#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.hpp"
#include "diagnosis/prediction/predictor.hpp"

/// Rows of load tests: K u = f in the state of a condition, and the values of u at the channels.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Whether the force of a support is measured in a condition.
bool support_is_gauged(const FeatureSet& features, const LoadTests& tests, int condition, int ground) {
  return std::ranges::any_of(features.rows, [&](const Row& row) {
    return row.type == RowType::static_force && row.condition == condition &&
           tests.forces[static_cast<std::size_t>(row.channel)].ground == ground;
  });
}

}  // namespace

/// A solved load test: K q = f, and the derivatives of q and of the ground with respect to the nuisance parameters.
struct Predictor::SolvedLoadTest {
  Index load_case;
  std::vector<GroundState> ground;
  const SolvedState* state = nullptr;
  VectorXd answer, q;  ///< response in the state's columns and own degrees of freedom; in all columns of the reduced model
  MatrixXd slopes, relative;  ///< d answer (size × unknowns); d factor of a ground (n_grounds × unknowns)
};

bool Predictor::ground_of(const Condition& condition, int c, std::vector<GroundState>& ground) const {
  const LoadTests& tests = map_.model().load_tests;
  ground.resize(tests.grounds.size());
  bool moved_away = false;
  for (std::size_t g = 0; g < ground.size(); ++g) {
    const Ground& support = tests.grounds[g];
    double change = 0.0;
    if (support.parameter >= 0 && map_.model().theta[support.parameter] != 0.0)
      ground[g].factor = base_.theta[support.parameter] / map_.model().theta[support.parameter];
    for (const Cause& cause : causes_) {
      const Candidate& candidate = *cause.candidate;
      if (candidate.location != support.support || !candidate.acts_in(condition)) continue;
      for (const ActionSpec& action : candidate.hypothesis->actions) {
        if (candidate.hypothesis->set == "supports") change += stiffness_change(cause, action, condition);
        if (action.primitive == Primitive::support_settle)
          ground[g].settled_m += candidate.value(action.number.at("rise"), cause.a);
        if (action.primitive == Primitive::support_move)
          moved_away = moved_away || support_is_gauged(map_.features(), tests, c, static_cast<int>(g));
      }
    }
    ground[g].factor *= 1.0 + change;  // on top of the parameter's factor
  }
  return !moved_away;
}

MatrixXd Predictor::load_slopes(SolvedLoadTest& test) {
  const LoadTests& tests = map_.model().load_tests;
  const SolvedState& state = *test.state;
  const auto n = static_cast<Index>(state.columns.size()), size = state.state.stiffness.rows();
  const Index unknowns = with_jacobian_ ? static_cast<Index>(map_.nuisances().size()) : 0;
  MatrixXd loads = MatrixXd::Zero(size, unknowns);
  test.relative = MatrixXd::Zero(static_cast<Index>(test.ground.size()), unknowns);
  for (Index j = 0; j < unknowns; ++j) {
    const Nuisance& v = map_.nuisances()[static_cast<std::size_t>(j)];
    if (v.kind != Nuisance::Kind::parameter) continue;
    for (std::size_t g = 0; g < test.ground.size(); ++g) {
      if (tests.grounds[g].parameter != v.index || map_.model().theta[v.index] == 0.0 || base_.theta[v.index] == 0.0) continue;
      const double slope = v.deviation * test.ground[g].factor / base_.theta[v.index];
      test.relative(static_cast<Index>(g), j) = slope;
      const VectorXd held = tests.grounds[g].moved.col(test.load_case) + test.ground[g].settled_m * tests.grounds[g].settle;
      loads.col(j).head(n) += slope * held(state.columns);
    }
  }
  if (with_jacobian_) {  // otherwise several threads read the base's store, and `changes` may write to it
    const auto& change = changes(state);
    Moved moved;
    const MatrixXd held = changed(state, false, test.answer, moved);
    for (std::size_t k = 0; k < change.position.size(); ++k) loads.col(change.position[k]) -= held.col(static_cast<Index>(k));
  }
  return loads;
}

void Predictor::predict_load_tests(int c) {
  const FeatureSet& features = map_.features();
  const Condition& condition = features.conditions[static_cast<std::size_t>(c)];
  const LoadTests& tests = map_.model().load_tests;
  const auto named = std::ranges::find(tests.cases, condition.load);
  TWINDECK_ASSERT(named != tests.cases.end());
  SolvedLoadTest test;
  test.load_case = static_cast<Index>(named - tests.cases.begin());
  if (!ground_of(condition, c, test.ground)) {
    out_.valid = false;  // a moved support has its gauge elsewhere, at an unknown position
    return;
  }
  const SolvedState& state = solved(c);
  test.state = &state;
  const auto n = static_cast<Index>(state.columns.size()), size = state.state.stiffness.rows();
  VectorXd load = VectorXd::Zero(size);
  load.head(n) = load_of(tests, test.load_case, test.ground)(state.columns);
  const Eigen::LLT<MatrixXd> factor(state.state.stiffness);
  if (factor.info() != Eigen::Success) {
    out_.valid = false;  // an unstable structure has no response
    return;
  }
  test.answer = factor.solve(load);
  test.q = VectorXd::Zero(map_.model().size());
  test.q(state.columns) = test.answer.head(n);
  test.slopes = load_slopes(test);
  if (test.slopes.size() > 0) test.slopes = factor.solve(test.slopes).eval();  // there may be no unknowns
  for (std::size_t r = 0; r < features.rows.size(); ++r)
    if (features.rows[r].condition == c && is_static(features.rows[r].type)) predict_static_row(test, r);
}

void Predictor::predict_static_row(const SolvedLoadTest& test, std::size_t r) {
  const LoadTests& tests = map_.model().load_tests;
  const Row& row = map_.features().rows[r];
  const auto at = static_cast<Index>(r);
  const double gain = reading(row.condition).factor[row.channel];
  const Index unknowns = test.slopes.cols();
  const std::vector<int>& columns = test.state->columns;
  RowVectorXd shown;  // d row / d q in the state's columns
  double value = 0.0;
  VectorXd direct = VectorXd::Zero(unknowns);  // part that does not depend on q
  if (row.type == RowType::static_force) {
    const ForceGauge& gauge = tests.forces[static_cast<std::size_t>(row.channel)];
    const GroundState& here = test.ground[static_cast<std::size_t>(gauge.ground)];
    shown = -here.factor * gauge.pull(columns).transpose();
    value = force_of(tests, row.channel, test.load_case, test.ground, test.q);
    if (here.factor != 0.0) direct = value / here.factor * test.relative.row(gauge.ground).transpose();
  } else {
    shown = row.type == RowType::static_displacement
                ? RowVectorXd(channel_rows(reading(row.condition), columns).row(row.channel))
            : row.type == RowType::static_rotation ? RowVectorXd(tests.rotation.row(row.channel)(columns))
                                                   : RowVectorXd(tests.strain.row(row.channel)(columns));
    value = shown.dot(test.answer.head(std::ssize(columns)));
  }
  out_.g[at] = gain * value;
  if (!with_jacobian_) return;
  out_.jacobian.row(at) += gain * (shown * test.slopes.topRows(std::ssize(columns)) + direct.transpose());
  for (Index j = 0; j < unknowns; ++j) {
    const Nuisance& v = map_.nuisances()[static_cast<std::size_t>(j)];
    if (v.kind == Nuisance::Kind::gain && v.index == row.channel)
      out_.jacobian(at, j) += v.deviation * out_.g[at] / (1.0 + v.deviation * base_.x[j]);
  }
}

}  // namespace twindeck::diagnosis
