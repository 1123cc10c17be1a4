#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// Places where dampers might stand instead: `alternative,damper,x_m,y_m,z_m`, rows of one alternative beside each other.
/// @param model  null for a matrix model, which has no dampers
/// @throws InputError  with file, line and column, for a damper that the model lacks or that cannot be moved
[[nodiscard]] std::vector<DamperMove> read_damper_places(const std::filesystem::path& file, const fe::Model* model);

}  // namespace twindeck::diagnosis
