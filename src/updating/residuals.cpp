#include "updating/residuals.hpp"

#include <algorithm>

#include "sensitivity/channel_sensitivity.hpp"
#include "sensitivity/frequency_jacobian.hpp"

namespace twindeck::updating {

Eigen::VectorXd ResidualDefinition::theta(const Eigen::VectorXd& x) const {
  Eigen::VectorXd values = initial;
  for (std::size_t j = 0; j < active.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    values(active[j]) = x(at) * scale(at);
  }
  return values;
}

dynamics::EigenModes ResidualDefinition::modes_at(const Eigen::VectorXd& x, dynamics::ModalSolver& solver, int& solves) const {
  const Eigen::VectorXd values = theta(x);
  if (start && &solver.system() == start->system.get() && values == start->theta) return start->modes;
  ++solves;
  return solver.solve(values, n_modes);
}

double ResidualDefinition::residual_unit(const Eigen::MatrixXd& jacobian) const {
  const double norm = jacobian.norm();
  return weighted && norm > 0.0 ? norm : 1.0;
}

ModalResiduals::ModalResiduals(std::shared_ptr<const fe::ParametricSystem> system, const ResidualDefinition& definition)
    : system_(std::move(system)), definition_(definition), solver_(*system_) {}

const Evaluation& ModalResiduals::at(const Eigen::VectorXd& x, bool with_jacobian) {
  constexpr std::size_t kept_points = 8;
  auto known = std::ranges::find_if(cache_, [&](const Evaluation& e) { return e.x == x; });
  if (known == cache_.end()) {
    Evaluation fresh;
    fresh.x = x;
    solve(fresh);
    cache_.push_front(std::move(fresh));
    if (cache_.size() > kept_points) cache_.pop_back();
    known = cache_.begin();
  }
  if (with_jacobian && known->valid && known->jacobian.size() == 0) {
    differentiate(*known);
    Eigen::VectorXd rows(known->jacobian.rows());
    if (definition_.prior.given()) definition_.prior.append(x, rows, &known->jacobian);
  }
  return *known;
}

void ModalResiduals::find_modes(const Eigen::VectorXd& x) {
  modes_ = definition_.modes_at(x, solver_, solves_);
  modes_x_ = x;
}

void ModalResiduals::solve(Evaluation& evaluation) {
  find_modes(evaluation.x);
  if (!modes_.status.converged) return;
  const matching::FollowedModes followed = definition_.follower->follow(modes_.shapes);
  const auto n = static_cast<Eigen::Index>(definition_.targets.size());
  evaluation.residual.resize(n);
  evaluation.frequency_Hz.resize(n);
  evaluation.mac.resize(n);
  evaluation.mode.assign(definition_.targets.size(), -1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const FrequencyTarget& target = definition_.targets[static_cast<std::size_t>(i)];
    const int mode = followed.position[static_cast<std::size_t>(target.reference_mode)];
    if (mode < 0) return;
    evaluation.mode[static_cast<std::size_t>(i)] = mode;
    evaluation.mac(i) = followed.mac(target.reference_mode);
    evaluation.frequency_Hz(i) = modes_.frequency_Hz(mode);
    evaluation.residual(i) = target.fitted ? evaluation.frequency_Hz(i) / target.measured_Hz - 1.0 : 0.0;
  }
  evaluation.valid = !definition_.weighted || weigh(evaluation, followed.position);
  if (definition_.prior.given()) definition_.prior.append(evaluation.x, evaluation.residual, nullptr);
}

void ModalResiduals::differentiate(Evaluation& evaluation) {
  if (modes_x_ != evaluation.x) find_modes(evaluation.x);  // the modes of an older point are gone
  const Eigen::MatrixXd all = sensitivity::frequency_jacobian(*system_, definition_.theta(evaluation.x), modes_);
  if (definition_.weighted) return differentiate_weighted(evaluation, all);
  const auto n = static_cast<Eigen::Index>(definition_.targets.size());
  evaluation.jacobian.setZero(n, static_cast<Eigen::Index>(definition_.active.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto target = static_cast<std::size_t>(i);
    if (!definition_.targets[target].fitted) continue;
    for (std::size_t j = 0; j < definition_.active.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      evaluation.jacobian(i, column) = all(evaluation.mode[target], definition_.active[j]) * definition_.scale(column) /
                                       definition_.targets[target].measured_Hz;
    }
  }
}

namespace {

/// Shapes at the channels; empty where no shape is weighed.
Eigen::MatrixXd at_channels(const WeightedRows& rows, const Eigen::MatrixXd& shapes) {
  if (!rows.has_shapes()) return {};
  return rows.measured().channels.transpose() * shapes;
}

}  // namespace

bool ModalResiduals::weigh(Evaluation& evaluation, const std::vector<int>& position) {
  const WeightedRows& rows = *definition_.weighted;
  evaluation.span = rows.spans_at(position);
  if (rows.has_shapes() && evaluation.span.empty()) return false;
  static_cast<Linearised&>(evaluation) =
      rows.evaluate({evaluation.frequency_Hz, at_channels(rows, modes_.shapes), evaluation.span, {}, {}}, false);
  return true;
}

void ModalResiduals::differentiate_weighted(Evaluation& evaluation, const Eigen::MatrixXd& frequency_jacobian) {
  const WeightedRows& rows = *definition_.weighted;
  const Eigen::MatrixXd active = frequency_jacobian(evaluation.mode, definition_.active);
  ComputedRows computed{
      evaluation.frequency_Hz, at_channels(rows, modes_.shapes), evaluation.span, active * definition_.scale.asDiagonal(), {}};
  if (rows.has_shapes()) {
    // The adjoint solves serve all parameters, so leaving some out would save almost nothing.
    const std::vector<Eigen::MatrixXd> all =
        sensitivity::channel_shape_derivatives(*system_, definition_.theta(evaluation.x), modes_, rows.measured().channels);
    for (std::size_t j = 0; j < definition_.active.size(); ++j)
      computed.shape_slope.push_back(definition_.scale(static_cast<Eigen::Index>(j)) *
                                     all[static_cast<std::size_t>(definition_.active[j])]);
  }
  evaluation.jacobian = rows.evaluate(computed, true).jacobian;
}

}  // namespace twindeck::updating
