#include "sysid/identify.hpp"

#include "core/error.hpp"

namespace twindeck::sysid {
namespace {

void drop_undetermined(Identification& result, double largest_deviation) {
  std::vector<int> renumbered(result.modes.size(), -1);
  std::size_t kept = 0;
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    if (largest_deviation > 0.0 && result.deviations[m].frequency_Hz > largest_deviation * result.modes[m].frequency_Hz) continue;
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

}  // namespace

Identification identify(const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options) {
  TWINDECK_ASSERT(blocks.n_lags >= 2 * options.block_rows);
  std::vector<int> orders;
  for (int order = options.minimum_order; order <= options.maximum_order; order += options.order_step) orders.push_back(order);
  TWINDECK_ASSERT(!orders.empty());

  const Observability observability = ssi_cov(blocks.mean(), options.block_rows, blocks.n_outputs, orders.back());
  Identification result;
  result.diagram = stabilisation_diagram(poles_of_orders(observability, orders, rate_Hz), options.criteria, options.limits);
  result.modes = identify_clusters(result.diagram, orders, options.cleaning);
  if (blocks.n_blocks() < 2) return result;
  std::vector<std::vector<Pole>> members;
  for (const Cluster& mode : result.modes) {
    members.emplace_back();
    for (const std::size_t i : mode.members) members.back().push_back(result.diagram[i].pole);
  }
  result.deviations = jackknife(blocks, options.block_rows, observability, members, rate_Hz);
  drop_undetermined(result, options.largest_deviation);
  return result;
}

}  // namespace twindeck::sysid
