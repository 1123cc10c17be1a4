#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/causes/swinging_stays.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"

/// The cause `barstays`: stays modelled as bars do not vibrate, the structure's do.
namespace twindeck::diagnosis {

struct BarStaysOptions {
  double least_mac = 0.6;  ///< a mode of the model with a lower MAC is another mode
  int modes = 48;          ///< number of modes of the structure with bars, as coordinates for trying the cables
};

/// Where the force of a cable comes from: the stay's own measured frequencies, those of its mirror image, or the model.
enum class ForceSource { measured, twin, model };

/// A stay that swings in the extended model.
struct FoundStay {
  std::string name;
  int element = -1;
  double force_N = 0.0, relative_std = 0.0;
  ForceSource source = ForceSource::model;
};

struct BarStays {
  std::vector<FoundStay> stays;
  double deck_log_odds = 0.0;  ///< from the modes that the channels measured
  double log_odds = 0.0;       ///< with the stays' own measured frequencies too
  ExplanationRule rule;
  fe::Model extended;      ///< the model with these stays as cables of `cable_pieces`
  int modes_in_basis = 0;  ///< number of its modes up to the middle mode of the reduced model with bars
  int modes_in_band = 0;   ///< number of its modes below the highest measured frequency
};

/// Finds stays whose swinging explains measured modes that no mode of the model resembles (rule in docs/diagnosis.md).
/// Conditions without dampers decide if there are any. The result is empty if the model has no stay under tension, if no shape
/// was measured, if every measured mode is explained, or if no stay has a frequency near an unexplained mode.
/// @param features   rows in use
/// @param stay_rows  stay_frequency rows, whether or not they are in use
[[nodiscard]] std::optional<BarStays> find_bar_stays(const Structure& structure, const FeatureSet& features,
                                                     const std::vector<Row>& stay_rows, const BarStaysOptions& options);

}  // namespace twindeck::diagnosis
