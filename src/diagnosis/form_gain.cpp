#include "diagnosis/form_gain.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/form_magnitudes.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFewestBlocks = 3;       // that can be drawn anew
constexpr double kGuardWithin = 15.0;  // nats of the leader: entries that a fold may choose

/// An entry's best point as a Gaussian law of the rows; its magnitudes are unknowns as wide as their range.
Explanation explanation_of(const FormEntry& entry, const FormSetting& setting, const Leftover& leftover) {
  const EvidenceTerm& best = entry.evidence.best;
  const int contrast = best.kappa < 0 ? -1 : entry.contrast >= 0 ? entry.contrast : leftover.contrast;
  const MatrixXd columns = scaled_columns(entry.system, setting.grid, setting.grid.points[static_cast<std::size_t>(best.point)],
                                          contrast, best.kappa < 0 ? 0.0 : setting.grid.change[best.kappa]);
  const Candidate& candidate = *entry.candidate;
  const VectorXd deviation = (candidate.high - candidate.low) / std::sqrt(12.0),
                 middle = 0.5 * (candidate.high + candidate.low);
  MatrixXd all(columns.rows(), columns.cols() + deviation.size());
  all << columns, entry.system.signatures * deviation.asDiagonal();
  // The system's residual is that at the magnitudes of the fit, which its prediction was made with.
  const VectorXd left = entry.system.residual - entry.system.signatures * (middle - entry.fitted);
  return {precision_of(entry.system.sigma_factor, all), left, VectorXd::Constant(1, log_prior_of(candidate))};
}

/// Entries that were only screened, at the base and at the leader's scales.
Explanation screened_explanation(const FormEntry& entry, const FormSearch& search,
                                 const std::shared_ptr<const Precision>& precision) {
  const std::vector<double> factors = magnitude_factors(*entry.candidate);
  const auto count = static_cast<Index>(entry.tried.size() * factors.size());
  Explanation out{precision, MatrixXd(search.system.residual.size(), count),
                  VectorXd::Constant(count, log_prior_of(*entry.candidate) - std::log(static_cast<double>(count)))};
  Index k = 0;
  for (std::size_t i = 0; i < entry.tried.size(); ++i)
    for (const double t : factors)
      out.left.col(k++) =
          search.system.residual - t * search.system.signatures.col(entry.first_signature + static_cast<Index>(i));
  return out;
}

}  // namespace

std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition) {
  const FormModes modes = plain.map().form_modes(fit.base, fit.causes);
  std::map<int, int> place;  // of a row among the training rows
  for (std::size_t r = 0; r < plain.training().size(); ++r) place[plain.training()[r]] = static_cast<int>(r);
  std::map<std::string, std::vector<int>> blocks;
  for (std::size_t m = 0; m < modes.paired.size(); ++m) {
    const MeasuredMode& mode = plain.map().measured_modes()[m];
    std::string name = modes.paired[m].model_mode >= 0 ? std::to_string(modes.paired[m].model_mode) : "label " + mode.label;
    if (by_condition) name += " in " + std::to_string(mode.condition);
    std::vector<int>& block = blocks[name];
    std::vector<int> rows = mode.real_rows;
    rows.insert(rows.end(), mode.imag_rows.begin(), mode.imag_rows.end());
    rows.push_back(mode.frequency);
    rows.push_back(mode.damping);
    for (const int r : rows)
      if (const auto at = place.find(r); at != place.end()) block.push_back(at->second);
  }
  std::vector<std::vector<int>> out;
  for (auto& [name, block] : blocks)
    if (!block.empty()) out.push_back(std::move(block));
  return std::ssize(out) < kFewestBlocks && !by_condition ? mode_blocks(plain, fit, true) : out;
}

PredictiveGain predictive_gain(const FormSetting& setting, const FormSearch& search, const Leftover& leftover, int bootstrap,
                               std::uint64_t seed) {
  const auto at_best = [&](const EvidenceTerm& best, int contrast) {
    return precision_of(search.system.sigma_factor,
                        scaled_columns(search.system, setting.grid, setting.grid.points[static_cast<std::size_t>(best.point)],
                                       best.kappa < 0 ? -1 : contrast, best.kappa < 0 ? 0.0 : setting.grid.change[best.kappa]));
  };
  const Explanation none{at_best(search.none.best, leftover.contrast), search.system.residual, VectorXd::Zero(1)};
  const FormEntry& leader = search.entries.front();
  const int contrast = leader.contrast >= 0 ? leader.contrast : leftover.contrast;
  std::shared_ptr<const Precision> screened;
  std::vector<Explanation> entries;
  for (const FormEntry& entry : search.entries) {
    if (entry.log_weight < leader.log_weight - kGuardWithin) break;
    if (entry.refined) {
      entries.push_back(explanation_of(entry, setting, leftover));
      continue;
    }
    if (!screened) screened = at_best(leader.evidence.best, contrast);
    entries.push_back(screened_explanation(entry, search, screened));
  }
  return leave_one_out(mode_blocks(setting.plain, search.base), none, entries, bootstrap, seed);
}

}  // namespace twindeck::diagnosis
