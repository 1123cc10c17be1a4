#pragma once

#include <string>
#include <vector>

#include "identification/condition.hpp"

namespace twindeck::identification {

/// Takes the choices of a person for one setup: a pole that is deleted takes its mode with it; a pole that is kept and belongs
/// to no mode becomes one, with the poles of other orders near it. Its frequency has the deviation of the pole, its damping
/// ratio the same relative to the half bandwidth, its shape the scatter over the orders.
/// @param found  shapes of modes physical, those of poles as identified @param scale  of the channels, see physical_shape
void take_choices(Identification& found, const std::vector<ModeChoice>& choices, const Conditioned& conditioned,
                  const Eigen::VectorXd& scale);

/// @throws InputError  with the line of the file, for a choice that no setup of any condition has a pole for
void require_poles(const std::vector<ModeChoice>& choices, const std::vector<ConditionResult>& results);

}  // namespace twindeck::identification
