#pragma once

#include <string>
#include <vector>

#include "identification/identify.hpp"
#include "records/campaign_channels.hpp"

namespace twindeck::identification {

/// A stay whose records are read as those of a tensioned beam.
struct StaySettings {
  std::string name;  ///< setup, point or channel of its records
  double length_m = 0.0;
  std::string ends = "unknown";         ///< unknown, hinged, clamped
  double bending_stiffness_N_m2 = 0.0;  ///< EI of the section; 0: unknown
  double mass_kg_m = 0.0;               ///< wanted with EI
};

/// Decision of a person on a pole of the stabilisation diagram.
struct ModeChoice {
  std::string setup;
  int order = 0;
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  bool keep = true;  ///< false: its mode is deleted
  std::string file;  ///< file and line of the choice
  long line = 0;
};

/// How records are identified; the step's configuration has a sentence for each value.
struct IdentificationSettings : IdentifyOptions {
  std::string setup, condition, kind = "ambient", method = "covariance", merge = "poser";
  std::vector<std::string> setups, references, exclude;
  long decimation = 1, blocks = 20, longest_gap = 0;
  bool order_is_default = false;  ///< true: maximum_order was not configured and may be lowered to what the records allow
  long welch_segment = 2048;
  double largest_clipping = 1e-3;
  double largest_lone = 50.0;  ///< [-] robust deviations
  double lowest_Hz = 0.0;
  double highest_Hz = 0.0;  ///< 0: chosen, at most 0.8 of the Nyquist frequency after decimation
  double largest_damping = 0.20;
  // Free decays (ERA).
  long decay_decimation = 0, decay_block_rows = 60, decay_maximum_order = 40;
  double decay_start_s = 0.3, decay_length_s = 20.0, decay_band_Hz = 0.08;
  long decay_bands = 4;
  // Stays.
  long stay_decimation = 4, stay_block_rows = 100, stay_maximum_order = 40, stay_harmonics = 16;
  double stay_lowest_Hz = 0.0, stay_highest_Hz = 0.0, stay_level = 0.95;
  std::vector<StaySettings> stays;
  std::vector<ModeChoice> choices;  ///< of modes by a person

  /// Settings of the subspace identification for records of this rate (after decimation) and these responses.
  [[nodiscard]] IdentifyOptions options(double rate_Hz, const std::vector<records::CampaignChannel>& channels) const;
};

/// 2 for an acceleration, 1 for a velocity, 0 for a displacement.
[[nodiscard]] int derivative(const std::string& quantity);

}  // namespace twindeck::identification
