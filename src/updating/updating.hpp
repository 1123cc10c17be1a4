#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/parametric_system.hpp"
#include "updating/optimality.hpp"
#include "updating/weighted_rows.hpp"

namespace twindeck::updating {

/// A measured frequency and the reference mode that it is paired with.
struct FrequencyTarget {
  std::string label;       ///< "7X-8N"
  int reference_mode = 0;  ///< 0-based position in the modes of the start model
  double measured_Hz = 0.0;
  bool fitted = true;  ///< false: tracked and reported, but not fitted
};

struct UpdatingOptions {
  double trust_radius = 2.0;  ///< initial radius in normalised parameters (paper section 4.2)
  int starts = 8;             ///< the initial values first, then seeded points inside the bounds
  int max_iterations = 100;
  int n_modes = 20;                         ///< number of computed modes; the tracked modes must be among them
  int outer_iterations = 12;                ///< most prestress states per start; cable forces are fixed inside a solve
  double outer_tolerance = 1e-6;            ///< change of normalised parameters between prestress states below which they agree
  double optimality_tolerance = 1e-6;       ///< relative norm of the projected gradient
  double bound_tolerance = 1e-6;            ///< of the range, within which a parameter counts as on its bound
  Eigen::Index surrogate_from_size = 1000;  ///< least degrees of freedom for a search on a reduced system (see `update`)
  std::uint64_t seed = 1;
  bool leave_one_out = false;              ///< afterwards each target is left out in turn and predicted (leave_one_out.hpp)
  std::vector<Eigen::VectorXd> elsewhere;  ///< (n_active each) further values at which the cost is computed
  bool regularised =
      true;            ///< afterwards, where left-out targets are predicted worse than without an update (leave_one_out.hpp)
  bool prior = false;  ///< parameters are held to their initial values by the deviations of their ranges (prior.hpp)
};

/// One accepted step of a search. `theta` are the active parameters divided by their initial values (by their range where the
/// initial value is 0), `gradient` the norm of the projected gradient with respect to them.
struct IterationRecord {
  int start, outer, iteration;
  double cost, gradient, step, radius;
  Eigen::VectorXd theta;
};

struct StartResult {
  Eigen::VectorXd initial, theta;  ///< (n_active) in the parameters' units
  double cost = 0.0, projected_gradient = 0.0, relative_projected_gradient = 0.0;
  int iterations = 0;
  int solves = 0;    ///< eigen-solves spent
  int outer = 0;     ///< prestress states used
  int optimum = -1;  ///< start that represents the optimum it ended in, -1 if it did not converge
  bool converged = false;
  std::string message;
};

/// The best start's problem solved again by a smooth map of the bounds (problem.hpp), at the prestress of its end.
struct SmoothCheck {
  Eigen::VectorXd theta;  ///< (n_active) in the parameters' units; empty if the check could not be made
  double cost = 0.0;
  double largest_difference = 0.0;  ///< from the bounded search, as a fraction of the range
  int iterations = 0;
};

/// A target that was left out of the updating, with its prediction from the others.
struct LeftOut {
  Eigen::VectorXd theta;      ///< (n_active) in the parameters' units
  double frequency_Hz = 0.0;  ///< prediction for the left-out target, at `theta`
  double cost = 0.0;          ///< of the fitted targets
  double followed_mac = 0.0;  ///< of the left-out mode with the start model's
  int on_bounds = 0;          ///< parameters that end on a bound
  bool converged = false;
};

/// Cost and frequencies at given parameter values, with the prestress of those values.
struct CostElsewhere {
  double cost = 0.0;
  Eigen::VectorXd frequency_Hz;  ///< (n_targets) of the followed modes
  bool valid = false;            ///< false: the modes were not found there
};

struct UpdatingResult {
  Eigen::VectorXd theta;  ///< (n_parameters) all parameters, the inactive at their initial values
  std::vector<StartResult> starts;
  int best = 0;               ///< start whose end is published
  std::vector<int> optima;    ///< starts that represent distinct optima, the published one first
  Eigen::MatrixXd flat;       ///< (n_active × k) directions that the data do not determine (valley_walk.hpp)
  std::vector<int> on_bound;  ///< (n_active) -1 lower, +1 upper, 0 inside
  Eigen::VectorXd frequency_before_Hz, frequency_after_Hz;  ///< (n_targets) of the followed modes
  std::vector<int> mode_after;                              ///< (n_targets) positions
  Eigen::VectorXd followed_mac;                             ///< (n_targets) MAC of the followed mode with the start model's
  std::vector<IterationRecord> history;
  SmoothCheck smooth;
  double cost_before = 0.0;                           ///< at the initial values
  double model_error = 0.0;                           ///< [-] of a frequency, as options.prior estimates it; else 0
  Linearised at_optimum, at_start;                    ///< `at_start` only where rows are weighed
  Eigen::VectorXd scale;                              ///< (n_active) parameter = scale · normalised parameter
  Box box;                                            ///< of the normalised parameters
  std::vector<LeftOut> left_out;                      ///< (n_targets) where options.leave_one_out, else empty
  std::vector<CostElsewhere> elsewhere;               ///< one a point of options.elsewhere
  std::shared_ptr<const UpdatingResult> regularised;  ///< where left-out targets are predicted worse than without an update
                                                      ///< (leave_one_out.hpp), else null
  Status status;
};

/// Assembles the system with the prestress of given parameter values: called once an outer iteration, so that residuals and
/// Jacobian of an inner solve belong to the same function. Must be callable from several threads at once.
using Refresh = std::function<fe::ParametricSystem(const Eigen::VectorXd& theta)>;

/// Bounded nonlinear least squares on relative frequency residuals, paper Eq. (5): F = 1/2 sum ((f_N - f_X)/f_X)², or on rows
/// that are weighed by their covariance.
/// Powell's dogleg (Ceres, see problem.hpp) on parameters divided by their initial values, with the exact Jacobian. Modes are
/// tracked by their mass-weighted MAC with the start model's modes.
///
/// Each start is a complete search. All searches begin with the prestress of the initial values. When a solve has ended, the
/// prestress is computed anew at its end point and the search continues from there, until no parameter changes by more than
/// options.outer_tolerance. The costs of the starts are therefore comparable: each is that of a structure in equilibrium. At
/// the result the gradient at frozen prestress vanishes (inside the bounds): within a solve, modulus and density do not change
/// the cable forces. Large systems (options.surrogate_from_size) are searched on a reduced system. At each point the full
/// system is solved once. Its frequencies and Jacobian correct a projection on snapshots of its modes, which gives the next
/// point, with the prestress found anew once on the way. The returned cost, gradient and frequencies are always those of the
/// full system. The starts run in parallel; results do not depend on the number of threads.
///
/// @param start    the model as it is before the updating, with the prestress of its initial parameter values
/// @param refresh  see `Refresh`; empty for a system whose prestress does not depend on parameters
/// @param active   positions of the parameters to update; each with lower < initial < upper (or on one of them)
/// @param targets  measured frequencies [Hz] with the start model's modes they belong to
/// @param progress called when a start has ended; may be empty
/// @param rows     measured rows with their covariance: F is then half the sum of squared weighed rows (weighted_rows.hpp), of
///                 frequencies alone or of shapes too; by default Eq. (5).
/// @return the cheapest converged start; among ends of equal cost the nearest to the initial values (valley_walk.hpp), and in a
///         valley of equal cost its nearest point (valley_walk.hpp); status not converged if no start converged
/// @throws InputError  for a parameter that is fixed or starts outside its bounds, no parameter or target, a frequency that is
///                     not positive, or a mode that does not exist
/// Reference: Powell (1970); Madsen, Nielsen and Tingleff (2004), Methods for non-linear least squares problems, section 3.3.
[[nodiscard]] UpdatingResult update(const fe::ParametricSystem& start, const Refresh& refresh, const std::vector<int>& active,
                                    const std::vector<FrequencyTarget>& targets, const UpdatingOptions& options,
                                    const std::function<void(int done, int of)>& progress, const MeasuredRows& rows = {});

}  // namespace twindeck::updating
