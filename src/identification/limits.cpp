#include "identification/limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr long kFewestBlocks = 8;      // deviations from fewer blocks are known to worse than 30 %
constexpr long kFewestBlockRows = 10;  // with fewer, hardly one mode can be identified
constexpr long kSpectrumSegment = 64;  // [samples] shortest useful segment of a spectrum

/// Samples that a block needs for each block row: twice the number of lags, and there are two lags per row
/// (signal::correlations).
constexpr long kSamplesPerRow = 4;

/// Samples that input-output identification needs for each block row (identify_input_output).
long samples_per_row_with_inputs(const Conditioned& conditioned) {
  return static_cast<long>(4 * (conditioned.channels.size() + conditioned.inputs.size()) + 2);
}

}  // namespace

CarriedLimits carried_by(const Conditioned& conditioned, const IdentificationSettings& config) {
  const long n = shortest_record(conditioned.records);
  const bool with_inputs = !conditioned.excitation.empty();
  // A configuration with smaller values is respected.
  const long fewest_rows = std::min(config.block_rows, kFewestBlockRows), blocks = std::min(config.blocks, kFewestBlocks);
  const long identified = fewest_rows * (with_inputs ? samples_per_row_with_inputs(conditioned) : kSamplesPerRow * blocks);
  const long least = std::max(identified, std::min(config.welch_segment, kSpectrumSegment));
  if (n < least)
    throw UnusableRecord({conditioned.files.front(), 0, ""},
                         fmt::format("has {} samples after decimation, expected at least {}", n, least),
                         "give a longer record, or a smaller decimation");
  IdentificationSettings own = config;
  std::vector<std::string> changed;
  const auto lower = [&changed](const char* name, long& limit, long to) {
    if (limit <= to) return;
    changed.push_back(fmt::format("{} {} -> {}", name, limit, to));
    limit = to;
  };
  if (with_inputs) {
    lower("block_rows", own.block_rows, n / samples_per_row_with_inputs(conditioned));
  } else {
    lower("blocks", own.blocks, std::max(blocks, n / (kSamplesPerRow * config.block_rows)));
    lower("block_rows", own.block_rows, n / (kSamplesPerRow * own.blocks));
  }
  // An order too large for the configured block rows is a mistake in the configuration, and is refused later. If the block rows
  // were lowered, or the order is the default, the order is lowered too.
  if (own.block_rows < config.block_rows || config.order_is_default) {
    const auto rows = static_cast<Index>(own.block_rows), outputs = static_cast<Index>(conditioned.channels.size());
    const auto references = static_cast<Index>(conditioned.references.size());
    const Index most = with_inputs ? (rows - 1) * outputs : std::min((rows - 1) * outputs, rows * references);
    lower("maximum_order", own.maximum_order, std::max<long>(2, static_cast<long>(most)));
    lower("minimum_order", own.minimum_order, own.maximum_order);
  }
  lower("welch_segment", own.welch_segment, n);
  if (changed.empty()) return {own, ""};
  return {own, fmt::format("setup {}: {} has {} samples, {} channels and {} references, too few for all limits: {}",
                           conditioned.setup, conditioned.files.front(), n, conditioned.channels.size(),
                           conditioned.references.size(), fmt::join(changed, ", "))};
}

}  // namespace twindeck::identification
