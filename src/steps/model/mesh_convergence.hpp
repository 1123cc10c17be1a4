#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/study.hpp"

namespace twindeck::steps {

/// @throws InputError for a mesh that the generator's file does not have, or whose sizes are bad
void refuse_unknown_meshes(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes);

/// mesh_convergence.csv: `mesh,degrees_of_freedom,mode,frequency_Hz,change_pct,mac`: the modes of the study's own mesh (first,
/// its name is empty for the generator's default) followed by shape into other meshes, and the change of frequency against it.
/// @param meshes  names of the generator's meshes
/// @throws InputError  as refuse_unknown_meshes
void write_mesh_convergence(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes,
                            int n_modes, const std::filesystem::path& file);

}  // namespace twindeck::steps
