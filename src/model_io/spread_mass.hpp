#pragma once

#include <string>
#include <vector>

#include "model_io/deck_model.hpp"

namespace twindeck::model_io {

enum class MassPer { volume, area, length };

/// Mass that is not structural (pavement, ballast, cladding), which a deck gives to elements beside their density.
struct SpreadMass {
  double value = 0.0;  ///< in the deck's units
  MassPer per = MassPer::volume;
  bool total = false;       ///< of all the elements, in shares of their volume, area or length
  bool as_density = false;  ///< a total in shares of the elements' own masses instead
  std::string owner;        ///< what the copies of the materials are called after
};

/// Adds the mass to the densities of elements, which get copies of their materials for it. Several such masses add up.
/// @param ids  of the deck; those that are no member, shell or solid of the model are left out
/// @throws InputError  if no element is left, one has no such extent, or the mass is below 0
void spread_mass(DeckModel& deck, const DeckPlace& at, const std::vector<long>& ids, const SpreadMass& mass);

}  // namespace twindeck::model_io
