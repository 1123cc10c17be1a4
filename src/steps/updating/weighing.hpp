#pragma once

#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "steps/refinement/comparison.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/updating/setup.hpp"
#include "updating/posterior.hpp"
#include "updating/updating.hpp"

/// An update that weighs frequencies and shapes by the covariance of the measurement: its rows, and what became of them.
namespace twindeck::steps {

/// @throws InputError  where no shape was measured, or none has a standard deviation
void refuse_unweighable_shapes(const Measured& measured);

/// The rows of the paired modes with their covariance, and the model's own error added to it. Modes closer to a pair's computed
/// one than `cluster_gap` span its shape together.
/// @return rows that are not given() where the configuration asks for Eq. (5)
[[nodiscard]] updating::MeasuredRows weighed_rows(const UpdatingConfig& config, const Measured& measured,
                                                  const Pairing& pairing, const LoadedModel& loaded,
                                                  const dynamics::EigenModes& modes);

/// What the tables and words about a weighed update come from.
struct Weighed {
  const LoadedModel& loaded;
  const std::vector<int>& active;
  const Measured& measured;
  const Pairing& pairing;
  const updating::MeasuredRows& rows;
  const updating::UpdatingResult& result;
};

/// Writes, for an update with weighed rows and converged modes,
///  - `posterior.csv`: parameter,unit,final_value,std,std_with_misfit,prior_std,held; std empty for a parameter held by its
///  bound
///  - `correlations.csv`: parameter,other_parameter,correlation, one row a pair of free parameters
///  - `weighed_rows.csv`:
///  type,experimental_mode,numerical_mode,channel,value,std,computed_start,computed_updated,difference_std
///  - `weighing.csv`: quantity,value,unit: chi_squared, degrees_of_freedom, misfit, rows, free_scales
/// and says in words how well the model agrees, what cannot be told apart, and which directions are flat. Nothing without
/// weighed rows.
void report_weighing(StepContext& context, const Weighed& weighed);

}  // namespace twindeck::steps
