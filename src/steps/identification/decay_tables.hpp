#pragma once

#include <filesystem>
#include <vector>

#include "identification/decays.hpp"

namespace twindeck::steps {

/// decays.csv: `condition,setup,mode,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct,orders` and the
/// ambient mode it agrees with, `ambient_mode,ambient_frequency_Hz,ambient_frequency_std_Hz,mac` (empty for none).
/// amplitude.csv: `source,condition,setup,record,mode,amplitude,quantity,frequency_Hz,frequency_std_Hz,damping_ratio_pct,
/// damping_ratio_std_pct,seconds`: source free_decay (bands of the envelope) and ambient (one row a mode, amplitude sqrt(2)
/// times the modal RMS), at the channel of the shape's largest component.
void write_decays(const std::vector<identification::DecayResult>& decays,
                  const std::vector<identification::ConditionResult>& results,
                  const identification::IdentificationSettings& config, const std::filesystem::path& folder);

}  // namespace twindeck::steps
