#pragma once

#include <optional>
#include <string>
#include <vector>

namespace twindeck::records {

/// A unit of the numbers in a record.
struct RecordedUnit {
  std::string quantity;    ///< acceleration | velocity | displacement | force; "" for volts and counts, before calibration
  double si_factor = 0.0;  ///< physical value in SI = factor · number; 0 for volts and counts, which have no such factor
};

/// The unit with the given name. Names are spelled as loggers write them, in latin-1 or UTF-8: "g", "mg", "m/s²", "mm/s",
/// "µm", "kN", "mV", "counts" … @return empty if the name is unknown
[[nodiscard]] std::optional<RecordedUnit> recorded_unit(const std::string& unit);

/// The usual names of the units of a quantity, for messages.
[[nodiscard]] std::vector<std::string> units_of(const std::string& quantity);

/// Factor from a unit of acceleration, velocity, displacement or force to SI; 0 if the unit is unknown.
[[nodiscard]] double si_factor(const std::string& unit);

/// [-] Largest factor between the gain of a sensor and its unit, either way, by calibration. Units of one quantity differ by a
/// factor of 9.8 or more. Its root is larger than this, so that no gain fits two units.
inline constexpr double kLargestCalibration = 3.1;

}  // namespace twindeck::records
