#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "fe/cable.hpp"
#include "fe/model.hpp"
#include "ponte/virtual_bridge/campaign_settings.hpp"
#include "sensors/layout.hpp"
#include "transient/reduced_basis.hpp"
#include "transient/sliding_damper.hpp"

/// The as-built truth on which the test campaign is simulated: a bridge with its own mesh, cables that vibrate, dampers with
/// friction. It takes the definition of the bridge and the campaign's settings; it gives states, records and what is true about
/// them.
namespace twindeck::ponte {

struct VirtualBridge {
  fe::Model undivided;          ///< of the definition, slabs uneven, stays single elements
  Eigen::Index n_deck = 0;      ///< free dofs of `undivided`, which `numbered` counts: those of the chains come after them
  Eigen::VectorXd uncorrected;  ///< (n_parameters) as the definition has them
};

/// Reads the definition, makes the slabs uneven, and gives members and masses zones.
/// @param definition  file of the bridge, which the settings name
/// @throws InputError  for a definition that is not sound
[[nodiscard]] VirtualBridge read_virtual_bridge(const std::filesystem::path& definition, const CampaignSettings& settings);

/// The same with its free dofs counted. @throws InputError  for a mechanism
[[nodiscard]] VirtualBridge numbered(VirtualBridge bridge);

/// Parameters from corrections.csv (`parameter,factor`); all 1 if `file` is empty.
[[nodiscard]] Eigen::VectorXd corrected_parameters(const VirtualBridge& bridge, const std::filesystem::path& file);

/// The bridge in one state: stays hanging under the pulls of these parameters, and its modes.
struct BridgeState {
  fe::StayChains chains;
  fe::ParametricSystem system;
  Eigen::VectorXd theta;
  dynamics::EigenModes modes;
  Eigen::MatrixXd mass_shapes;  ///< M Phi
  /// Position of each named mode: of those with less than half of their kinetic energy in the stays the nearest in frequency.
  std::vector<Eigen::Index> named;
  Eigen::VectorXd stay_share;  ///< (n_modes) of kinetic energy in the stays
};

/// Parameters at another temperature.
[[nodiscard]] Eigen::VectorXd at_temperature(const VirtualBridge& bridge, const CampaignSettings& settings,
                                             Eigen::VectorXd theta, double temperature_C);

/// States of the bridge by temperature [°C]: those of all conditions and of the reference, each solved once.
/// @param theta  corrected parameters at the reference temperature
/// @throws InputError  where the named frequencies are not those of the settings within 0.2 %: stale corrections
[[nodiscard]] std::map<double, BridgeState> solve_states(const VirtualBridge& bridge, const CampaignSettings& settings,
                                                         const Eigen::VectorXd& theta);

/// Damping ratios imposed on the modes: Table 4's for the named, for the others a mean of structure and stays by kinetic
/// energy.
[[nodiscard]] Eigen::VectorXd imposed_damping(const BridgeState& state, const CampaignSettings& settings);

/// Displacements of the modes or other vectors at channels. @param x (n × m) over free dofs @return (n_channels × m)
[[nodiscard]] Eigen::MatrixXd at_channels(const BridgeState& state, const Eigen::MatrixXd& x,
                                          const std::vector<sensors::LayoutChannel>& channels);

/// Fits corrections so that the named frequencies are the wanted ones: regularised Gauss-Newton on ln f with analytic
/// derivatives, which keeps the logarithms of the corrections small. Pulls are found anew at every step.
/// @return parameters; status not converged if a frequency is off by more than a tenth of the 0.2 % allowed
struct BridgeTuning {
  Eigen::VectorXd theta;
  Eigen::VectorXd error;  ///< relative, of the named frequencies
  Status status;
};
[[nodiscard]] BridgeTuning tune(const VirtualBridge& bridge, const CampaignSettings& settings, const Reporter& reporter);

}  // namespace twindeck::ponte
