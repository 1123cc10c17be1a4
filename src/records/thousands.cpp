#include "records/thousands.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace twindeck::records {

void refuse_thousands(const std::vector<std::vector<std::string_view>>& rows, const TextLayout& layout,
                      const std::filesystem::path& file) {
  constexpr long least = 10;  // cells with three digits after the sign; decimals of so many cells would include fewer digits
  const char sign = layout.decimal_comma ? ',' : '.';
  for (std::size_t c = 0; c < layout.columns; ++c) {
    long grouped = 0, whole = 0, others = 0;
    for (const auto& row : rows) {
      const std::string_view cell = row[c].substr(row[c].starts_with('-') || row[c].starts_with('+') ? 1 : 0);
      const std::size_t at = cell.find(sign);
      if (cell.empty() || cell == "0") continue;
      const bool small = at == std::string_view::npos && cell.size() <= 3;
      ++(small ? whole : at <= 3 && cell.size() == at + 4 && cell.front() != '0' ? grouped : others);
    }
    if (others > 0 || grouped < least || whole == 0) continue;
    throw InputError({file.string(), layout.first_data_line, ""},
                     fmt::format("column {}: '{}' stands before three digits in each number that has more, and in no other: it "
                                 "parts thousands, not decimals",
                                 c + 1, sign),
                     "write the table again without signs between thousands");
  }
}

}  // namespace twindeck::records
