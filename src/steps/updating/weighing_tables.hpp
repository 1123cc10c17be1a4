#pragma once

#include "runner/run_step.hpp"
#include "updating/weighing.hpp"

namespace twindeck::steps {

/// Writes, for an update with converged modes whose paired frequencies have standard deviations,
///  - `posterior.csv`: parameter,unit,final_value,std,std_with_misfit,prior_std,held,label; std empty for a parameter held by
///  its bound; label `identified` where the rows were weighed by their covariance, `assumed` where all frequencies weighed
///  alike
///  - `correlations.csv`: parameter,other_parameter,correlation, one row a pair of free parameters
/// and for an update with weighed rows
///  - `weighed_rows.csv`:
///  type,experimental_mode,numerical_mode,channel,value,std,computed_start,computed_updated,difference_std
///  - `weighing.csv`: quantity,value,unit: chi_squared, degrees_of_freedom, misfit, rows, free_scales
/// and says in words how well the model agrees, what cannot be told apart, and which directions are flat. Without weighed rows
/// it tells which directions are flat and what the data do not determine.
void report_weighing(runner::StepContext& context, const updating::Weighed& weighed);

}  // namespace twindeck::steps
