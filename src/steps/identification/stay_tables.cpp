#include "steps/identification/stay_tables.hpp"

#include <optional>
#include <string>

namespace twindeck::steps {

void write_stays(const std::vector<identification::StayResult>& stays, double level, const std::filesystem::path& folder) {
  io::CsvWriter modes(
      {"stay", "condition", "harmonic", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"});
  io::CsvWriter tensions({"stay", "condition", "length_m", "c_Hz", "c_low_Hz", "c_high_Hz", "tension_per_mass_m2_s2",
                          "tension_per_mass_low_m2_s2", "tension_per_mass_high_m2_s2", "lambda_squared", "lambda_squared_low",
                          "lambda_squared_high", "bending", "bending_std", "harmonics", "level"});
  for (const identification::StayResult& stay : stays) {
    for (const identification::StayResult::Mode& mode : stay.modes) {
      modes.row({stay.stay, stay.condition, mode.harmonic, mode.frequency_Hz, mode.frequency_std_Hz, 100.0 * mode.damping_ratio,
                 100.0 * mode.damping_ratio_std});
    }
    if (!stay.fitted) continue;
    const sysid::StayFit& fit = stay.fit;
    const auto length = [&](double value) { return stay.length_m > 0.0 ? std::optional(value) : std::nullopt; };
    const auto sag = [&](double value) { return stay.modes.front().harmonic == 1 ? std::optional(value) : std::nullopt; };
    const auto bending = [&](double value) { return fit.bending_deviation > 0.0 ? std::optional(value) : std::nullopt; };
    tensions.row({stay.stay, stay.condition, length(stay.length_m), fit.c_Hz.value, fit.c_Hz.low, fit.c_Hz.high,
                  length(fit.tension_per_mass.value), length(fit.tension_per_mass.low), length(fit.tension_per_mass.high),
                  sag(fit.lambda_squared.value), sag(fit.lambda_squared.low), sag(fit.lambda_squared.high),
                  bending(fit.bending), bending(fit.bending_deviation), fit.harmonics, level});
  }
  modes.save(folder / "stays.csv");
  tensions.save(folder / "stay_tensions.csv");
}

std::vector<std::vector<io::Cell>> stay_rows(const std::vector<identification::StayResult>& stays) {
  std::vector<std::vector<io::Cell>> rows;
  for (const identification::StayResult& stay : stays) {
    for (const identification::StayResult::Mode& mode : stay.modes) {
      rows.push_back({"stay_frequency_Hz", std::to_string(mode.harmonic), stay.stay, stay.condition, mode.frequency_Hz,
                      mode.frequency_std_Hz});
    }
  }
  return rows;
}

}  // namespace twindeck::steps
