#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/evidence.hpp"

namespace twindeck::diagnosis {

/// Claims of a features folder; none where the file is not there.
/// @throws InputError with file, line and column
[[nodiscard]] std::vector<Claim> read_claims(const std::filesystem::path& folder);

}  // namespace twindeck::diagnosis
