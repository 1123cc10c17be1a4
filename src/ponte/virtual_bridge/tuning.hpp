#pragma once

#include <Eigen/Core>

#include "core/reporter.hpp"
#include "ponte/virtual_bridge/virtual_bridge.hpp"

namespace twindeck::ponte {

/// Fits corrections so that the named frequencies are the wanted ones: regularised Gauss-Newton on ln f with analytic
/// derivatives, logarithms of the corrections as small as can be. Pulls are found anew at every step.
/// @return parameters; status not converged if a frequency is off by more than a tenth of the 0.2 % allowed
struct BridgeTuning {
  Eigen::VectorXd theta;
  Eigen::VectorXd error;  ///< relative, of the named frequencies
  Status status;
};
[[nodiscard]] BridgeTuning tune(const VirtualBridge& bridge, const CampaignSettings& settings, const Reporter& reporter);

}  // namespace twindeck::ponte
