#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "aero/wind_model.hpp"
#include "ponte/virtual_bridge/virtual_bridge.hpp"
#include "transient/trapezoidal.hpp"
#include "wind/turbulence.hpp"

/// Time histories of the virtual bridge, and what is true about them.
namespace twindeck::ponte {

/// The bridge in a condition, in the basis in which its motion is computed.
struct ConditionModel {
  const ConditionSettings* settings = nullptr;
  const BridgeState* state = nullptr;
  transient::ReducedBasis basis;  ///< modes, and after them static corrections for the dampers
  Eigen::Index n_modes = 0;
  Eigen::VectorXd damping;  ///< (r) imposed ratios
  std::vector<std::string> damper_names;
  std::vector<transient::SlidingDamper> dampers;  ///< empty where none are fitted
  Eigen::MatrixXd at_dampers;                     ///< (n_dampers × r)
  /// (n_modes × n_loads) modal loads of unit loads, times their density [N/sqrt(Hz)]: at nodes of decks, mast and stays, in
  /// three directions each, in the order of the layout and of the stays' names. Random numbers are drawn at the nodes, so that
  /// a record depends neither on signs of modes nor on the basis of a repeated frequency.
  Eigen::MatrixXd loads;
  Eigen::MatrixXd load_covariance;  ///< (r × r) of the modal loads per Hz, one-sided [N²/Hz over kg]
};
[[nodiscard]] ConditionModel condition_model(const CampaignSettings& settings, const ConditionSettings& condition,
                                             const BridgeState& state, const std::vector<sensors::LayoutPoint>& points);

/// Motion at the channels as it really was, before any logger.
struct Motion {
  Eigen::MatrixXd acceleration_m_s2;   ///< (n_samples × n_channels), the second half of the channels lagging
  Eigen::MatrixXd damper_force_N;      ///< (n_steps × n_dampers)
  Eigen::VectorXd rms_displacement_m;  ///< (n_channels)
};

/// Ambient: the loads of the condition from rest, its first 100 s left out. Free decay: the static displacement under the hung
/// mass, let go at the first sample, loads as before. Trapezoidal rule, settings.substeps steps a sample; loads are white
/// numbers at the sampling rate, one a node and direction, joined by straight lines.
/// @param stream  of random numbers: one a record
[[nodiscard]] Motion simulate(const ConditionModel& model, const CampaignSettings& settings, const RecordSettings& record,
                              const std::vector<sensors::LayoutChannel>& channels,
                              const std::vector<sensors::LayoutPoint>& points, std::uint64_t seed, std::uint64_t stream);

/// What the loggers made of a motion [m/s²] (n_samples × n_channels): noise, steps, range and drift of the settings.
/// @param record  number of the record, which has random streams of its own
[[nodiscard]] Eigen::MatrixXd logged_record(const Motion& motion, const CampaignSettings& settings, std::uint64_t seed,
                                            std::uint64_t record);

/// True modes of a condition: of the bridge as it is, or with its dampers linearised at the forces of a record.
struct TrueModes {
  std::vector<std::string> name;  ///< of the named mode that it still is for at least a fifth, "" for others
  Eigen::VectorXd frequency_Hz, damping_ratio, stay_share;
  Eigen::MatrixXcd shapes;  ///< (r × n) in the basis, unit norm
  Eigen::VectorXd slip;     ///< (n_dampers) [m/(N s)]
};
[[nodiscard]] TrueModes true_modes(const ConditionModel& model, const CampaignSettings& settings,
                                   const Eigen::MatrixXd& damper_force_N, double highest_Hz);

/// Largest share, over the channels, that each mode has in the variance of the acceleration under the condition's loads:
/// variance at c of mode i  |phi_ci|² · phi_i^H S phi_i · pi f_i / (4 zeta_i). @return (n_modes)
[[nodiscard]] Eigen::VectorXd participation(const ConditionModel& model, const TrueModes& modes,
                                            const Eigen::MatrixXd& channel_shapes);

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
