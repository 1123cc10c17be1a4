#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"
#include "model_io/deck_card.hpp"

/// Inside of the library: units of length and force of a deck, from which all others follow with seconds. A finished model is
/// turned into SI in one place.
namespace twindeck::model_io {

/// Keys units.length and units.force of the TOML file beside the deck.
struct UnitKeys {
  std::string length, force;
  void add_to(io::FieldTable& table);
};

struct DeckUnits {
  double length_m = 1.0;  ///< [m] of one unit of length
  double force_N = 1.0;   ///< [N] of one unit of force
};

/// Units by their names, whose case does not matter: m, cm, mm, in, ft; N, kN, MN, lbf (lb), kip, kgf, tonf.
/// @throws InputError at one of the two places, with `mend`, where a name is missing or unknown
[[nodiscard]] DeckUnits units_of(const std::string& length, const std::string& force, const std::array<DeckPlace, 2>& at,
                                 const std::string& mend);
/// Those that the TOML file beside a deck of Nastran states. @throws InputError  where one of the two is missing or unknown
[[nodiscard]] DeckUnits units_of(const UnitKeys& keys, const std::filesystem::path& beside);

/// Scales nodes, materials, sections, members, springs, matrix elements and masses into SI. The deck's masses times `wtmass`
/// are in force s²/length.
void to_si(fe::Model& model, const DeckUnits& units, double wtmass);

}  // namespace twindeck::model_io
