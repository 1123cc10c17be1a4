#pragma once

#include <array>
#include <string>

#include "model_io/nastran_parts.hpp"

/// Inside of the library: property and material cards. The members of Parts that find them are defined here too.
namespace twindeck::model_io::nastran {

/// "pbar_7": group and section of a property.
[[nodiscard]] std::string property_name(const Card& property);
/// A note that is made once, however many cards cause it.
void note_once(Parts& parts, const std::string& note);
/// The component that a field names, from 0 on. @throws InputError for anything but 1 to 6
[[nodiscard]] int component_at(const Parts& parts, const Card& card, std::size_t i);
/// Components "1" to "6" of a field as flags. @throws InputError for anything else, scalar points (0 or blank) included
[[nodiscard]] std::array<bool, 6> components(const Parts& parts, const Card& card, std::size_t i);

}  // namespace twindeck::model_io::nastran
