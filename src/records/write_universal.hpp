#pragma once

#include <filesystem>

#include "records/record.hpp"
#include "records/universal.hpp"

namespace twindeck::records {

/// Writes sets 151, 164 (SI), 2411, 82 and a set 55 a result, in text.
void write_universal(const UniversalData& data, const std::filesystem::path& file);

/// A time series as set 58 (text) or 58b (binary, little-endian): one channel after another.
/// @param samples (n_samples × n_channels)
void write_universal_series(const RecordInfo& info, const Eigen::MatrixXd& samples, bool binary,
                            const std::filesystem::path& file);

}  // namespace twindeck::records
