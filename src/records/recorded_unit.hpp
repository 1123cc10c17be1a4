#pragma once

#include <optional>
#include <string>
#include <vector>

namespace twindeck::records {

/// A unit that records come in.
struct RecordedUnit {
  std::string quantity;    ///< acceleration | velocity | displacement | force; "" for what a converter gives before calibration
  double si_factor = 0.0;  ///< physical value in SI = factor · number; 0 for volts and counts, which have none
};

/// The unit in the spellings of loggers, latin-1 or UTF-8: "g", "mg", "m/s²", "mm/s", "µm", "kN", "mV", "counts" …; nothing if
/// it is not known.
[[nodiscard]] std::optional<RecordedUnit> recorded_unit(const std::string& unit);

/// Units of a quantity as they are usually written, for messages.
[[nodiscard]] std::vector<std::string> units_of(const std::string& quantity);

/// Unit of an acceleration, velocity, displacement or force as a factor to SI; 0 where it is not known.
[[nodiscard]] double si_factor(const std::string& unit);
/// What the unit measures: "acceleration", "velocity", "displacement", "force", or "".
[[nodiscard]] std::string quantity_of(const std::string& unit);

}  // namespace twindeck::records
