#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"
#include "runner/run_step.hpp"
#include "steps/updating/updating_config.hpp"

namespace twindeck::steps {

/// Positions of the parameters to update: as listed, as s5_sensitivity selected them, or all that have a range.
/// @throws InputError  for a name that is no parameter, is listed twice or has no range
[[nodiscard]] std::vector<int> active_parameters(const UpdatingConfig& config, const dynamics::ReadModel& model,
                                                 runner::StepContext& context);

/// Values of the updated parameters in somebody else's result: `parameter,unit,final_value`, in units of its own; a parameter
/// that it does not name stays at its initial value. Empty where none is given.
/// @throws InputError  for a name that is not updated, or a unit of another kind
[[nodiscard]] std::vector<Eigen::VectorXd> published_values(const UpdatingConfig& config,
                                                            const std::vector<fe::Parameter>& parameters,
                                                            const std::vector<int>& active, runner::StepContext& context);

/// What the step reads.
struct UpdatingInputs {
  dynamics::ReadModel model;  ///< the refined one
  matching::Measured measured;
  std::vector<int> active;                 ///< see active_parameters
  std::vector<Eigen::VectorXd> published;  ///< see published_values
};
/// @throws InputError  also where no modes were measured
[[nodiscard]] UpdatingInputs read_updating(const UpdatingConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
