#pragma once

#include <filesystem>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"

/// Nastran has no units: the user states two, and the finished model is turned into SI in one place.
namespace twindeck::model_io::nastran {

/// Keys units.length and units.force of the TOML file beside the deck.
struct UnitKeys {
  std::string length, force;
  void add_to(io::FieldTable& table);
};

struct Units {
  double length_m = 1.0;  ///< [m] of one unit of length
  double force_N = 1.0;   ///< [N] of one unit of force
};

/// @param beside  the TOML file, for the message
/// @throws InputError  where one of the two is missing or unknown
[[nodiscard]] Units units_of(const UnitKeys& keys, const std::filesystem::path& beside);

/// Scales nodes, materials, sections, members, springs, matrix elements and masses into SI. The deck's masses times `wtmass`
/// are in force s²/length.
void to_si(fe::Model& model, const Units& units, double wtmass);

}  // namespace twindeck::model_io::nastran
