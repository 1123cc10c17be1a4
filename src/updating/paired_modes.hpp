#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/comparison.hpp"
#include "matching/measured.hpp"
#include "matching/pairing_account.hpp"
#include "updating/updating.hpp"
#include "updating/updating_settings.hpp"

namespace twindeck::updating {

/// matching::pair_as_configured. Says where a list of pairs is not used.
/// @throws InputError  as there, or where no pair is left
[[nodiscard]] matching::Pairing pair_for_updating(Reporter& reporter, const UpdatingSettings& config,
                                                  const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes,
                                                  const matching::Measured& measured);

[[nodiscard]] std::vector<FrequencyTarget> frequency_targets(const matching::Measured& measured,
                                                             const matching::Pairing& pairing);

/// Computes the prestress for given parameter values; empty for a matrix model. Holds a reference to `loaded`.
[[nodiscard]] Refresh prestress_refresh(const dynamics::LoadedModel& loaded);

/// The same measured modes with the computed modes that the updating followed them to, and MAC where shapes were measured
/// (that of the common subspace where close modes have turned into each other, as before the updating).
/// @param before  the pairing that the targets came from
[[nodiscard]] matching::Pairing followed_pairing(const UpdatingSettings& config, const matching::Pairing& before,
                                                 const UpdatingResult& result, const dynamics::LoadedModel& after,
                                                 const dynamics::EigenModes& modes, const matching::Measured& measured);

/// Quality of the followed pairs after the updating. Warns where shapes disagree. Shapes that disagreed before and agree now
/// confirm the pairs.
[[nodiscard]] matching::PairingAccount account_after(Reporter& reporter, const matching::Pairing& followed,
                                                     const dynamics::EigenModes& modes, const matching::Measured& measured);

/// "mean |error| of 9 pairs: 5.12 % before, 0.04 % after; 1 of 10 measured modes unpaired, worst MAC 0.93 (4X-4N)".
[[nodiscard]] std::string summary_line(const std::vector<matching::ComparisonRow>& comparison,
                                       const matching::PairingAccount& account);

}  // namespace twindeck::updating
