#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "blind/modes/random_records.hpp"
#include "identification/identify.hpp"
#include "identification/merge_poser.hpp"

namespace twindeck::blind::modes {

/// What step 3 makes of the records.
struct IdentifiedRecords {
  std::vector<identification::Identification> setups;
  std::vector<Eigen::VectorXd> scale;  ///< of each setup's channels: poles' shapes are those of records divided by it
  std::vector<identification::MergedMode> modes;  ///< merged, as modes.csv has them
};
/// Step 3's own functions with settings that know nothing of the truth: 40 block rows (2 s), orders 2 to 80, 20 blocks, band up
/// to 0.8 of the Nyquist frequency.
[[nodiscard]] IdentifiedRecords identify_records(const RandomRecords& records);

/// What becomes of one true mode.
struct ModeOutcome {
  /// The records settle it: in one setup at least, a pole of the diagram within three times 0.5 % of the true frequency has a
  /// MAC of 0.8 or more with the true shape, and the best known of these (an oracle knows shape and order) has a standard
  /// deviation of at most 0.5 %. Its nearest neighbour is further than three such deviations, or has a MAC below 0.8 with it.
  bool settled = false;
  double oracle_std_Hz = 0.0;
  /// The identified mode that answers to it, -1 for none: of all pairs with a MAC of at least 0.5 whose frequencies agree
  /// within 0.5 %, or four of its standard deviations where that is more, but 2.5 % at most, the nearest first, one to one.
  int found = -1;
  double mac = 0.0;
  [[nodiscard]] bool recalled() const { return found >= 0; }
};

struct ModeScore {
  std::vector<ModeOutcome> modes;       ///< as the truth's
  std::vector<int> spurious;            ///< identified modes that answer to no true one
  int flagged = 0;                      ///< lines of the machine that are marked in one setup at least (within 0.1 %)
  int settled = 0, recalled = 0;        ///< true modes that are settled; of these those found
  int alike = 0;                        ///< of those found with a MAC of at least 0.8
  std::vector<double> frequency_error;  ///< of those, over their standard deviations
  std::vector<double> damping_error;
};
[[nodiscard]] ModeScore score(const RandomRecords& truth, const IdentifiedRecords& found);

/// MAC of a true shape with one over the channels that are known (NaN: not measured).
[[nodiscard]] double known_mac(const Eigen::VectorXd& truth, const Eigen::VectorXcd& shape);

/// What a run asks of all records together.
struct ModeTotals {
  int records = 0, settled = 0, recalled = 0, alike = 0, spurious = 0, lines = 0, flagged = 0;
  std::vector<double> frequency_error, damping_error;
  void add(const RandomRecords& truth, const ModeScore& score);
};
/// Prints rates with exact 95 % intervals beside the targets. @return false when an interval lies wholly on the wrong side of
/// one
bool print_totals(const ModeTotals& totals);

}  // namespace twindeck::blind::modes
