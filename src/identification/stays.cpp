#include "identification/stays.hpp"

#include <algorithm>

#include "identification/limits.hpp"

namespace twindeck::identification {

namespace {

const StaySettings* settings_of(const Conditioned& conditioned, const IdentificationSettings& config) {
  const auto at = std::ranges::find_if(config.stays, [&](const StaySettings& stay) {
    return stay.name == conditioned.setup || stay.name == conditioned.channels.front().point ||
           stay.name == conditioned.channels.front().name;
  });
  return at == config.stays.end() ? nullptr : &*at;
}

StaySection section_of(const StaySettings* settings) {
  StaySection section;
  if (settings == nullptr) return section;
  section.length_m = settings->length_m;
  if (settings->mass_kg_m > 0.0) section.bending_per_mass_m4_s2 = settings->bending_stiffness_N_m2 / settings->mass_kg_m;
  if (settings->ends == "hinged") section.fixity = 0.0;
  if (settings->ends == "clamped") section.fixity = 1.0;
  return section;
}

/// Fit of the modes of a record. If fewer harmonics are configured than found, only those are used.
StayFit stay_fit_of(const Identification& found, const StaySection& section, const IdentificationSettings& config) {
  std::vector<Harmonic> frequencies;
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    const double f = found.modes[m].frequency_Hz;
    frequencies.push_back({0, f, std::max(found.deviations[m].frequency_Hz, 1e-9 * f)});
  }
  StayFit fit = fit_stay(frequencies, section, config.stay_level, config.stay_lowest_Hz, config.stay_highest_Hz);
  Numbering kept = fit.numbering;
  while (!kept.harmonics.empty() && kept.harmonics.back().number > config.stay_harmonics) {
    kept.harmonics.pop_back();
    kept.positions.pop_back();
  }
  if (kept.harmonics.size() == fit.numbering.harmonics.size()) return fit;
  StayFit fewer;
  if (kept.harmonics.size() >= 2) fewer = fit_numbered(kept.harmonics, section, config.stay_level);
  fewer.numbering = kept;
  fewer.others = fit.others;
  return fewer;
}

}  // namespace

IdentificationSettings stay_settings(const IdentificationSettings& config) {
  IdentificationSettings own = config;
  own.references.clear();
  own.exclude.clear();
  own.method = "covariance";
  own.decimation = config.stay_decimation;
  own.block_rows = config.stay_block_rows;
  own.maximum_order = config.stay_maximum_order;
  own.order_is_default = true;  // few stays have twenty modes, so a lowered order is no loss
  own.lowest_Hz = 0.0;
  own.highest_Hz = 0.0;
  own.periodic.largest_damping = 0.0;  // a taut string's modes are no machine's lines
  return own;
}

std::vector<StayResult> identify_stays(const std::vector<Conditioned>& records, const IdentificationSettings& config) {
  const IdentificationSettings own = stay_settings(config);
  std::vector<StayResult> stays;
  for (const Conditioned& conditioned : records) {
    StayResult result;
    IdentificationSettings limits = own;
    if (conditioned.block_rows > 0) limits.block_rows = conditioned.block_rows;
    CarriedLimits carried = carried_by(conditioned, limits);
    limits = std::move(carried.config);
    result.note = std::move(carried.note);
    const Identification found = identify_modes(conditioned, limits);
    const StaySettings* settings = settings_of(conditioned, config);
    result.stay = settings != nullptr ? settings->name : conditioned.setup;
    result.condition = conditioned.condition;
    result.length_m = settings != nullptr ? settings->length_m : 0.0;
    result.quality = conditioned.quality;
    result.fit = stay_fit_of(found, section_of(settings), config);
    const Numbering& numbering = result.fit.numbering;
    for (std::size_t i = 0; i < numbering.harmonics.size(); ++i) {
      const std::size_t at = numbering.positions[i];
      const Harmonic& h = numbering.harmonics[i];
      result.modes.push_back(
          {h.number, h.frequency_Hz, h.deviation_Hz, found.modes[at].damping_ratio, found.deviations[at].damping_ratio});
    }
    result.fitted = numbering.harmonics.size() >= 2;
    stays.push_back(std::move(result));
  }
  return stays;
}

}  // namespace twindeck::identification
