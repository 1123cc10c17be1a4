#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "updating/multi_start.hpp"
#include "updating/residuals.hpp"
#include "updating/surrogate.hpp"
#include "updating/updating.hpp"

/// One search of an update, from one starting point. `update` runs several in parallel. Normalised parameters x, (n_active)
/// [-], are the parameters over `ResidualDefinition::scale`. None of the functions checks its input; `update` does.
namespace twindeck::updating {

/// The search in normalised parameters, common to all starts.
struct Search {
  const Refresh& refresh;
  const UpdatingOptions& options;
  ResidualDefinition definition;
  std::shared_ptr<const fe::ParametricSystem> initial_system;  ///< prestress of the initial values
  Box box = {};
  Surrogate surrogate = {};
};

struct SearchEnd {
  StartResult result;
  EndPoint end;
  Evaluation evaluation;
  std::vector<IterationRecord> history;
};

/// @param points  (n_active × n_points) normalised parameters at which snapshots are taken
[[nodiscard]] Surrogate make_surrogate(const Search& search, const Eigen::MatrixXd& points);

/// The whole search from `first`, (n_active). With a surrogate, the full system is solved once at each point. Its value and
/// Jacobian correct the reduced system, on which the search continues. At its end the prestress is computed anew, and the
/// search on the reduced system continues once more to the next point. The search ends when the projected gradient of the full
/// system, with the prestress of the same point, is below the tolerance. Without a surrogate, or if that search does not
/// converge, bounded solves run on the full system at frozen prestress. The prestress is computed anew between them, until no
/// parameter changes by more than the tolerance.
[[nodiscard]] SearchEnd run_start(const Search& search, const Eigen::VectorXd& first, int start);

/// Residuals at normalised parameters x, with the prestress of x.
[[nodiscard]] Evaluation evaluate_in_balance(const Search& search, const Eigen::VectorXd& x);

/// Residuals and Jacobian at normalised parameters x, with the prestress of the initial values.
[[nodiscard]] Evaluation evaluate_at_start(const Search& search, const Eigen::VectorXd& x);

/// Solves the problem of a finished search again from its first point, with the smooth map of the bounds and the prestress of
/// its end point. It uses the reduced system, corrected to agree with the full one there, or the full one if there is no
/// reduced one.
[[nodiscard]] SmoothCheck check_by_smooth_map(const Search& search, const SearchEnd& ended);

}  // namespace twindeck::updating
