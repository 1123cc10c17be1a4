#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "updating/multi_start.hpp"
#include "updating/reduced_system.hpp"
#include "updating/residuals.hpp"
#include "updating/updating.hpp"

/// One search of an update, from one starting point: what `update` runs side by side.
namespace twindeck::updating {

/// What all searches share of the reduced model: projections of the start model.
struct Surrogate {
  std::shared_ptr<const Eigen::MatrixXd> basis;  ///< null: there is none
  Eigen::MatrixXd mass_reference, mass;          ///< Q' M phi (r × n_reference), Q' M Q (r × r)
  std::shared_ptr<const ReducedSystem> initial;
};

/// The search in normalised parameters, common to all starts.
struct Search {
  const Refresh& refresh;
  const UpdatingOptions& options;
  ResidualDefinition definition;
  Box box;
  std::shared_ptr<const fe::ParametricSystem> initial_system;  ///< prestress of the initial values
  Surrogate surrogate;
};

struct SearchEnd {
  StartResult result;
  EndPoint end;
  Evaluation evaluation;
  std::vector<IterationRecord> history;
};

/// @param points (n_active × n_points) where snapshots are taken
[[nodiscard]] Surrogate make_surrogate(const Search& search, const Eigen::MatrixXd& points);

/// The whole search from `first`: with a surrogate, each prestress state costs one solve of the full system, whose value and
/// Jacobian correct the reduced one; the search between two states runs on that. It ends when the full projected gradient at
/// the prestress of its own point is below the tolerance. Without a surrogate, or where it does not come to rest: bounded
/// solves on the full system at frozen prestress, the prestress found anew in between, until the parameters stay.
[[nodiscard]] SearchEnd run_start(const Search& search, const Eigen::VectorXd& first, int start);

/// Residuals at normalised parameters x, with the prestress of x.
[[nodiscard]] Evaluation evaluate_in_balance(const Search& search, const Eigen::VectorXd& x);

/// The problem of a search that has ended, from its first point by the smooth map of the bounds, at the prestress of its end: on
/// the reduced system corrected to agree with the full one there, or on the full one where there is no reduced one.
[[nodiscard]] SmoothCheck check_by_smooth_map(const Search& search, const SearchEnd& ended);

}  // namespace twindeck::updating
