#include "steps/identification/stay_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>

namespace twindeck::steps {

namespace {

std::string numbers_of(const identification::Numbering& numbering) {
  std::vector<int> numbers;
  for (const identification::Harmonic& h : numbering.harmonics) numbers.push_back(h.number);
  return fmt::format("{}", fmt::join(numbers, " "));
}

}  // namespace

void write_stays(const std::vector<identification::StayResult>& stays, double level, const std::filesystem::path& folder) {
  io::CsvWriter modes(
      {"stay", "condition", "harmonic", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"});
  io::CsvWriter tensions({"stay",
                          "condition",
                          "length_m",
                          "c_Hz",
                          "c_low_Hz",
                          "c_high_Hz",
                          "tension_per_mass_m2_s2",
                          "tension_per_mass_low_m2_s2",
                          "tension_per_mass_high_m2_s2",
                          "lambda_squared",
                          "lambda_squared_low",
                          "lambda_squared_high",
                          "xi",
                          "xi_low",
                          "xi_high",
                          "hinged_probability",
                          "clamped_probability",
                          "numbering_probability",
                          "residual",
                          "harmonics",
                          "level"});
  for (const identification::StayResult& stay : stays) {
    for (const identification::StayResult::Mode& mode : stay.modes) {
      modes.row({stay.stay, stay.condition, mode.harmonic, mode.frequency_Hz, mode.frequency_std_Hz, 100.0 * mode.damping_ratio,
                 100.0 * mode.damping_ratio_std});
    }
    if (!stay.fitted) continue;
    const identification::StayFit& fit = stay.fit;
    const auto length = [&](double value) { return stay.length_m > 0.0 ? std::optional(value) : std::nullopt; };
    const auto sag = [&](double value) { return stay.modes.front().harmonic == 1 ? std::optional(value) : std::nullopt; };
    tensions.row({stay.stay,
                  stay.condition,
                  length(stay.length_m),
                  fit.c_Hz.value,
                  fit.c_Hz.low,
                  fit.c_Hz.high,
                  length(fit.tension_per_mass.value),
                  length(fit.tension_per_mass.low),
                  length(fit.tension_per_mass.high),
                  sag(fit.lambda_squared.value),
                  sag(fit.lambda_squared.low),
                  sag(fit.lambda_squared.high),
                  fit.xi.value,
                  fit.xi.low,
                  fit.xi.high,
                  fit.hinged,
                  fit.clamped,
                  fit.numbering.probability,
                  fit.residual,
                  stay.modes.size(),
                  level});
  }
  modes.save(folder / "stays.csv");
  tensions.save(folder / "stay_tensions.csv");
}

std::vector<std::string> stay_lines(const std::vector<identification::StayResult>& stays, double level) {
  constexpr double kCertain = 0.9;  // probability that needs no word
  constexpr double kNarrow = 0.1;   // [-] of the value: an interval that needs no advice
  std::vector<std::string> lines;
  for (const identification::StayResult& stay : stays) {
    const identification::StayFit& fit = stay.fit;
    if (!stay.fitted) continue;
    const bool known = stay.length_m > 0.0;
    const identification::Bounded& force = known ? fit.tension_per_mass : fit.c_Hz;
    std::string line =
        fmt::format("stay {}, {}: {} {:.6g} {} ({:.0f} %: {:.6g} to {:.6g}), harmonics {}, ends hinged {:.2f} clamped {:.2f}",
                    stay.stay, stay.condition, known ? "T/m" : "c", force.value, known ? "m2/s2" : "Hz", 100.0 * level,
                    force.low, force.high, numbers_of(fit.numbering), fit.hinged, fit.clamped);
    if (fit.numbering.probability < kCertain && !fit.others.empty())
      line += fmt::format("; the numbering has probability {:.2f}, {} has {:.2f}", fit.numbering.probability,
                          numbers_of(fit.others.front()), fit.others.front().probability);
    if (force.high - force.low > kNarrow * force.value)
      line += "; more harmonics, or ends and bending_stiffness in [[stay_length]], narrow the interval";
    lines.push_back(std::move(line));
  }
  return lines;
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
