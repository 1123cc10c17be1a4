#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "identification/amplitude.hpp"
#include "identification/condition.hpp"

namespace twindeck::identification {

/// Free decays of one setup and condition.
struct DecayResult {
  ConditionedInfo conditioned;
  Identification found;  ///< ERA
  std::string note;      ///< limits that the records do not carry; empty for none
  /// A mode's frequency and damping by amplitude.
  struct ByAmplitude {
    std::string mode;  ///< of the condition's modes.csv, empty where it has none
    std::string record;
    std::size_t found = 0;  ///< position of the mode among `found`, whose frequency the filter was set to
    std::vector<AmplitudePoint> points;
  };
  std::vector<ByAmplitude> by_amplitude;
};

/// A mode of the ambient records that a mode of a free decay agrees with.
struct AmbientPartner {
  std::size_t mode = 0;  ///< position among the condition's modes
  double mac = 0.0;      ///< over the channels that both have
};
/// The ambient mode of the same condition nearest in shape (MAC above 0.8) within 10 % in frequency.
/// @param channels  of the shape  @param ambient  null for a condition without ambient records
[[nodiscard]] std::optional<AmbientPartner> partner_of(const Cluster& mode,
                                                       const std::vector<records::CampaignChannel>& channels,
                                                       const ConditionResult* ambient);
/// Null for a name that none has.
[[nodiscard]] const ConditionResult* condition_named(const std::vector<ConditionResult>& results, const std::string& name);
/// Quantity of the channel with the shape's largest component.
[[nodiscard]] std::string quantity_at_largest(const std::vector<records::CampaignChannel>& channels,
                                              const Eigen::VectorXcd& shape);

/// How large a mode's motion is in the ambient records of the first setup that has it.
struct AmbientAmplitude {
  std::string condition, setup;
  std::size_t mode = 0;    ///< position among the condition's modes
  double amplitude = 0.0;  ///< sqrt(2) times the modal RMS, at the channel of the shape's largest component
  std::string quantity;    ///< of that channel
  double seconds = 0.0;    ///< of the records
};
[[nodiscard]] std::vector<AmbientAmplitude> ambient_amplitudes(const std::vector<ConditionResult>& results,
                                                               const IdentificationSettings& config);

/// The decays as the main result of their conditions, where there are no ambient records: ERA's modes, setups merged. Names the
/// modes in `by_amplitude`. Spectra stay empty: a decay has none that hangs not on its length.
[[nodiscard]] std::vector<ConditionResult> decay_conditions(std::vector<DecayResult>& decays);

/// ERA of the records of kind free_decay, and frequency and damping by amplitude of the modes that it finds.
/// @param results  conditions identified from ambient records, for the names of modes
[[nodiscard]] std::vector<DecayResult> identify_free_decays(const std::vector<Conditioned>& records,
                                                            const IdentificationSettings& config,
                                                            const std::vector<ConditionResult>& results, std::uint64_t seed);

}  // namespace twindeck::identification
