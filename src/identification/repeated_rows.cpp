#include "identification/repeated_rows.hpp"

#include <bit>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr Index kWindow = 32;          ///< rows of a window whose hash is looked up
constexpr Index kFewestRepeated = 64;  ///< rows of a repeat
constexpr double kRepeated = 0.01;     ///< [-] least share of the record for a repeat
constexpr Index kPeriods = 8;          ///< repetitions in a row that mean a periodic signal

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {  // the multiplier and shift of SplitMix64
  hash = (hash ^ word) * 0xBF58476D1CE4E5B9U;
  return hash ^ (hash >> 31U);
}

std::vector<std::uint64_t> hashes_of(const Samples& raw) {
  std::vector<std::uint64_t> rows(static_cast<std::size_t>(raw.rows()), 1);
  for (Index c = 0; c < raw.cols(); ++c)
    for (std::size_t t = 0; t < rows.size(); ++t)
      rows[t] = mixed(rows[t], std::bit_cast<std::uint64_t>(raw(static_cast<Index>(t), c)));
  return rows;
}

/// Hash of the window that begins at a row; 0 if half of its rows equal the row before.
std::uint64_t window_at(const std::vector<std::uint64_t>& rows, Index row) {
  std::uint64_t hash = 0;
  Index moves = 0;
  for (auto t = static_cast<std::size_t>(row); t < static_cast<std::size_t>(row + kWindow); ++t) {
    hash = mixed(hash, rows[t]);
    moves += t > 0 && rows[t] != rows[t - 1] ? 1 : 0;
  }
  return 2 * moves > kWindow ? hash : 0;
}

}  // namespace

std::optional<RepeatedRows> RowsSeen::add(const Samples& raw, const std::string& file) {
  files_.push_back(file);
  rows_.push_back(hashes_of(raw));
  const std::vector<std::uint64_t>& rows = rows_.back();
  const Index n = std::ssize(rows);
  RepeatedRows longest;
  for (Index row = 0; row + kWindow <= n; ++row) {
    const std::uint64_t hash = window_at(rows, row);
    const auto seen = hash == 0 ? windows_.end() : windows_.find(hash);
    if (seen == windows_.end()) {
      // Windows at rows 0, 32, 64 … of the first record are enough: every longer repeat contains one of them.
      if (hash != 0 && row % kWindow == 0) windows_[hash] = {rows_.size() - 1, row};
      continue;
    }
    const auto [record, first] = seen->second;
    const std::vector<std::uint64_t>& before = rows_[record];
    const bool own = record + 1 == rows_.size();
    Index begin = 0, length = kWindow;  // rows of the repeat before the window, and from its begin on
    while (first - begin > 0 && row - begin > 0 && (!own || first < row - begin) &&
           before[static_cast<std::size_t>(first - begin - 1)] == rows[static_cast<std::size_t>(row - begin - 1)])
      ++begin;
    while (row + length < n && first + length < std::ssize(before) &&
           before[static_cast<std::size_t>(first + length)] == rows[static_cast<std::size_t>(row + length)])
      ++length;
    const bool periodic = own && length + begin > kPeriods * (row - first);
    if (!periodic && begin + length > longest.length) longest = {files_[record], first - begin, row - begin, begin + length};
    row += length - 1;
  }
  if (longest.length < kFewestRepeated || static_cast<double>(longest.length) < kRepeated * static_cast<double>(n)) return {};
  return longest;
}

}  // namespace twindeck::identification
