#pragma once

#include <filesystem>
#include <string>

namespace twindeck::model_io {

/// What the other program printed of the mass of a deck, in the deck's own units: the grid point weight generator in the `.f06`
/// of Nastran, or the mass, centre and inertia in the `.dat` of Abaqus, in a file of the deck's stem beside it.
/// @return "frame.f06 has mass 3.2, centre of mass (1, 0, 0.5)", or "" where there is none
[[nodiscard]] std::string printed_mass(const std::filesystem::path& deck);

}  // namespace twindeck::model_io
