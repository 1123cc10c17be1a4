#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

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
  const auto& features = inference.map().features();
  gain.rows = static_cast<int>(inference.held_out().size());
  if (gain.rows == 0) {
    gain.held_out = "no row was held out";
    return gain;
  }
  const VectorXd e0 = standardised_residuals(inference, before), e1 = standardised_residuals(inference, after);
  struct Block {
    double before = 0.0, after = 0.0;
    int rows = 0;
  };
  std::map<std::string, Block> by_name;
  std::set<std::string> conditions;
  for (const int r : inference.held_out()) {
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    const std::string& condition = features.conditions[static_cast<std::size_t>(row.condition)].name;
    // Entries of one shape share errors: they stay together.
    Block& block = by_name[condition + "/" + (row.mode.empty() ? name_of(row.type) : row.mode)];
    block.before += e0[r] * e0[r];
    block.after += e1[r] * e1[r];
    block.rows += 1;
    conditions.insert(condition + (row.mode.empty() ? "" : " mode " + row.mode));
  }
  for (const std::string& name : conditions) {
    if (gain.held_out.size() > 160) {
      gain.held_out += " …";
      break;
    }
    gain.held_out += (gain.held_out.empty() ? "" : "; ") + name;
  }
  std::vector<Block> blocks;
  Block sum;
  for (const auto& [name, block] : by_name) {
    blocks.push_back(block);
    sum.before += block.before;
    sum.after += block.after;
    sum.rows += block.rows;
  }
  const auto reduction = [](const Block& b) { return b.before > 0.0 ? 100.0 * (1.0 - std::sqrt(b.after / b.before)) : 0.0; };
  gain.before = std::sqrt(sum.before / sum.rows);
  gain.after = std::sqrt(sum.after / sum.rows);
  gain.reduction_pct = reduction(sum);
  if (blocks.size() < 3) {  // too few to say how much it varies
    gain.low_pct = std::min(0.0, gain.reduction_pct);
    gain.high_pct = std::max(0.0, gain.reduction_pct);
    return gain;
  }
  std::mt19937_64 random(seed);
  std::vector<double> drawn;
  for (int i = 0; i < bootstrap; ++i) {
    Block resample;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const Block& b = blocks[random() % blocks.size()];
      resample.before += b.before;
      resample.after += b.after;
    }
    drawn.push_back(reduction(resample));
  }
  std::sort(drawn.begin(), drawn.end());
  gain.low_pct = drawn[static_cast<std::size_t>(0.05 * bootstrap)];
  gain.high_pct = drawn[static_cast<std::size_t>(0.95 * bootstrap)];
  return gain;
}

}  // namespace twindeck::diagnosis
