#pragma once

#include <filesystem>

#include "model_io/inp.hpp"

/// Import of Nastran bulk data, the common language of MSC, NX, Simcenter and OptiStruct decks.
namespace twindeck::model_io {

/// Whether a file is bulk data by its name: .bdf, .nas, .blk, or a .dat that holds a GRID card or BEGIN BULK (other programs
/// use that ending too).
[[nodiscard]] bool is_nastran_file(const std::filesystem::path& file);

/// Reads a deck with its INCLUDE files: free, small and large field. docs/import_nastran.md lists the cards.
///
/// Nastran has no units. The TOML file of the same stem beside the deck ("frame.toml" beside "frame.bdf") has to state them,
/// `[units] length = "in"` and `force = "lbf"`; seconds are assumed, and the mass unit follows (PARAM WTMASS included). Its
/// other keys are those of model.toml, in SI units. Masses are lumped unless the deck says PARAM,COUPMASS,1, as in Nastran;
/// members and shells have no rotary inertia of bending, which Nastran's have not either; the drilling penalty of shells is
/// that of K6ROT. The property is the group and the section's name ("pbar_7"), "mat1_3" the material's.
/// @throws InputError  that names file, line and card: for an unknown card, for what a card says and a model cannot hold, for
///         units that are not stated
[[nodiscard]] ImportedModel read_nastran(const std::filesystem::path& file);

}  // namespace twindeck::model_io
