#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "runner/study.hpp"

/// Tables about a model, for people and reports; nothing reads a model from them.
namespace twindeck::steps {

/// The part of a structure that a group of elements or springs belongs to.
using PartOf = std::function<std::string(const std::string& group)>;

/// Tables of a model; each of a matrix model, which has no such parts, is a header only. paper/twindeck_reference/columns.toml
/// says what each column holds.
///  - stays.csv: cable force of the prestress state; site value if the model gives one (Element::pull_N > 0)
///  - member_forces.csv: every beam and bar under dead load and cable forces; its ends are nodes and offsets
///  - dampers.csv: the springs whose group begins with "damper"
///  - summary.csv: degrees of freedom, nodes, elements of each type, springs, links, masses, parameters; and, where parts are
///    known, nodes, elements of each type and springs of each part ("shells_decks")
/// @param part_of  empty: parts are not known
void write_model_tables(const dynamics::LoadedModel& loaded, const PartOf& part_of, const std::filesystem::path& folder);

/// @throws InputError for a mesh that the generator's file does not have, or whose sizes are bad
void refuse_unknown_meshes(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes);

/// mesh_convergence.csv: `mesh,degrees_of_freedom,mode,frequency_Hz,change_pct,mac`: the modes of the study's own mesh,
/// followed by shape into other meshes, with the change of frequency. The study's mesh comes first; its name is empty for the
/// generator's default.
/// @param meshes  names of the generator's meshes
/// @throws InputError  as refuse_unknown_meshes
void write_mesh_convergence(const runner::Study& study, const std::string& variant, const std::vector<std::string>& meshes,
                            int n_modes, const std::filesystem::path& file);

}  // namespace twindeck::steps
