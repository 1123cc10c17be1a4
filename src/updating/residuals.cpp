#include "updating/residuals.hpp"

#include <algorithm>

#include "sensitivity/eigen_sensitivity.hpp"

namespace twindeck::updating {

Eigen::VectorXd ResidualDefinition::theta(const Eigen::VectorXd& x) const {
  Eigen::VectorXd values = initial;
  for (std::size_t j = 0; j < active.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    values(active[j]) = x(at) * scale(at);
  }
  return values;
}

FrequencyResiduals::FrequencyResiduals(std::shared_ptr<const fe::ParametricSystem> system, const ResidualDefinition& definition)
    : system_(std::move(system)), definition_(definition), solver_(*system_) {}

const Evaluation& FrequencyResiduals::at(const Eigen::VectorXd& x, bool with_jacobian) {
  constexpr std::size_t kept_points = 8;
  auto known = std::find_if(cache_.begin(), cache_.end(), [&](const Evaluation& e) { return e.x == x; });
  if (known == cache_.end()) {
    Evaluation fresh;
    fresh.x = x;
    solve(fresh);
    cache_.push_front(std::move(fresh));
    if (cache_.size() > kept_points) cache_.pop_back();
    known = cache_.begin();
  }
  if (with_jacobian && known->valid && known->jacobian.size() == 0) differentiate(*known);
  return *known;
}

void FrequencyResiduals::solve(Evaluation& evaluation) {
  modes_ = solver_.solve(definition_.theta(evaluation.x), definition_.n_modes);
  modes_x_ = evaluation.x;
  ++solves_;
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
  evaluation.valid = true;
}

void FrequencyResiduals::differentiate(Evaluation& evaluation) {
  if (modes_x_ != evaluation.x) {  // the modes of an older point are gone
    modes_ = solver_.solve(definition_.theta(evaluation.x), definition_.n_modes);
    modes_x_ = evaluation.x;
    ++solves_;
  }
  const Eigen::MatrixXd all = sensitivity::frequency_jacobian(*system_, definition_.theta(evaluation.x), modes_);
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

}  // namespace twindeck::updating
