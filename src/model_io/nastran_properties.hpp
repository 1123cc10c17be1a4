#pragma once

#include <string>

#include "model_io/nastran_parts.hpp"

/// Inside of the library: property and material cards. The members of Parts that find them are defined here too.
namespace twindeck::model_io::nastran {

/// "pbar_7": group and section of a property.
[[nodiscard]] std::string property_name(const Card& property);
[[nodiscard]] MemberProperty bar_property(Parts& parts, const Card& element, long id);   ///< PBAR, PBARL
[[nodiscard]] MemberProperty beam_property(Parts& parts, const Card& element, long id);  ///< PBEAM, PBEAML
/// Components "1" to "6" of a field as flags. @throws InputError for anything else, scalar points (0 or blank) included
[[nodiscard]] Directions components(const DeckFields& card, std::size_t i);

}  // namespace twindeck::model_io::nastran
