#include "steps/validation/full_model_history.hpp"

#include "linalg/cholesky.hpp"
#include "steps/aerodynamics/aerodynamics.hpp"

namespace twindeck::steps {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RayleighDamping RayleighDamping::with_ratio(double ratio, double omega1, double omega2) {
  return {2.0 * ratio * omega1 * omega2 / (omega1 + omega2), 2.0 * ratio / (omega1 + omega2)};
}

namespace {

/// Adds factor d d' to a lower triangle; d has few entries.
void add_outer(std::vector<Eigen::Triplet<double>>& entries, const VectorXd& d, double factor) {
  std::vector<int> rows;
  for (Index i = 0; i < d.size(); ++i) {
    if (d[i] != 0.0) rows.push_back(static_cast<int>(i));
  }
  for (const int i : rows) {
    for (const int j : rows) {
      if (i >= j) entries.emplace_back(i, j, factor * d[i] * d[j]);
    }
  }
}

}  // namespace

MatrixXd full_model_history(const LoadedModel& loaded, const std::vector<const fe::Spring*>& dampers,
                            const RayleighDamping& damping, const Eigen::Ref<const MatrixXd>& patterns,
                            const Eigen::Ref<const MatrixXd>& amplitude, const Eigen::Ref<const MatrixXd>& observed,
                            double step_s) {
  const linalg::SparseMatrix k = loaded.system.stiffness(loaded.theta), m = loaded.system.mass(loaded.theta);
  const MatrixXd direction = damper_patterns(loaded, dampers);
  const double dt = step_s, quarter = 0.25 * dt * dt;

  // M + dt/2 C + dt²/4 K, with each damper as what it is within a step.
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd within(static_cast<Index>(dampers.size()));  // stiffness of a damper within a step
  for (std::size_t j = 0; j < dampers.size(); ++j) {
    const auto at = static_cast<Index>(j);
    const double dashpot = 2.0 * dampers[j]->damping / dt, spring = dampers[j]->stiffness;
    within[at] = dampers[j]->series ? spring * dashpot / (spring + dashpot) : dashpot + spring;
    add_outer(entries, direction.col(at), quarter * within[at]);
  }
  linalg::SparseMatrix extra(k.rows(), k.cols());
  extra.setFromTriplets(entries.begin(), entries.end());
  const double mass_part = 1.0 + 0.5 * dt * damping.mass_part, stiffness_part = quarter + 0.5 * dt * damping.stiffness_part;
  linalg::SparseMatrix effective = mass_part * m + stiffness_part * k;
  effective += extra;
  linalg::Cholesky factor;
  const Status status = factor.factorize(effective);
  TWINDECK_ASSERT(status.converged);

  const auto mass = m.selfadjointView<Eigen::Lower>();
  const auto stiffness = k.selfadjointView<Eigen::Lower>();
  VectorXd q = VectorXd::Zero(k.rows()), v = q, a = q;
  VectorXd x = VectorXd::Zero(within.size()), xv = x, s = x, sv = x;  // dampers: elongation and its rate, Maxwell's inner point
  MatrixXd out = MatrixXd::Zero(observed.rows(), amplitude.cols());
  for (Index i = 1; i < amplitude.cols(); ++i) {
    q += dt * v + quarter * a;  // predictors
    v += 0.5 * dt * a;
    VectorXd right = patterns * amplitude.col(i);
    right -= damping.mass_part * VectorXd(mass * v);
    right -= stiffness * VectorXd(q + damping.stiffness_part * v);
    const VectorXd xq = direction.transpose() * q, xp = direction.transpose() * v;
    VectorXd force(within.size());  // of the dampers at the predicted motion
    for (Index j = 0; j < force.size(); ++j) {
      const fe::Spring& damper = *dampers[static_cast<std::size_t>(j)];
      const double dashpot = 2.0 * damper.damping / dt;
      force[j] = damper.series ? within[j] * xq[j] - damper.stiffness / (damper.stiffness + dashpot) * damper.damping *
                                                         (2.0 / dt * s[j] + sv[j])
                               : damper.damping * xp[j] + damper.stiffness * xq[j];
    }
    right -= direction * force;
    a = factor.solve(right);
    q += quarter * a;
    v += 0.5 * dt * a;
    x = direction.transpose() * q;
    xv = direction.transpose() * v;
    for (Index j = 0; j < force.size(); ++j) {
      const fe::Spring& damper = *dampers[static_cast<std::size_t>(j)];
      if (!damper.series) continue;
      const double dashpot = 2.0 * damper.damping / dt;
      const double next = (damper.stiffness * x[j] + damper.damping * (2.0 / dt * s[j] + sv[j])) / (damper.stiffness + dashpot);
      sv[j] = 2.0 / dt * (next - s[j]) - sv[j];
      s[j] = next;
    }
    out.col(i) = observed * a;
  }
  return out;
}

}  // namespace twindeck::steps
