#pragma once

#include <string>
#include <vector>

#include "diagnosis/features/features.hpp"
#include "diagnosis/prediction/feature_map.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "matching/measured.hpp"

/// Evidence that is no row: what others publish about their own updating and validation. It goes into the account of what is
/// wrong, never into odds.
namespace twindeck::diagnosis {

/// A line of `claims.csv` beside rows.csv: `kind,name,record,value,lower,upper,source`.
struct Claim {
  enum class Kind { parameter, mac, frequency_error, rms_error } kind = Kind::parameter;
  std::string name;                 ///< parameter, mode, or channel
  std::string record;               ///< of an RMS value: what event under which model
  double value = 0.0;               ///< change or error in per cent; MAC as a number
  double lower = 0.0, upper = 0.0;  ///< of a parameter's change, in per cent
  std::string source;
};

/// A channel whose errors share a factor in all records that the other channels do not have.
struct ChannelFactor {
  std::string channel;
  int records = 0;
  double factor = 1.0;                 ///< computed over measured, over all records, beyond the records' own levels
  double lowest = 1.0, highest = 1.0;  ///< over records
  double others = 0.0;                 ///< standard deviation of ln factor among the other channels
  double p_value = 1.0;  ///< of standing off from them, Student's law on n-2 degrees of freedom, times the channels
};

/// ln(1 + error) of channel c in record k = level of k + factor of c + rest. The level is the median over channels; a factor is
/// held against the mean and deviation of all other channels (Student 1908), and counts if p times the number of channels stays
/// below `alpha`. Records in which a channel has no claim are left out.
[[nodiscard]] std::vector<ChannelFactor> channel_factors(const std::vector<Claim>& claims);

/// One statement of the account.
struct Finding {
  std::string kind;  ///< "bounds", "frequencies", "shapes", "channel", "dampers"
  std::string text;
  std::vector<std::string> names;       ///< parameters, modes or channels that it is about
  std::vector<std::string> candidates;  ///< causes that would do this, as in a cluster; may be empty
  std::string split_by;                 ///< what tells the candidates apart
};

/// What claims and rows say before any odds: parameters of a published updating on bounds, errors and MACs that it leaves,
/// channels that stand off, and by how much the mode that dampers change most is stiffer with them than without. Whether
/// dampers that move account for that is asked of the model.
/// @param model  predicts the rows; null: nothing is said of the model
[[nodiscard]] std::vector<Finding> account_of(const std::vector<Claim>& claims, const FeatureSet& features,
                                              const std::vector<matching::Channel>& channels, const Places& places,
                                              const FeatureMap* model = nullptr);

}  // namespace twindeck::diagnosis
