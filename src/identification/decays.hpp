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
  std::string note;      ///< lowered limits of short records, and poles that were left out; empty for none
  /// A mode's frequency and damping by amplitude.
  struct ByAmplitude {
    std::string mode;  ///< name in the condition's modes.csv, empty if the mode is not there
    std::string record;
    std::size_t found = 0;  ///< position among the modes of `found`; its frequency sets the filter
    std::vector<AmplitudePoint> points;
  };
  std::vector<ByAmplitude> by_amplitude;
};

/// The mode of the ambient records that a mode of a free decay corresponds to.
struct AmbientPartner {
  std::size_t mode = 0;  ///< position among the condition's modes
  double mac = 0.0;      ///< over the channels that both have
};
/// Finds the ambient mode of the same condition with the nearest shape, MAC above 0.8 and frequency within 10 %.
/// @param channels  of the shape  @param ambient  null for a condition without ambient records
[[nodiscard]] std::optional<AmbientPartner> partner_of(const Cluster& mode,
                                                       const std::vector<records::CampaignChannel>& channels,
                                                       const ConditionResult* ambient);
/// The condition of that name; null if there is none.
[[nodiscard]] const ConditionResult* condition_named(const std::vector<ConditionResult>& results, const std::string& name);
/// Quantity of the channel with the shape's largest component.
[[nodiscard]] std::string quantity_at_largest(const std::vector<records::CampaignChannel>& channels,
                                              const Eigen::VectorXcd& shape);

/// Motion of a mode in the ambient records of the first setup that has it.
struct AmbientAmplitude {
  std::string condition, setup;
  std::size_t mode = 0;    ///< position among the condition's modes
  double amplitude = 0.0;  ///< sqrt(2) times the modal RMS, at the channel of the shape's largest component
  std::string quantity;    ///< of that channel
  double seconds = 0.0;    ///< of the records
};
[[nodiscard]] std::vector<AmbientAmplitude> ambient_amplitudes(const std::vector<ConditionResult>& results,
                                                               const IdentificationSettings& config);

/// Makes the decays the main result of their conditions, if there are no ambient records: modes of ERA, setups merged. Names
/// the modes in `by_amplitude`. Spectra stay empty, because the spectrum of a decay depends on its length.
[[nodiscard]] std::vector<ConditionResult> decay_conditions(std::vector<DecayResult>& decays);

/// ERA of the records of kind free_decay, and frequency and damping by amplitude of the modes that it finds.
/// @param results  conditions identified from ambient records, for the names of modes
[[nodiscard]] std::vector<DecayResult> identify_free_decays(const std::vector<Conditioned>& records,
                                                            const IdentificationSettings& config,
                                                            const std::vector<ConditionResult>& results, std::uint64_t seed);

}  // namespace twindeck::identification
