#pragma once

#include <filesystem>
#include <vector>

#include "identification/quality.hpp"

namespace twindeck::steps {

/// quality.csv: `setup,record,channel,samples,missing,longest_gap,clipped,mean,rms,drift_rms,dead,lag_s,lag_std_s`.
void write_quality(const std::vector<identification::ChannelQuality>& rows, const std::filesystem::path& file);

}  // namespace twindeck::steps
