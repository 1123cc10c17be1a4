#include "diagnosis/files/claims_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/csv.hpp"
#include "io/spreadsheet.hpp"

namespace twindeck::diagnosis {

std::vector<Claim> read_claims(const std::filesystem::path& folder) {
  const auto file = folder / "claims.csv";
  std::vector<Claim> claims;
  if (!io::has_table(file)) return claims;
  const auto table = io::CsvTable::read(file, {"kind", "name", "record", "value", "lower", "upper", "source"}, {});
  const std::vector<std::string> kinds = {"parameter_change_pct", "mac", "frequency_error_pct", "rms_error_pct"};
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Claim claim;
    const std::string kind = table.text(r, "kind");
    const auto at = std::find(kinds.begin(), kinds.end(), kind);
    if (at == kinds.end()) table.fail(r, "kind", fmt::format("'{}' is no kind of claim; use {}", kind, fmt::join(kinds, ", ")));
    claim.kind = static_cast<Claim::Kind>(at - kinds.begin());
    claim.name = table.text(r, "name");
    claim.record = table.text(r, "record");
    claim.value = table.number(r, "value");
    claim.source = table.text(r, "source");
    if (claim.kind == Claim::Kind::parameter) {
      claim.lower = table.number(r, "lower");
      claim.upper = table.number(r, "upper");
      if (!(claim.lower < claim.upper)) table.fail(r, "lower", "is not below upper");
    }
    if (claim.kind == Claim::Kind::rms_error && claim.value <= -100.0)
      table.fail(r, "value", fmt::format("is {} %, but nothing computed is below zero", claim.value));
    claims.push_back(claim);
  }
  return claims;
}

}  // namespace twindeck::diagnosis
