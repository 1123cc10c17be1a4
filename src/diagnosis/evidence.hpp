#pragma once

#include <string>
#include <vector>

#include "diagnosis/features/features.hpp"
#include "diagnosis/prediction/feature_map.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "matching/measured.hpp"

/// Evidence other than rows: published results of an updating and its validation. It appears in the findings, never in odds.
namespace twindeck::diagnosis {

/// A line of `claims.csv` beside rows.csv: `kind,name,record,value,lower,upper,source`.
struct Claim {
  enum class Kind { parameter, mac, frequency_error, rms_error } kind = Kind::parameter;
  std::string name;                 ///< parameter, mode, or channel
  std::string record;               ///< of an RMS value: event and model
  double value = 0.0;               ///< change or error in per cent; MAC as a number
  double lower = 0.0, upper = 0.0;  ///< of a parameter's change, in per cent
  std::string source;
};

/// A channel whose errors have a common factor in all records, unlike the other channels.
struct ChannelFactor {
  std::string channel;
  int records = 0;
  double factor = 1.0;                 ///< computed over measured, over all records, with the records' levels removed
  double lowest = 1.0, highest = 1.0;  ///< over records
  double others = 0.0;                 ///< standard deviation of ln factor among the other channels
  double p_value = 1.0;  ///< of the difference from the others: Student's law with n-2 degrees of freedom, times the channels
};

/// ln(1 + error) of channel c in record k = level of k + factor of c + rest. The level is the median over channels. A factor is
/// tested against the mean and deviation of all other channels (Student 1908). It counts if p times the number of channels is
/// below kAlpha. Records in which a channel has no claim are left out.
[[nodiscard]] std::vector<ChannelFactor> channel_factors(const std::vector<Claim>& claims);

/// One finding from claims and rows.
struct Finding {
  std::string kind;  ///< "bounds", "frequencies", "shapes", "channel", "dampers"
  std::string text;
  std::vector<std::string> names = {};       ///< parameters, modes or channels concerned
  std::vector<std::string> candidates = {};  ///< causes with such an effect, as in a cluster; may be empty
  std::string split_by = {};                 ///< measurement that distinguishes the candidates
};

/// Findings from claims and rows, without odds: parameters of a published updating on bounds, remaining errors and MACs,
/// channels that differ from the others, and the change of stiffness by dampers in the mode that they change most. If a model
/// is given, its change by moving dampers is compared.
/// @param model  predicts the rows; may be null
[[nodiscard]] std::vector<Finding> account_of(const std::vector<Claim>& claims, const FeatureSet& features,
                                              const std::vector<matching::Channel>& channels, const Places& places,
                                              const FeatureMap* model = nullptr);

}  // namespace twindeck::diagnosis
