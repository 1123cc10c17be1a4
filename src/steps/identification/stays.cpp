#include "steps/identification/stays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"

namespace twindeck::steps {

using Eigen::Index;

namespace {

/// Quantile z of the standard normal law with P(|x| < z) = level, by bisection of erf.
double two_sided_quantile(double level) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erf(middle / std::sqrt(2.0)) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

const StaySettings* settings_of(const Conditioned& conditioned, const IdentificationConfig& config) {
  const auto at = std::find_if(config.stays.begin(), config.stays.end(), [&](const StaySettings& stay) {
    return stay.name == conditioned.setup || stay.name == conditioned.channels.front().point ||
           stay.name == conditioned.channels.front().name;
  });
  return at == config.stays.end() ? nullptr : &*at;
}

}  // namespace

IdentificationConfig stay_settings(const IdentificationConfig& config) {
  IdentificationConfig own = config;
  own.references.clear();
  own.exclude.clear();
  own.method = "covariance";
  own.block_rows = config.stay_block_rows;
  own.maximum_order = config.stay_maximum_order;
  own.lowest_Hz = 0.0;
  own.highest_Hz = 0.0;
  own.periodic.largest_damping = 0.0;  // a taut string's modes are multiples with next to no damping, and no machine's lines
  return own;
}

std::vector<StayResult> identify_stays(const std::vector<Conditioned>& records, const IdentificationConfig& config) {
  const IdentificationConfig own = stay_settings(config);
  std::vector<StayResult> stays;
  for (const Conditioned& conditioned : records) {
    const sysid::Identification found = identify_modes(conditioned, own);
    StayResult result;
    const StaySettings* settings = settings_of(conditioned, config);
    result.stay = settings != nullptr ? settings->name : conditioned.setup;
    result.condition = conditioned.condition;
    result.length_m = settings != nullptr ? settings->length_m : 0.0;
    result.quality = conditioned.quality;
    std::vector<double> frequencies;
    for (const sysid::Cluster& mode : found.modes) frequencies.push_back(mode.frequency_Hz);
    std::vector<sysid::Harmonic> harmonics;
    for (const auto& [at, number] : sysid::number_harmonics(frequencies, config.stay_lowest_Hz, config.stay_highest_Hz)) {
      if (number > config.stay_harmonics) continue;
      const double deviation = std::max(found.deviations[at].frequency_Hz, 1e-9 * found.modes[at].frequency_Hz);
      result.modes.push_back(
          {number, found.modes[at].frequency_Hz, deviation, found.modes[at].damping_ratio, found.deviations[at].damping_ratio});
      harmonics.push_back({number, found.modes[at].frequency_Hz, deviation});
    }
    result.fitted = harmonics.size() >= 2 && harmonics.back().number >= 2;
    if (result.fitted) {
      result.fit =
          sysid::fit_stay(harmonics, result.length_m > 0.0 ? result.length_m : 1.0, two_sided_quantile(config.stay_level));
    }
    stays.push_back(std::move(result));
  }
  return stays;
}

void write_stays(const std::vector<StayResult>& stays, double level, const std::filesystem::path& folder) {
  io::CsvWriter modes(
      {"stay", "condition", "harmonic", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"});
  io::CsvWriter tensions({"stay", "condition", "length_m", "c_Hz", "c_low_Hz", "c_high_Hz", "tension_per_mass_m2_s2",
                          "tension_per_mass_low_m2_s2", "tension_per_mass_high_m2_s2", "lambda_squared", "lambda_squared_low",
                          "lambda_squared_high", "bending", "bending_std", "harmonics", "level"});
  for (const StayResult& stay : stays) {
    for (const StayResult::Mode& mode : stay.modes) {
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

std::vector<std::vector<io::Cell>> stay_rows(const std::vector<StayResult>& stays) {
  std::vector<std::vector<io::Cell>> rows;
  for (const StayResult& stay : stays) {
    for (const StayResult::Mode& mode : stay.modes) {
      rows.push_back({"stay_frequency_Hz", std::to_string(mode.harmonic), stay.stay, stay.condition, mode.frequency_Hz,
                      mode.frequency_std_Hz});
    }
  }
  return rows;
}

}  // namespace twindeck::steps
