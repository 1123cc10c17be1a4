#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "wind/simulation.hpp"

namespace twindeck::buffeting {

/// Samples of the gusts at the aerodynamic nodes in a mean wind.
class Gusts {
 public:
  /// @param step_s  of the samples @throws InputError  as wind::Simulator
  Gusts(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config, double speed_m_s,
        double step_s);
  /// @return [m/s] (n_steps × n_components n_strips) in the order of the load's columns. With double-indexed frequencies a
  /// sample does not repeat after the record: the steps of the run-up come first
  [[nodiscard]] Eigen::MatrixXd sample(std::uint64_t seed) const;
  /// One a component. Their samples are those of `sample`.
  [[nodiscard]] const std::vector<wind::Simulator>& simulators() const { return simulators_; }
  [[nodiscard]] Eigen::Index before() const { return before_; }

 private:
  std::vector<wind::Simulator> simulators_;
  Eigen::Index before_;
};

}  // namespace twindeck::buffeting
