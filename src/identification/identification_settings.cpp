#include "identification/identification_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace twindeck::identification {

namespace {

double highest_of(const IdentificationSettings& config, double rate_Hz) {
  const double nyquist = 0.5 * rate_Hz;
  if (config.highest_Hz > nyquist || config.lowest_Hz >= (config.highest_Hz > 0.0 ? config.highest_Hz : 0.8 * nyquist))
    throw InputError({"", 0, "band.highest"},
                     fmt::format("the band {} to {} Hz does not lie below {} Hz, the Nyquist frequency after decimation",
                                 config.lowest_Hz, config.highest_Hz, nyquist),
                     "change the band, or decimate less");
  return config.highest_Hz > 0.0 ? config.highest_Hz : 0.8 * nyquist;
}

}  // namespace

int derivative(const std::string& quantity) { return quantity == "acceleration" ? 2 : quantity == "velocity" ? 1 : 0; }

IdentifyOptions IdentificationSettings::options(double rate_Hz, const std::vector<records::CampaignChannel>& channels) const {
  IdentifyOptions options = *this;
  options.minimum_order = std::min(minimum_order, maximum_order);  // free decays and stays have other maximum orders
  options.limits = {lowest_Hz, highest_of(*this, rate_Hz), largest_damping};
  for (const records::CampaignChannel& channel : channels)
    options.automatic.derivatives.push_back(derivative(channel.quantity));
  return options;
}

}  // namespace twindeck::identification
