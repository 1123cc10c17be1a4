#pragma once

#include <filesystem>

#include "records/universal.hpp"

namespace twindeck::records {

/// Writes sets 151, 164 (SI), 2411, 2412, 82 and a set 55 a result, in text.
void write_universal(const UniversalData& data, const std::filesystem::path& file);

}  // namespace twindeck::records
