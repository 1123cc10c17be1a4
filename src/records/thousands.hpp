#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "records/text_layout.hpp"

namespace twindeck::records {

/// Refuses whole numbers in groups of three ("1,234" beside "999"), which would be read as decimals.
/// @param rows  cells of the table, one vector a row @throws InputError  that names the column
void refuse_thousands(const std::vector<std::vector<std::string_view>>& rows, const TextLayout& layout,
                      const std::filesystem::path& file);

}  // namespace twindeck::records
