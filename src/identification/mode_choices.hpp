#pragma once

#include <vector>

#include "identification/condition.hpp"

namespace twindeck::identification {

/// Applies the choices of a person to one setup. Deleting a pole deletes its mode. Keeping a pole without a mode makes a mode
/// of it and the near poles of other orders. Its frequency has the deviation of the pole, its damping ratio that deviation over
/// the frequency, its shape the scatter over the orders.
/// @param found  shapes of modes physical, those of poles as identified @param scale  of the channels, see physical_shape
void take_choices(Identification& found, const std::vector<ModeChoice>& choices, const Conditioned& conditioned,
                  const Eigen::VectorXd& scale);

/// @throws InputError  with the line of the file, for a choice that no setup of any condition has a pole for
void require_poles(const std::vector<ModeChoice>& choices, const std::vector<ConditionResult>& results);

}  // namespace twindeck::identification
