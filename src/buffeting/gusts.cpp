#include "buffeting/gusts.hpp"

#include <cmath>
#include <utility>

namespace twindeck::buffeting {

using Eigen::Index;

Gusts::Gusts(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config, double speed_m_s,
             double step_s)
    : before_(config.repeats() ? 0 : static_cast<Index>(std::llround(config.lead_in_s / step_s))) {
  wind::SimulationOptions options;
  options.duration_s = config.duration_s;
  options.rate_Hz = 1.0 / step_s;
  options.cutoff_Hz = config.cutoff_Hz;
  options.anchors = static_cast<int>(config.anchors);
  options.frequencies = config.repeats() ? wind::Frequencies::single : wind::Frequencies::double_indexed;
  for (wind::FieldDefinition& field : fields_at_nodes(bridge, set, config, speed_m_s))
    simulators_.emplace_back(std::move(field), options);
}

Eigen::MatrixXd Gusts::sample(std::uint64_t seed) const {
  const Index strips = simulators_.front().field().size();
  Eigen::MatrixXd gusts(before_ + simulators_.front().n_samples(), std::ssize(simulators_) * strips);
  for (Index k = 0; k < std::ssize(simulators_); ++k)
    gusts.middleCols(k * strips, strips) = simulators_[static_cast<std::size_t>(k)].sample(seed, before_);
  return gusts;
}

}  // namespace twindeck::buffeting
