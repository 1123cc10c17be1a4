#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace twindeck {

/// [SI] Largest absolute value of a number in a file or a configuration. No quantity of a structure comes near it; and products of
/// five such numbers are finite still, so that what is computed from them is a number.
constexpr double largest_number = 1e60;

/// A unit of measurement: value in SI base units = factor * value + offset.
///
/// The angle is kept as a dimension of its own, so that "rad/s" given where "Hz" is expected is refused instead of being wrong
/// by 2 pi. The offset is zero but for a temperature in degC that stands alone; within a product ("1/degC") it is a difference.
struct Unit {
  double factor = 1.0;
  double offset = 0.0;
  std::array<int, 5> dimension{};  ///< exponents of kg, m, s, K, rad

  [[nodiscard]] bool same_dimension(const Unit& other) const { return dimension == other.dimension; }
};

/// Reads a unit: symbols with SI prefixes joined by a blank, '*' or '/', with powers ("kN/m", "N s/m", "m/s^2", "mm2",
/// "J/(kg K)", "%", "" for a plain number). A '/' divides by the one factor that follows it.
/// @param place  where it stands, for the message
/// @throws InputError  for an unknown symbol, naming the nearest known one
[[nodiscard]] Unit parse_unit(std::string_view text, const Place& place = {});

/// Reads a number with or without a unit and returns it in `field_unit`: ("210 GPa", "Pa") -> 2.1e11, ("2 %", "") -> 0.02,
/// ("20 degC", "K") -> 293.15, ("20", "degC") -> 20.
/// @param text        as written by the user
/// @param field_unit  unit in which the program wants it; a number without unit is taken to be in it
/// @param place       where it stands, for the message
/// @throws InputError  if it is no finite number or beyond largest_number, the unit is unknown, or has another dimension than `field_unit`
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view field_unit, const Place& place = {});

}  // namespace twindeck
