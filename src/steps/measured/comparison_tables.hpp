#pragma once

#include <filesystem>
#include <vector>

#include "matching/comparison.hpp"

/// Tables of measured against computed modes, which s4_refinement and s6_updating write.
namespace twindeck::steps {

/// comparison.csv, one row a pair and stage.
void write_comparison(const std::vector<matching::ComparisonRow>& rows, const std::filesystem::path& folder);
/// mac.csv: header only where no shape was measured, `mac` empty of a mode that was measured at one channel.
void write_mac(const matching::Measured& measured, const matching::Pairing& pairing, const std::filesystem::path& folder);
/// pairs.csv: `experimental_mode,numerical_mode,mac,clustered` (0 or 1).
void write_pairs(const matching::Measured& measured, const matching::Pairing& pairing, const std::filesystem::path& folder);

}  // namespace twindeck::steps
