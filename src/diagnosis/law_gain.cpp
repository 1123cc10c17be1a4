#include "diagnosis/law_gain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "diagnosis/law_fits.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGuarded = 15.0;  // nats below the leader; accounts within it are part of the gain
constexpr int kFewestBlocks = 3;   // blocks, for resampling

/// Rows of whole modes, as positions among the training rows. A block holds one model mode in all conditions. With fewer than
/// three modes, each condition of a mode is a block, because the form error hardly correlates them.
std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition = false) {
  const FormModes modes = plain.map().form_modes(fit.base, fit.causes);
  std::map<int, int> place;  // position of a row among the training rows
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

/// Sigma^-1 at an account's scales. Linear magnitudes are unknowns with the variance of their range (`further`).
std::shared_ptr<const Precision> precision_at(const LawSystem& system, const VectorXd& tau, const MatrixXd& further) {
  const MatrixXd lower = linalg::cholesky_factor(covariance_at(system, tau) + linalg::square(further));
  TWINDECK_ASSERT(lower.size() > 0);
  auto out = std::make_shared<Precision>();
  out->matrix = linalg::inverse_of_factored(lower);
  out->log_determinant = 2.0 * lower.diagonal().array().log().sum();
  return out;
}

/// An account as an Explanation. From all rows its weight is that of the account.
Explanation explanation_by_law(const LawSearch& search, const LawAccount& account) {
  const LawHypothesis& h = account.hypothesis;
  const LawSystem& system = account.refined() ? *account.system : search.system;
  const VectorXd deviation = (h.high - h.low) / std::sqrt(12.0);
  Explanation out{precision_at(system, account.evidence.tau, h.slopes * deviation.asDiagonal()), h.left, h.log_weight};
  if (h.slopes.cols() > 0) out.left.colwise() -= h.slopes * (0.5 * (h.high + h.low));
  std::vector<double> terms;
  for (Index k = 0; k < out.left.cols(); ++k)
    terms.push_back(out.log_weight[k] -
                    0.5 * (out.left.col(k).dot(out.precision->matrix * out.left.col(k)) + out.precision->log_determinant));
  out.log_weight.array() += account.log_weight - log_sum(terms);
  return out;
}

/// Residuals of "nothing" with its paired modes only: open modes would seem to be predicted. Rows of modes that are open under
/// the answer are in neither sum.
void tell_residuals_of_pairs(const LawSetting& setting, const LawSearch& search, const std::vector<std::vector<int>>& blocks,
                             const std::vector<Explanation>& entries, int bootstrap, std::uint64_t seed, PredictiveGain& gain) {
  std::set<int> open;
  for (const int m : search.accounts.front().opened) {
    const VectorXd variance =
        variance_of_open(setting.plain.map(), setting.plain.map().measured_modes()[static_cast<std::size_t>(m)]);
    for (std::size_t at = 0; at < setting.plain.training().size(); ++at)
      if (variance[setting.plain.training()[at]] > 0.0) open.insert(static_cast<int>(at));
  }
  std::vector<std::vector<int>> kept;
  std::vector<std::size_t> which;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    gain.blocks[b].before = gain.blocks[b].after = 0.0;
    gain.blocks[b].rows = 0;
    std::vector<int> rows = blocks[b];
    std::erase_if(rows, [&](int at) { return open.contains(at); });
    if (rows.empty()) continue;
    kept.push_back(std::move(rows));
    which.push_back(b);
  }
  LawAccount none;
  none.evidence = search.none;
  none.log_weight = search.none.log_evidence;
  none.hypothesis = {search.system.residual, VectorXd::Zero(1), MatrixXd(search.system.residual.size(), 0), {}, {}, {}};
  const PredictiveGain paired = gain_of_odds(kept, explanation_by_law(search, none), entries, bootstrap, seed);
  for (std::size_t b = 0; b < paired.blocks.size(); ++b) {
    gain.blocks[which[b]].before = paired.blocks[b].before;
    gain.blocks[which[b]].after = paired.blocks[b].after;
    gain.blocks[which[b]].rows = paired.blocks[b].rows;
  }
  gain.reduction_pct = paired.reduction_pct;
  gain.low_pct = paired.low_pct;
  gain.high_pct = paired.high_pct;
}

}  // namespace

const LawAccount* leading_model_error(const LawSearch& search) {
  if (search.model_errors.empty() || search.model_errors.front().log_weight < search.nothing.log_weight) return nullptr;
  return &search.model_errors.front();
}

PredictiveGain gain_by_law(const LawSetting& setting, const LawSearch& search, int bootstrap, std::uint64_t seed) {
  LawAccount nothing = search.nothing;
  if (const LawAccount* error = leading_model_error(search); error != nullptr && error->scored) nothing = *error;
  std::vector<Explanation> entries;
  for (const LawAccount& account : search.accounts)
    if (account.scored && account.log_weight > search.accounts.front().log_weight - kGuarded)
      entries.push_back(explanation_by_law(search, account));
  const std::vector<std::vector<int>> blocks = mode_blocks(setting.plain, search.base);
  PredictiveGain gain = gain_of_odds(blocks, explanation_by_law(search, nothing), entries, bootstrap, seed);
  if (!entries.empty() && !nothing.opened.empty())
    tell_residuals_of_pairs(setting, search, blocks, entries, bootstrap, seed, gain);
  return gain;
}

std::vector<HeldOutMode> held_out_modes(const LawSetting& setting, const LawSearch& search) {
  std::vector<HeldOutMode> out;
  if (search.accounts.empty() || !search.accounts.front().refined()) return out;
  const LawAccount& leader = search.accounts.front();
  LawAccount without_causes = leader;
  without_causes.causes.clear();
  without_causes.with.causes = search.base.causes;
  const FeatureMap& map = setting.plain.map();
  const std::vector<std::vector<int>> blocks = mode_blocks(setting.plain, search.base);
  std::vector<Prediction> before(blocks.size()), after(blocks.size());
  parallel_for_told(
      2 * blocks.size(),
      [&](std::size_t k) {
        const bool with = k % 2 == 1;
        (with ? after : before)[k / 2] = fit_by_own_scales(setting, with ? leader : without_causes, blocks[k / 2]).all;
      },
      [&](int done, int of) { setting.progress("modes left out", done, of); });
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    const auto row = std::ranges::find(setting.plain.training(), mode.frequency);
    const auto at = static_cast<int>(row - setting.plain.training().begin());
    const auto block = std::ranges::find_if(blocks, [&](const std::vector<int>& rows) { return contains(rows, at); });
    if (row == setting.plain.training().end() || block == blocks.end() || contains(leader.opened, static_cast<int>(m)))
      continue;
    const Prediction &without = before[static_cast<std::size_t>(block - blocks.begin())],
                     &with = after[static_cast<std::size_t>(block - blocks.begin())];
    if (!without.valid || !with.valid || without.paired[m] < 0 || with.paired[m] < 0) continue;
    const auto off_pct = [&](const Prediction& p, int r) {  // rows are logarithms
      return r < 0 ? std::numeric_limits<double>::quiet_NaN() : 100.0 * std::expm1(p.g[r] - map.values()[r]);
    };
    const Condition& condition = map.features().condition_of(mode);
    const int damping = condition.dampers_on.value_or(false) ? mode.damping : -1;  // else not computed
    out.push_back({mode.label, condition.name, off_pct(without, mode.frequency), off_pct(with, mode.frequency),
                   off_pct(without, damping), off_pct(with, damping), without.mac[m], with.mac[m]});
  }
  return out;
}

bool each_cause_predicts(const LawSetting& setting, const LawSearch& search, const LawAccount& set, int bootstrap,
                         std::uint64_t seed) {
  const auto is_member = [&](int m) { return contains(set.members, m); };
  const LawAccount* fewer = nullptr;
  for (const auto* accounts : {&search.accounts, &search.model_errors})
    for (const LawAccount& account : *accounts)
      if (account.scored && account.members.size() < set.members.size() &&
          (fewer == nullptr || account.log_weight > fewer->log_weight) && std::ranges::all_of(account.members, is_member))
        fewer = &account;
  if (!set.scored || fewer == nullptr) return true;
  const bool of_channels = std::ranges::all_of(set.members, [&](int m) {
    return is_of_a_channel(*search.entries[static_cast<std::size_t>(m)].candidate) || contains(fewer->members, m);
  });
  if (of_channels) return true;
  const PredictiveGain gain = gain_of_odds(mode_blocks(setting.plain, search.base), explanation_by_law(search, *fewer),
                                           {explanation_by_law(search, set)}, bootstrap, seed);
  return gain.blocks.empty() || gain.low > 0.0;
}

}  // namespace twindeck::diagnosis
