#pragma once

#include <array>
#include <numbers>
#include <string_view>

#include "core/error.hpp"

namespace twindeck {

/// [SI] Largest absolute value of a number in a file or a configuration. Quantities of real structures are far smaller.
/// Products of five such numbers are still finite.
constexpr double largest_number = 1e60;

inline constexpr double degrees = 180.0 / std::numbers::pi;  ///< degrees in a radian
inline constexpr double radians = std::numbers::pi / 180.0;  ///< radians in a degree

/// A unit of measurement: value in SI base units = factor * value + offset.
///
/// The angle has its own dimension, so that "rad/s" in place of "Hz" is refused. Otherwise the value would be wrong by 2 pi.
/// The offset is zero except for a temperature in degC alone; within a product ("1/degC") degC is a difference.
struct Unit {
  double factor = 1.0;
  double offset = 0.0;
  std::array<int, 5> dimension{};  ///< exponents of kg, m, s, K, rad

  [[nodiscard]] bool same_dimension(const Unit& other) const { return dimension == other.dimension; }
};

/// Reads a unit: symbols with SI prefixes joined by a blank, '*' or '/', with powers ("kN/m", "N s/m", "m/s^2", "mm2",
/// "J/(kg K)", "%", "" for a plain number). A '/' divides by the one factor that follows it.
/// @param place  position of the text, for the message
/// @throws InputError  for an unknown symbol, naming the nearest known one
[[nodiscard]] Unit parse_unit(std::string_view text, const Place& place = {});

/// Reads a number with or without a unit and returns it in `field_unit`: ("210 GPa", "Pa") -> 2.1e11, ("2 %", "") -> 0.02,
/// ("20 degC", "K") -> 293.15, ("20", "degC") -> 20.
/// @param text        as written by the user
/// @param field_unit  unit of the returned value, and of a number without unit
/// @param place       position of the text, for the message
/// @throws InputError  if the number is not finite or exceeds largest_number, or if the unit is unknown or has another
///                     dimension than `field_unit`
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view field_unit, const Place& place = {});

}  // namespace twindeck
