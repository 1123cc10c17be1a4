#pragma once

#include <cstdint>
#include <vector>

#include "aero/wind_model.hpp"
#include "ponte/virtual_bridge/simulated_records.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::ponte {

/// Wind events of the virtual bridge: what they rest on, read once.
struct VirtualWind {
  aero::WindSettings aerodynamics;  ///< decks and air
  std::vector<aero::DeckAerodynamics> data;
  wind::TurbulenceSet turbulence;
};

/// Accelerations in a wind event: turbulence of the record's mean speed and direction on the aerodynamic nodes of the virtual
/// bridge, quasi-steady gust forces and self-excited forces by the settings' rule, sliding dampers. The gusts repeat after the
/// record, so that the warm-up before it is their own end. Self-excited forces are those of the motion one step before (5 ms;
/// their phase then lags by 2 % of a radian at the first mode), derivatives frozen at that mode's frequency.
/// @param stream  of random numbers: one a record
[[nodiscard]] Motion simulate_wind(const ConditionModel& model, const CampaignSettings& settings, const RecordSettings& record,
                                   const VirtualWind& virtual_wind, const std::vector<sensors::LayoutChannel>& channels,
                                   std::uint64_t seed, std::uint64_t stream);

}  // namespace twindeck::ponte
