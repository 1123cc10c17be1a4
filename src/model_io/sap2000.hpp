#pragma once

#include <filesystem>

#include "model_io/inp.hpp"

/// Import of SAP2000: models as text tables (`.s2k`, `.$2k`).
namespace twindeck::model_io {

/// Whether a file holds tables of SAP2000 by its name: .s2k or .$2k.
[[nodiscard]] bool is_sap2000_file(const std::filesystem::path& file);

/// Reads joints, frames, areas, their sections, materials, local axes and releases, restraints, uncoupled joint springs, added
/// masses, diaphragms and bodies, in the units that PROGRAM CONTROL states. As in SAP2000 masses are lumped and elements have
/// no rotary inertia of bending. A section is the group of its members; Shell-Thick is flexible in transverse shear. Tables of
/// loads, cases, design and output say nothing about the structure. As with read_inp the TOML file of the same stem beside it
/// may give the rest.
/// @throws InputError that names file, line and table: a table of the structure that is not carried (links, other constraints,
/// cables, solids, offsets, modifiers of elements) first of all; modes about a loaded state; masses that come from loads
[[nodiscard]] ImportedModel read_sap2000(const std::filesystem::path& file);

}  // namespace twindeck::model_io
