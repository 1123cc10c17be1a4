#include "updating/paired_modes.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace twindeck::updating {

matching::Pairing pair_for_updating(Reporter& reporter, const UpdatingSettings& config, const dynamics::LoadedModel& loaded,
                                    const dynamics::EigenModes& modes, const matching::Measured& measured) {
  if (measured.modes.has_shapes() && !config.pairs.empty())
    reporter.say("`pairs` is not used: shapes were measured, and modes are paired by their MAC");
  matching::Pairing pairing = matching::pair_as_configured(reporter, config, measured, loaded, modes, {"", 0, "pairs"});
  if (pairing.pairs.empty())
    throw InputError({measured.source, 0, ""}, "no measured mode has a computed partner",
                     "check frequencies and pairs, or raise maximum_frequency_error");
  return pairing;
}

std::vector<FrequencyTarget> frequency_targets(const matching::Measured& measured, const matching::Pairing& pairing) {
  std::vector<FrequencyTarget> targets;
  for (const matching::ModePair& pair : pairing.pairs)
    targets.push_back(
        {measured.labels[static_cast<std::size_t>(pair.experimental)] + "-" + matching::numerical_label(pair.numerical),
         static_cast<int>(pair.numerical), measured.modes.frequency_Hz(pair.experimental)});
  return targets;
}

Refresh prestress_refresh(const dynamics::LoadedModel& loaded) {
  if (!loaded.structure) return {};
  return
      [structure = loaded.structure](const Eigen::VectorXd& theta) { return structure->system(structure->prestress(theta)); };
}

matching::Pairing followed_pairing(const UpdatingSettings& config, const matching::Pairing& before,
                                   const UpdatingResult& result, const dynamics::LoadedModel& after,
                                   const dynamics::EigenModes& modes, const matching::Measured& measured) {
  matching::Pairing pairing = before;
  if (measured.modes.has_shapes()) {
    const matching::Pairing now = matching::pair_at_sensors(measured, after, modes, config, config.sensor_tolerance_m);
    pairing.mac = now.mac;
    pairing.likeness = now.likeness;
    pairing.shapes = now.shapes;
  }
  for (std::size_t i = 0; i < pairing.pairs.size(); ++i) {
    matching::ModePair& pair = pairing.pairs[i];
    pair.numerical = result.mode_after.at(i);
    if (pairing.mac.size() == 0) continue;
    // Same measure as before the updating: close modes that have rotated into each other count by their common subspace.
    pair.mac = pairing.likeness(pair.numerical, pair.experimental);
    pair.clustered = pair.mac > pairing.mac(pair.numerical, pair.experimental);
  }
  return pairing;
}

matching::PairingAccount account_after(Reporter& reporter, const matching::Pairing& followed, const dynamics::EigenModes& modes,
                                       const matching::Measured& measured) {
  const matching::PairingAccount account = matching::account_of(measured, followed, modes.frequency_Hz);
  matching::warn_of_pairing(reporter, account, std::nullopt, "after the updating");
  return account;
}

std::string summary_line(const std::vector<matching::ComparisonRow>& comparison, const matching::PairingAccount& account) {
  return fmt::format("mean |error| of {} pairs: {:.2f} % before, {:.2f} % after{}", comparison.size() / 2,
                     matching::mean_abs_error_pct(comparison, "before"), matching::mean_abs_error_pct(comparison, "after"),
                     matching::pairing_words(account));
}

}  // namespace twindeck::updating
