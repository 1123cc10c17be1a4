#include "diagnosis/features/load_tests.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

LoadTests projected(const LoadTests& tests, const MatrixXd& v) {
  LoadTests out = tests;
  if (tests.empty()) return out;
  const MatrixXd vt = v.transpose();
  out.force = vt * tests.force;
  for (Ground& ground : out.grounds) {
    ground.settle = vt * ground.settle;
    ground.moved = vt * ground.moved;
  }
  out.rotation = tests.rotation * v;
  out.strain = tests.strain * v;
  for (ForceGauge& gauge : out.forces)
    if (gauge.ground >= 0) gauge.pull = vt * gauge.pull;
  return out;
}

MatrixXd loads_to_answer(const LoadTests& tests) {
  std::vector<VectorXd> loads;
  const auto add = [&](const VectorXd& load) {
    if (load.size() > 0 && load.squaredNorm() > 0.0) loads.push_back(load);
  };
  for (Index c = 0; c < tests.force.cols(); ++c) add(tests.force.col(c));
  for (const Ground& ground : tests.grounds) {
    add(ground.settle);
    for (Index c = 0; c < ground.moved.cols(); ++c) add(ground.moved.col(c));
  }
  for (const ForceGauge& gauge : tests.forces) add(gauge.pull);
  MatrixXd out(tests.force.rows(), static_cast<Index>(loads.size()));
  for (std::size_t i = 0; i < loads.size(); ++i) out.col(static_cast<Index>(i)) = loads[i];
  return out;
}

VectorXd load_of(const LoadTests& tests, Index load_case, const std::vector<GroundState>& states) {
  VectorXd load = tests.force.col(load_case);
  for (std::size_t g = 0; g < states.size(); ++g)
    load += states[g].factor * (tests.grounds[g].moved.col(load_case) + states[g].settled_m * tests.grounds[g].settle);
  return load;
}

double force_of(const LoadTests& tests, Index channel, Index load_case, const std::vector<GroundState>& states,
                const VectorXd& q) {
  const ForceGauge& gauge = tests.forces[static_cast<std::size_t>(channel)];
  const GroundState& state = states[static_cast<std::size_t>(gauge.ground)];
  return state.factor * (gauge.moved[load_case] + state.settled_m * gauge.settle - gauge.pull.dot(q));
}

}  // namespace twindeck::diagnosis
