#pragma once

#include <string>
#include <vector>

#include "fe/model.hpp"
#include "matching/comparison.hpp"
#include "runner/run_step.hpp"
#include "updating/updating.hpp"
#include "updating/weighing.hpp"

namespace twindeck::steps {

/// An update, to be told.
struct Update {
  const std::vector<fe::Parameter>& parameters;  ///< of the model
  const std::vector<int>& active;                ///< positions of those that were updated
  const updating::UpdatingResult& result;
  [[nodiscard]] const fe::Parameter& parameter(std::size_t j) const { return parameters[static_cast<std::size_t>(active[j])]; }
};

/// Writes (paper/twindeck_reference/columns.toml says what each column holds)
///  - `parameters.csv`, one row an updated parameter; change_pct is empty where the initial value is 0
///  - `smooth_bounds.csv`: the best start's problem solved again without projection (updating/problem.hpp); no file where no
///    start converged
///  - `history.csv`, one row an accepted step, with the normalised parameters
///  - `starts.csv`, with the final normalised parameters; `optimum` numbers the distinct optima from 1, best first; empty for a
///    start that did not converge
///  - `costs.csv`: what the points cost in this model, each in balance
///  - `leave_one_out.csv`, one row a pair; no file where no pair was left out
///  - if these predictions are worse than those without updating: `regularised.csv`, as parameters.csv, and
///    `leave_one_out_regularised.csv`, as leave_one_out.csv, of the update that is held to the ranges (updating/prior.hpp); the
///    manifest has a warning that says how much each predicts
///  - `summary.csv`: mean_abs_error_before_pct and _after_pct over all pairs; the same with _common over
///    the measured modes `common` (those that an earlier table compares too), so that means are over like and like; of left-out
///    pairs, where there are any; cost and optimality of the best start, and its cost by a smooth map of the bounds; numbers of
///    starts, of distinct optima, of parameters on a bound
///  - the comparison (comparison_tables.hpp)
/// @param comparison  rows of the stages `before` and `after`, in the order of the targets
void write_updating(const Update& of, const std::vector<matching::ComparisonRow>& comparison,
                    const std::vector<std::string>& common, runner::StepContext& context);

/// The same update of the parameters that s5_sensitivity selected, beside that of a list: `selected.csv`, as parameters.csv,
/// and `leave_one_out_selected.csv`; reports its mean error.
/// @param comparison  of the list's update, in the order of the targets
void write_selected(const Update& of, const std::vector<matching::ComparisonRow>& comparison, runner::StepContext& context);

/// Warns of defects that a good fit of frequencies hides (matching/hollow_fit.hpp), and of parameters on their bounds.
void warn_of_fit(Reporter& reporter, const matching::Measured& measured, const std::vector<matching::ComparisonRow>& comparison,
                 const Update& of);

/// What was found, for people: values before and after, bounds hit, cost and optimality of each start.
[[nodiscard]] std::vector<std::string> report_lines(const Update& of);

/// Writes, for an update with converged modes whose paired frequencies have standard deviations,
///  - `posterior.csv`: std empty for a parameter held by its bound; label `identified` where the rows were weighed by their
///    covariance, `assumed` where all frequencies weighed alike
///  - `correlations.csv`, one row a pair of free parameters
/// and for an update with weighed rows
///  - `weighed_rows.csv` and `weighing.csv`
/// and says in words how well the model agrees, what cannot be told apart, and which directions are flat. Without weighed rows
/// it tells which directions are flat and what the data do not determine.
void report_weighing(runner::StepContext& context, const updating::Weighed& weighed);

}  // namespace twindeck::steps
