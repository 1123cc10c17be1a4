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
  double least_mac = 0.6;  ///< a model's mode less alike than that is another one
  int modes = 48;          ///< of the structure with bars, in whose coordinates the cables are tried
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
  double deck_log_odds = 0.0;  ///< of the modes that the channels saw
  double log_odds = 0.0;       ///< with the stays' own measured frequencies
  ExplanationRule rule;
  fe::Model extended;      ///< the model with these stays as cables of `cable_pieces`
  int modes_in_basis = 0;  ///< that many modes of it lie where the reduced model of bars had `modes` / 2
  int modes_in_band = 0;   ///< that many lie below the highest measured frequency
};

/// Whether measured modes that the model resembles nowhere are those of stays that swing (rule in docs/diagnosis.md). Modes of
/// conditions without dampers decide where there are any. Nothing is found where the model has no stay under force, no shape
/// was measured, every measured mode is explained, or no stay's frequency lies near one that is not.
/// @param features   rows in use
/// @param stay_rows  stay_frequency rows, whether or not they are in use
[[nodiscard]] std::optional<BarStays> find_bar_stays(const Structure& structure, const FeatureSet& features,
                                                     const std::vector<Row>& stay_rows, const BarStaysOptions& options);

}  // namespace twindeck::diagnosis
