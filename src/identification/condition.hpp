#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "identification/identification.hpp"
#include "identification/merge_poser.hpp"
#include "identification/merge_preger.hpp"

namespace twindeck::identification {

/// One setup of a condition, identified.
struct SetupResult {
  Conditioned conditioned;
  IdentificationSettings limits;  ///< the configuration, with limits lowered to the length of the records
  Identification found;
  signal::PowerSpectra spectra;
  SingularSpectra singular;
};

/// All setups of a condition.
struct ConditionResult {
  std::string condition;
  std::vector<records::CampaignChannel> channels;  ///< of all setups, in the order of their first appearance
  std::vector<SetupResult> setups;
  std::vector<MergedMode> modes;     ///< ascending in frequency
  std::vector<MergingCheck> checks;  ///< one a mode where there are several setups
  bool of_decays = false;            ///< ERA's modes of free decays (decays.hpp): no spectra
};

/// Reads the records of each setup and prepares them; nothing is identified yet. A setup whose records cannot be used is left
/// out with a warning, as long as another is left.
/// @param groups  of one condition
/// @throws InputError  as condition_records; without a common reference, or for setups of two rates that are to be merged
///         before identification @throws UnusableRecord  if no setup is left
[[nodiscard]] ConditionResult read_condition(const records::Campaign& campaign, const std::vector<records::RecordGroup>& groups,
                                             const IdentificationSettings& config, Reporter& reporter);

/// Lists the channels of all setups and merges the setups' modes over the common references (PoSER).
/// @throws InputError  without a common reference of several setups
void merge_setups(ConditionResult& result);

/// Identifies each setup, merges the setups, and warns of clocks that lag. Merging before identification needs setups of one
/// rate. With merge = "preger", the shape, frequency and damping of a mode are PreGER's if PreGER has the mode; the deviations
/// then include the difference of both mergings (take_preger).
/// @param result  as read_condition gives it
void identify_condition(ConditionResult& result, const IdentificationSettings& config, Reporter& reporter);

}  // namespace twindeck::identification
