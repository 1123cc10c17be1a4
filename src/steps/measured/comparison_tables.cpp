#include "steps/measured/comparison_tables.hpp"

#include "io/csv.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;
using matching::known;

const std::string& label(const matching::Measured& measured, Index i) { return measured.labels[static_cast<std::size_t>(i)]; }

}  // namespace

void write_comparison(const std::vector<matching::ComparisonRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv(
      {"stage", "experimental_mode", "numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "mac", "pairing"});
  for (const matching::ComparisonRow& row : rows)
    csv.row(
        {row.stage, row.experimental, row.numerical, row.measured_Hz, row.computed_Hz, row.error_pct(), row.mac, row.pairing});
  csv.save(folder / "comparison.csv");
}

void write_mac(const matching::Measured& measured, const matching::Pairing& pairing, const std::filesystem::path& folder) {
  io::CsvWriter csv({"experimental_mode", "numerical_mode", "mac"});
  for (Index j = 0; j < pairing.mac.rows(); ++j)
    for (Index i = 0; i < pairing.mac.cols(); ++i)
      csv.row({label(measured, i), matching::numerical_label(j), known(pairing.mac(j, i))});
  csv.save(folder / "mac.csv");
}

void write_pairs(const matching::Measured& measured, const matching::Pairing& pairing, const std::filesystem::path& folder) {
  io::CsvWriter csv({"experimental_mode", "numerical_mode", "mac", "clustered"});
  for (const matching::ModePair& pair : pairing.pairs)
    csv.row({label(measured, pair.experimental), matching::numerical_label(pair.numerical), known(pair.mac),
             pair.clustered ? 1 : 0});
  csv.save(folder / "pairs.csv");
}

}  // namespace twindeck::steps
