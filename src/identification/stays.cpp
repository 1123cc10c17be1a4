#include "identification/stays.hpp"

#include <algorithm>
#include <cmath>

#include "core/distributions.hpp"
#include "core/error.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

const StaySettings* settings_of(const Conditioned& conditioned, const IdentificationSettings& config) {
  const auto at = std::find_if(config.stays.begin(), config.stays.end(), [&](const StaySettings& stay) {
    return stay.name == conditioned.setup || stay.name == conditioned.channels.front().point ||
           stay.name == conditioned.channels.front().name;
  });
  return at == config.stays.end() ? nullptr : &*at;
}

}  // namespace

IdentificationSettings stay_settings(const IdentificationSettings& config) {
  IdentificationSettings own = config;
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

std::vector<StayResult> identify_stays(const std::vector<Conditioned>& records, const IdentificationSettings& config) {
  const IdentificationSettings own = stay_settings(config);
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
      sysid::StayModel model;
      model.known_length = result.length_m > 0.0;
      result.fit =
          sysid::fit_stay(harmonics, model.known_length ? result.length_m : 1.0, two_sided_normal_quantile(config.stay_level), model);
    }
    stays.push_back(std::move(result));
  }
  return stays;
}

}  // namespace twindeck::identification
