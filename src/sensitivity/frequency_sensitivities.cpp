#include "sensitivity/frequency_sensitivities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "matching/mode_following.hpp"
#include "sensitivity/frequency_jacobian.hpp"

namespace twindeck::sensitivity {
namespace {

// Step that changes the most sensitive frequency by `frequency_change`. The step is small enough for close modes. For a
// parameter that hardly matters it is large enough to stand above rounding.
double central_step(const Sensitivities& known, const Eigen::MatrixXd& relative, int parameter,
                    const SensitivityOptions& options) {
  const double strongest = relative.col(parameter).cwiseAbs().maxCoeff();
  const double step = strongest > 0.0 ? options.frequency_change / strongest : options.largest_central_step;
  return std::min(step, options.largest_central_step) * known.scale(parameter);
}

Status differentiate(const fe::ParametricSystem& system, const matching::ModeFollower& follower, int n_solved, int parameter,
                     double central, const SensitivityOptions& options, Sensitivities& out) {
  dynamics::ModalSolver solver(system);
  Status status;
  const auto frequencies = [&](double change) -> Eigen::VectorXd {
    Eigen::VectorXd theta = out.theta, frequency(n_solved);
    theta(parameter) += change;
    const dynamics::EigenModes modes = solver.solve(theta, n_solved);
    if (!modes.status.converged) {
      if (status.converged) status = modes.status;
      return frequency.setConstant(std::nan(""));
    }
    const matching::FollowedModes followed = follower.follow(modes.shapes);
    for (int i = 0; i < n_solved; ++i) frequency(i) = modes.frequency_Hz(followed.position[static_cast<std::size_t>(i)]);
    return frequency;
  };
  const auto n = out.frequency_Hz.size();
  const auto slope = [&](double h) -> Eigen::VectorXd { return ((frequencies(h) - frequencies(-h)) / (2.0 * h)).head(n); };
  const Eigen::VectorXd whole = slope(central), half = slope(0.5 * central);
  out.richardson.col(parameter) = (4.0 * half - whole) / 3.0;
  const double dp = options.forward_step * out.scale(parameter);
  out.forward.col(parameter) = (frequencies(dp).head(n) - out.frequency_Hz) / dp;
  return status;
}

}  // namespace

Eigen::MatrixXd Sensitivities::relative() const {
  return frequency_Hz.cwiseInverse().asDiagonal() * exact * scale.asDiagonal();
}

Sensitivities frequency_sensitivities(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                      const SensitivityOptions& options, const std::function<void(int, int)>& progress) {
  const auto n_parameters = static_cast<int>(system.parameters.size());
  Sensitivities out;
  out.theta = theta;
  out.scale.resize(n_parameters);
  for (int p = 0; p < n_parameters; ++p) {
    const fe::Parameter& parameter = system.parameters[static_cast<std::size_t>(p)];
    out.scale(p) = theta(p) != 0.0 ? std::abs(theta(p)) : std::max(parameter.upper - parameter.lower, 1e-12);
  }

  // Three modes more than shown are solved for, so that a mode raised by a step is still among them.
  int n_solved = std::min(options.n_modes + 3, static_cast<int>(system.size()));
  dynamics::ModalSolver solver(system);
  dynamics::EigenModes modes = solver.solve(theta, n_solved);
  const auto found = static_cast<int>(modes.frequency_Hz.size());
  if (!modes.status.converged && found > 0 && found < n_solved) {  // a small structure with fewer modes than asked for
    n_solved = found;
    modes = solver.solve(theta, n_solved);
  }
  out.status = modes.status;
  if (!modes.status.converged) return out;
  const int n_modes = std::min(options.n_modes, n_solved);
  out.frequency_Hz = modes.frequency_Hz.head(n_modes);
  out.exact = sensitivity::frequency_jacobian(system, theta, modes).topRows(n_modes);
  out.richardson = out.forward = Eigen::MatrixXd::Zero(n_modes, n_parameters);
  const matching::ModeFollower follower(solver.mass(), modes);
  const Eigen::MatrixXd relative = out.relative();

  std::vector<Status> of_parameter(static_cast<std::size_t>(n_parameters));
  parallel_for_told(
      n_parameters,
      [&](int p) {
        of_parameter[static_cast<std::size_t>(p)] =
            differentiate(system, follower, n_solved, p, central_step(out, relative, p, options), options, out);
      },
      [&](int done, int of) {
        if (progress) progress(done, of);
      });
  for (const Status& status : of_parameter) {
    if (!status.converged && out.status.converged) out.status = status;
  }
  return out;
}

void refuse_rigid_bodies(const Sensitivities& found, const std::string& source) {
  const auto rigid = (found.frequency_Hz.array() == 0.0).count();
  if (rigid == 0) return;
  throw InputError(
      {source, 0, "frequency_Hz"},
      fmt::format("{} of {} modes are computed at 0 Hz, so that no parameter changes their frequency by a share", rigid,
                  found.frequency_Hz.size()),
      "hold the structure by supports or springs; if it is held, look for an absurd mass or stiffness, beside which "
      "the others are lost in rounding");
}

Eigen::MatrixXd scaled_sensitivity(const std::vector<double>& compared_modes, double frequency_std_pct,
                                   const std::vector<fe::Parameter>& parameters, const Sensitivities& found) {
  std::vector<Eigen::Index> rows;
  for (const double mode : compared_modes) {
    if (mode <= static_cast<double>(found.frequency_Hz.size())) rows.push_back(static_cast<Eigen::Index>(mode) - 1);
  }
  if (rows.empty()) {
    for (Eigen::Index i = 0; i < found.frequency_Hz.size(); ++i) rows.push_back(i);
  }
  Eigen::VectorXd half_range(found.exact.cols());
  for (Eigen::Index p = 0; p < half_range.size(); ++p) {
    const fe::Parameter& parameter = parameters[static_cast<std::size_t>(p)];
    half_range(p) = 0.5 * (parameter.upper - parameter.lower);
  }
  const Eigen::MatrixXd shift = found.frequency_Hz.cwiseInverse().asDiagonal() * found.exact * half_range.asDiagonal();
  return shift(rows, Eigen::all) / (0.01 * frequency_std_pct);
}

}  // namespace twindeck::sensitivity
