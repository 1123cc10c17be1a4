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

class Limits {
 public:
  explicit Limits(const IdentificationSettings& config) : config_(config) {}
  void lower(const char* name, long IdentificationSettings::*limit, long to) {
    if (config_.*limit <= to) return;
    changed_.push_back(fmt::format("{} {} -> {}", name, config_.*limit, to));
    config_.*limit = to;
  }
  [[nodiscard]] const IdentificationSettings& config() const { return config_; }
  [[nodiscard]] const std::vector<std::string>& changed() const { return changed_; }

 private:
  IdentificationSettings config_;
  std::vector<std::string> changed_;
};

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
  Limits limits(config);
  if (with_inputs) {
    limits.lower("block_rows", &IdentificationSettings::block_rows, n / samples_per_row_with_inputs(conditioned));
  } else {
    limits.lower("blocks", &IdentificationSettings::blocks, std::max(blocks, n / (kSamplesPerRow * config.block_rows)));
    limits.lower("block_rows", &IdentificationSettings::block_rows, n / (kSamplesPerRow * limits.config().blocks));
  }
  // An order too large for the configured block rows is a mistake in the configuration, and is refused later. If the block rows
  // were lowered, or the order is the default, the order is lowered too.
  if (limits.config().block_rows < config.block_rows || config.order_is_default) {
    const auto rows = static_cast<Index>(limits.config().block_rows), outputs = static_cast<Index>(conditioned.channels.size());
    const auto references = static_cast<Index>(conditioned.references.size());
    const Index most = with_inputs ? (rows - 1) * outputs : std::min((rows - 1) * outputs, rows * references);
    limits.lower("maximum_order", &IdentificationSettings::maximum_order, std::max<long>(2, static_cast<long>(most)));
    limits.lower("minimum_order", &IdentificationSettings::minimum_order, limits.config().maximum_order);
  }
  limits.lower("welch_segment", &IdentificationSettings::welch_segment, n);
  if (limits.changed().empty()) return {limits.config(), ""};
  return {limits.config(), fmt::format("setup {}: {} has {} samples, {} channels and {} references, too few for all limits: {}",
                                       conditioned.setup, conditioned.files.front(), n, conditioned.channels.size(),
                                       conditioned.references.size(), fmt::join(limits.changed(), ", "))};
}

}  // namespace twindeck::identification
