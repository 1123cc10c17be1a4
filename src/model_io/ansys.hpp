#pragma once

#include <filesystem>

#include "model_io/inp.hpp"

/// Exchange with ANSYS: models as archives (CDWRITE, `.cdb`), Workbench input (`ds.dat`) and plain command decks.
namespace twindeck::model_io {

/// True for a readable file whose first commands are those of ANSYS (NBLOCK, EBLOCK, /PREP7, ET): endings tell little, since
/// `.dat` is Nastran's as well.
[[nodiscard]] bool is_ansys_deck(const std::filesystem::path& file);

/// Reads the mesh and the supports up to the first SOLVE: nodes, beams (BEAM3, BEAM4, BEAM188, BEAM189 of two nodes), bars
/// (LINK8, LINK10, LINK180), shells (SHELL63, SHELL181), solids of eight nodes (SOLID45, SOLID185), COMBIN14, MASS21, rigid
/// MPC184, their sections, real constants and isotropic materials, D, and CERIG, CP and CE as rigid links or constraints.
/// docs/import_ansys.md lists it all. A component of elements becomes their group, a component of one node a monitoring point.
/// Numbers are taken as SI. As with read_inp, title, gravity, parameters and prestress come from the TOML file of the same stem
/// beside it, if there is one.
/// @return the model, and notes on commands that do not enter it
/// @throws InputError that names file, line and command: an unsupported command, element type, key option or section first of
/// all
[[nodiscard]] ImportedModel read_ansys(const std::filesystem::path& file);

}  // namespace twindeck::model_io
