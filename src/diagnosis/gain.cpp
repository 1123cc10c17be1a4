#include "diagnosis/gain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace twindeck::diagnosis {

using Eigen::VectorXd;

namespace {

constexpr std::size_t kLongestList = 160;  ///< characters in the list of held-out modes, which is one line of a report
constexpr int kFewestResampled = 3;        ///< blocks; with fewer, the variation of the gain is unknown
constexpr double kLowerEnd = 0.05, kUpperEnd = 0.95;  ///< quantiles of the resampled gains: an interval of 90 %

/// Squared residuals of rows that share errors.
struct HeldOutBlock {
  double before = 0.0, after = 0.0;
  int rows = 0;
};

/// The held-out rows by mode or record of one condition. The entries of one shape share errors and stay together. A row that
/// one of the fits leaves open is left out.
std::map<std::string, HeldOutBlock> held_out_blocks(const Inference& inference, const Fit& fit_before, const Fit& fit_after) {
  const VectorXd before = standardised_residuals(inference, fit_before), after = standardised_residuals(inference, fit_after);
  std::set<int> open(fit_before.all.open.begin(), fit_before.all.open.end());
  open.insert(fit_after.all.open.begin(), fit_after.all.open.end());
  const auto& features = inference.map().features();
  std::map<std::string, HeldOutBlock> by_name;
  for (const int r : inference.held_out()) {
    if (open.contains(r)) continue;
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    const std::string& condition = features.condition_of(row).name;
    HeldOutBlock& block = by_name[condition + "/" + (row.mode.empty() ? name_of(row.type) : row.mode)];
    block.before += before[r] * before[r];
    block.after += after[r] * after[r];
    block.rows += 1;
  }
  return by_name;
}

/// "winter mode 2; winter mode 5": the held-out conditions and modes, for people.
std::string list_of_held_out(const Inference& inference) {
  const auto& features = inference.map().features();
  std::set<std::string> names;
  for (const int r : inference.held_out()) {
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    const std::string& condition = features.condition_of(row).name;
    names.insert(condition + (row.mode.empty() ? "" : " mode " + row.mode));
  }
  std::string text;
  for (const std::string& name : names) {
    if (text.size() > kLongestList) return text + " …";
    text += (text.empty() ? "" : "; ") + name;
  }
  return text;
}

double reduction_pct(const HeldOutBlock& b) { return b.before > 0.0 ? 100.0 * (1.0 - std::sqrt(b.after / b.before)) : 0.0; }

/// Reductions of data sets drawn from the blocks with replacement, in ascending order.
std::vector<double> resampled_reductions(const std::vector<HeldOutBlock>& blocks, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> drawn;
  for (int i = 0; i < count; ++i) {
    HeldOutBlock resample;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const HeldOutBlock& b = blocks[random() % blocks.size()];
      resample.before += b.before;
      resample.after += b.after;
    }
    drawn.push_back(reduction_pct(resample));
  }
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

}  // namespace

VectorXd standardised_residuals(const Inference& inference, const Fit& fit) {
  const FeatureMap& map = inference.map();
  VectorXd e = map.values() - fit.all.g;
  std::set<std::pair<int, RowType>> trained;
  const auto& rows = map.features().rows;
  for (const int r : inference.training())
    trained.insert({rows[static_cast<std::size_t>(r)].condition, rows[static_cast<std::size_t>(r)].type});
  std::map<std::pair<int, RowType>, std::vector<int>> untrained;
  for (const int r : inference.held_out()) {
    const Row& row = rows[static_cast<std::size_t>(r)];
    const bool level = row.type == RowType::rms || row.type == RowType::psd_floor;
    if (level && !trained.contains({row.condition, row.type})) untrained[{row.condition, row.type}].push_back(r);
  }
  for (const auto& [key, list] : untrained) {
    double mean = 0.0;
    for (const int r : list) mean += e[r] / static_cast<double>(list.size());
    for (const int r : list) e[r] -= mean;
  }
  return e.cwiseQuotient(map.covariance().diagonal().cwiseSqrt());
}

Gain held_out_gain(const Inference& inference, const Fit& before, const Fit& after, int bootstrap, std::uint64_t seed) {
  Gain gain;
  const std::map<std::string, HeldOutBlock> by_name = held_out_blocks(inference, before, after);
  if (by_name.empty()) {
    gain.held_out = "no row was held out";
    return gain;
  }
  gain.held_out = list_of_held_out(inference);
  std::vector<HeldOutBlock> blocks;
  HeldOutBlock sum;
  for (const auto& [name, block] : by_name) {
    blocks.push_back(block);
    sum.before += block.before;
    sum.after += block.after;
    sum.rows += block.rows;
  }
  gain.rows = sum.rows;
  gain.before = std::sqrt(sum.before / sum.rows);
  gain.after = std::sqrt(sum.after / sum.rows);
  gain.reduction_pct = reduction_pct(sum);
  if (std::ssize(blocks) < kFewestResampled) {
    gain.low_pct = std::min(0.0, gain.reduction_pct);
    gain.high_pct = std::max(0.0, gain.reduction_pct);
    return gain;
  }
  const std::vector<double> drawn = resampled_reductions(blocks, bootstrap, seed);
  gain.low_pct = drawn[static_cast<std::size_t>(kLowerEnd * bootstrap)];
  gain.high_pct = drawn[static_cast<std::size_t>(kUpperEnd * bootstrap)];
  return gain;
}

}  // namespace twindeck::diagnosis
