#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::updating {

/// A measured frequency and the reference mode that it is paired with.
struct FrequencyTarget {
  std::string label;            ///< "7X-8N"
  int reference_mode = 0;       ///< 0-based position in the modes of the start model
  double measured_Hz = 0.0;
  double std_Hz = 0.0;
};

struct UpdatingOptions {
  double trust_radius = 2.0;            ///< initial radius in normalised parameters (paper section 4.2)
  int starts = 8;                       ///< the initial values first, then seeded points inside the bounds
  int max_iterations = 100;
  int n_modes = 20;                     ///< modes solved for, so that followed modes are among them
  int outer_iterations = 4;             ///< prestress refreshes: pulls are fixed inside a solve
  double optimality_tolerance = 1e-6;   ///< relative norm of the projected gradient
  double bound_tolerance = 1e-6;        ///< of the range, within which a parameter counts as on its bound
  std::uint64_t seed = 1;
};

struct IterationRecord { int start, outer, iteration; double cost, gradient, step, radius; Eigen::VectorXd theta; };

struct StartResult {
  Eigen::VectorXd initial, theta;       ///< (n_active)
  double cost = 0.0, projected_gradient = 0.0, relative_projected_gradient = 0.0;
  int iterations = 0;
  bool converged = false;
  std::string message;
};

struct UpdatingResult {
  Eigen::VectorXd theta;                ///< (n_parameters) all parameters, the inactive at their initial values
  std::vector<StartResult> starts;
  int best = 0;
  std::vector<int> optima;              ///< starts that represent distinct optima, best first
  std::vector<int> on_bound;            ///< (n_active) -1 lower, +1 upper, 0 inside
  Eigen::VectorXd frequency_before_Hz, frequency_after_Hz;  ///< (n_targets) of the followed modes
  std::vector<int> mode_before, mode_after;                 ///< (n_targets) positions
  std::vector<IterationRecord> history;
  Status status;
};

/// Assembles the system with the prestress of given parameter values: called once an outer iteration, so that residuals and
/// Jacobian of an inner solve belong to the same function.
using Refresh = std::function<fe::ParametricSystem(const Eigen::VectorXd& theta)>;

/// Bounded nonlinear least squares on relative frequency residuals, paper Eq. (5): F = 1/2 sum ((f_N - f_X)/f_X)².
/// Powell's dogleg (Ceres) on parameters divided by their initial values, bounds by projection, exact Jacobian; modes are
/// followed by mass-weighted MAC with the start model's.
/// @param active  positions of the parameters to update
[[nodiscard]] UpdatingResult update(const Refresh& refresh, const std::vector<int>& active,
                                    const std::vector<FrequencyTarget>& targets, const UpdatingOptions& options,
                                    const std::function<void(int start, int of)>& progress);

}  // namespace twindeck::updating
