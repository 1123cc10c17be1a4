#include "sysid/identify.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "sysid/era.hpp"
#include "sysid/ssi_cov.hpp"
#include "sysid/ssi_data.hpp"

namespace twindeck::sysid {

namespace {

bool is_settled(const Cluster& mode, const ModeDeviation& deviation, const IdentifyOptions& options, double seconds) {
  const double f = mode.frequency_Hz, zeta = std::max(mode.damping_ratio, 1e-6);
  if (options.largest_deviation > 0.0 && deviation.frequency_Hz > options.largest_deviation * f) return false;
  if (options.selection == Selection::paper) return true;
  if (seconds <= 0.0) return options.largest_bandwidth_share <= 0.0 || deviation.frequency_Hz <= options.largest_bandwidth_share * zeta * f;
  const double law = f * std::sqrt(zeta / (2.0 * std::numbers::pi * f * seconds));
  return options.largest_law_ratio <= 0.0 || deviation.frequency_Hz <= options.largest_law_ratio * law;
}

}  // namespace

void drop_undetermined(Identification& result, const IdentifyOptions& options, double seconds) {
  std::vector<int> renumbered(result.modes.size(), -1);
  std::size_t kept = 0;
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    if (!is_settled(result.modes[m], result.deviations[m], options, seconds)) continue;
    renumbered[m] = static_cast<int>(kept);
    if (kept != m) {
      result.modes[kept] = result.modes[m];
      result.deviations[kept] = result.deviations[m];
    }
    ++kept;
  }
  result.modes.resize(kept);
  result.deviations.resize(kept);
  for (DiagramPole& pole : result.diagram) {
    if (pole.mode >= 0) pole.mode = renumbered[static_cast<std::size_t>(pole.mode)];
  }
}

namespace {

Identification select(const ShiftModels& models, const IdentifyOptions& options) {
  const std::vector<int> orders = options.orders();
  Identification result;
  result.diagram = stabilisation_diagram(poles_of(models), options.criteria, options.limits);
  result.modes = options.selection == Selection::paper ? identify_clusters(result.diagram, orders, options.cleaning)
                                                       : automatic_clusters(result.diagram, orders, options.automatic);
  return result;
}

void add_deviations(Identification& result, const Observability& observability, const ShiftModels& models, const Changes& changes,
                    const IdentifyOptions& options, double seconds) {
  const PoleFactors factors = pole_factors(observability, models, changes);
  std::vector<std::vector<Pole>> members;
  for (const Cluster& mode : result.modes) {
    members.emplace_back();
    for (const std::size_t i : mode.members) members.back().push_back(result.diagram[i].pole);
  }
  result.deviations = mode_deviations(models, factors, members);
  drop_undetermined(result, options, seconds);
}

}  // namespace

std::vector<int> IdentifyOptions::orders() const {
  std::vector<int> list;
  for (int order = minimum_order; order <= maximum_order; order += order_step) list.push_back(order);
  TWINDECK_ASSERT(!list.empty());
  return list;
}

Identification identify(const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options) {
  TWINDECK_ASSERT(blocks.n_lags >= 2 * options.block_rows);
  const std::vector<int> orders = options.orders();
  const Observability observability = ssi_cov(blocks.mean(), options.block_rows, blocks.n_outputs, orders.back());
  const ShiftModels models = shift_models(observability, orders, rate_Hz);
  Identification result = select(models, options);
  if (blocks.n_blocks() < 2) return result;
  add_deviations(result, observability, models, covariance_changes(blocks, options.block_rows, observability, models), options,
                 blocks.counts.row(0).sum() / rate_Hz);
  return result;
}

Identification identify_from_data(const std::vector<Eigen::MatrixXd>& records, const std::vector<Eigen::Index>& references,
                                  const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options) {
  const std::vector<int> orders = options.orders();
  std::vector<Eigen::MatrixXd> grams;
  double samples = 0.0;
  for (const Eigen::MatrixXd& record : records) {
    grams.push_back(hankel_gram(record, references, options.block_rows));
    samples += static_cast<double>(record.rows() - 2 * options.block_rows + 1);
  }
  const DataDriven found = ssi_data(grams, samples, static_cast<Eigen::Index>(references.size()), records.front().cols(), options.block_rows,
                                    orders.back());
  grams.clear();
  const ShiftModels models = shift_models(found.observability, orders, rate_Hz);
  Identification result = select(models, options);
  if (blocks.n_blocks() < 2) return result;
  add_deviations(result, found.observability, models, data_changes(blocks, references, options.block_rows, found, models), options,
                 samples / rate_Hz);
  return result;
}

Identification identify_decays(const std::vector<Eigen::MatrixXd>& decays, double rate_Hz, const IdentifyOptions& options, std::uint64_t seed) {
  const FreeDecay found = era(decays, options.block_rows, options.orders(), rate_Hz, seed);
  Identification result = select(found.models, options);
  add_deviations(result, found.observability, found.models, found.changes, options, 0.0);
  return result;
}

}  // namespace twindeck::sysid
