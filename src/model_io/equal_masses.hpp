#pragma once

#include <vector>

#include "fe/model.hpp"

namespace twindeck::model_io {

/// Puts point masses of one mass into one group, mass_of_ with that number: cards of decks name no group, and a group for each
/// card would be a place of its own for a diagnosis. A mass that no other equals keeps its group.
/// @param masses  in the deck's own units
void group_equal_masses(std::vector<fe::PointMass>& masses);

}  // namespace twindeck::model_io
