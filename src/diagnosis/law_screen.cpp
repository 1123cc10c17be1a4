#include "diagnosis/law_screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/parallel.hpp"
#include "diagnosis/form_frame.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPerCent = 100.0;          // units of a class per relative effect
const double kShrinks[] = {0.0, 1.5, 3.0};  // reductions of ln tau: a large cause leaves smaller errors than "nothing" does
constexpr std::ptrdiff_t kTogether = 64;    // entries that one product weighs
constexpr double kShows = 1e-3;             // deviations; entries with smaller changes are left out

double log_sum_of(const VectorXd& v) {
  const double top = v.maxCoeff();
  return top + std::log((v.array() - top).exp().sum());
}

/// For a factor: the best magnitude on the other side of one, where a fit may find another optimum. Empty for other unknowns.
/// @param terms  of each trial magnitude, at `each` sizes
VectorXd best_across(const LawEntry& entry, const VectorXd& a, const VectorXd& terms, std::size_t each) {
  if (entry.candidate->hypothesis->unknowns.empty() || entry.candidate->hypothesis->unknowns[0].name != "factor") return {};
  VectorXd out;
  double most = -std::numeric_limits<double>::infinity();
  for (Index k = 0; k < terms.size(); ++k) {
    const VectorXd& tried = entry.tried[static_cast<std::size_t>(k) / each].a;
    if (terms[k] <= most || tried[0] * a[0] >= 0.0) continue;
    most = terms[k];
    out = tried;
  }
  return out;
}

/// Scales at which entries are weighed, with the volume of Laplace's approximation.
struct ScreenPoint {
  VectorXd tau;
  double log_volume = 0.0;
  int contrast = -1;
};

double volume_of(const LawEvidence& evidence, double value) { return evidence.log_evidence - value; }

class Screen {
 public:
  Screen(const LawSetting& setting, LawSearch& search, const OneLaw& law) : setting_(setting), search_(search), law_(law) {}

  /// Finds the modes of "nothing" and of "something else".
  void weigh_nothing() {
    LawHypothesis none{search_.system.residual,        VectorXd::Zero(1), MatrixXd(search_.system.residual.size(), 0), {}, {},
                       lasting_classes(search_.system)};
    search_.none = law_.scored(none, VectorXd::Ones(law_.classes()));
    add_point(search_.none, law_.log_posterior(none, search_.none.tau), -1);
    search_.something_else.resize(setting_.contrasts.size());
    std::vector<double> value(setting_.contrasts.size());
    parallel_for(setting_.contrasts.size(), [&](std::size_t c) {
      LawHypothesis other = none;
      other.active.push_back({kFirstContrast + static_cast<int>(c), 1.0});
      search_.something_else[c] = law_.scored(other, search_.none.tau);
      value[c] = law_.log_posterior(other, search_.something_else[c].tau);
    });
    for (std::size_t c = 0; c < value.size(); ++c) {
      add_point(search_.something_else[c], value[c], static_cast<int>(c));
    }
  }

  /// Weighs every entry alone, summed over its magnitudes, at the best of the points.
  void weigh_entries() {
    search_.accounts.resize(search_.entries.size());
    for (std::size_t i = 0; i < search_.entries.size(); ++i) {
      search_.accounts[i].members = {static_cast<int>(i)};
      search_.accounts[i].log_prior = search_.entries[i].log_prior;
    }
    if (!law_.coordinates().exist()) return;
    const MatrixXd left = law_.coordinates().of(search_.system.residual);
    const MatrixXd changes = law_.coordinates().of(search_.system.signatures);
    std::map<int, std::vector<std::size_t>> of_contrast;
    for (std::size_t i = 0; i < search_.entries.size(); ++i) of_contrast[search_.entries[i].contrast].push_back(i);
    for (const ScreenPoint& point : points_) {
      const OneLaw::Point at = law_.at(point.tau);
      if (!at.exists) continue;
      const VectorXd residual = at.whitened(left);
      const std::vector<std::size_t>& entries = of_contrast[point.contrast];
      parallel_for((entries.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
        const auto first = entries.begin() + static_cast<Index>(part * kTogether);
        weigh_some({first, std::min(first + kTogether, entries.end())}, point, at, residual, changes);
      });
    }
  }

 private:
  /// Weighs some entries at a point. @param residual  whitened @param changes  of all entries, in the law's coordinates
  void weigh_some(const std::vector<std::size_t>& entries, const ScreenPoint& point, const OneLaw::Point& at,
                  const VectorXd& residual, const MatrixXd& changes) {
    std::vector<Index> columns;
    for (const std::size_t i : entries)
      for (std::size_t m = 0; m < search_.entries[i].tried.size(); ++m)
        columns.push_back(search_.entries[i].first_signature + static_cast<Index>(m));
    const MatrixXd signatures = at.whitened(changes(Eigen::all, columns));
    const VectorXd along = signatures.transpose() * residual, square = signatures.colwise().squaredNorm();
    Index s = 0;
    for (const std::size_t i : entries) {
      const LawEntry& entry = search_.entries[i];
      LawAccount& account = search_.accounts[i];
      const std::vector<double> factors = magnitude_factors(*entry.candidate);
      VectorXd terms(std::ssize(entry.tried) * std::ssize(factors));
      Index k = 0;
      for (std::size_t m = 0; m < entry.tried.size(); ++m, ++s)
        for (const double t : factors)
          terms[k++] = t * along[s] - 0.5 * t * t * square[s] + prior_of(point, t * entry.effects[m]);
      const double value = log_sum_of(terms) - std::log(static_cast<double>(terms.size())) -
                           0.5 * (residual.squaredNorm() + at.log_determinant) + point.log_volume;
      if (!(value + account.log_prior > account.log_weight)) continue;
      account.log_weight = value + account.log_prior;
      account.evidence.tau = point.tau;
      account.evidence.log_evidence = value;
      const Index best = first_of_equals(terms);
      const auto factor = static_cast<std::size_t>(best) % factors.size(),
                 tried = static_cast<std::size_t>(best) / factors.size();
      account.causes = {{entry.candidate, entry.tried[tried].a}};
      if (is_a_size(*entry.candidate))
        account.causes.front().a[0] = scaled_magnitude(*entry.candidate, account.causes.front().a[0], factors[factor]);
      account.across = best_across(entry, account.causes.front().a, terms, factors.size());
      account.effect = factors[factor] * entry.effects[tried];
      account.evidence.chi_squared = residual.squaredNorm() - 2.0 * terms[best];
    }
  }

  /// Adds a mode, and the same scales made smaller; for "nothing" also with a small scale in each contrast.
  void add_point(const LawEvidence& evidence, double value, int contrast) {
    if (evidence.tau.size() == 0) return;
    for (const double shrink : kShrinks) {
      points_.push_back({std::exp(-shrink) * evidence.tau, volume_of(evidence, value), contrast});
      if (contrast >= 0) continue;
      for (std::size_t c = 0; c < setting_.contrasts.size(); ++c) {
        ScreenPoint with = points_.back();
        with.contrast = static_cast<int>(c);
        with.tau[kFirstContrast + static_cast<int>(c)] = kLeft;
        with.log_volume += 0.5 * std::log(2.0 * std::numbers::pi);
        points_.push_back(with);
      }
    }
  }

  /// ln prior of a point's scales, given an effect.
  [[nodiscard]] double prior_of(const ScreenPoint& point, double effect) const {
    double sum = 0.0;
    for (Index c = 0; c < point.tau.size(); ++c)
      if (point.tau[c] > 0.0) {
        const ActiveClass active{static_cast<int>(c), c >= kFirstContrast ? left_scale(effect) : 1.0};
        sum += prior_of_scale(active, std::log(point.tau[c])).log_density;
      }
    return sum;
  }

  const LawSetting& setting_;
  LawSearch& search_;
  const OneLaw& law_;
  std::vector<ScreenPoint> points_;
};

}  // namespace

Index first_of_equals(const VectorXd& terms) {
  const double top = terms.maxCoeff(), rounding = 1e-9 * (1.0 + std::abs(top));
  return std::ranges::find_if(terms, [&](double t) { return t >= top - rounding; }) - terms.begin();
}

std::vector<ActiveClass> lasting_classes(const LawSystem& system) {
  std::vector<ActiveClass> out;
  for (int c = 0; c < kFirstContrast; ++c)
    if (!system.classes[static_cast<std::size_t>(c)].empty()) out.push_back({c, 1.0});
  return out;
}

double left_scale(double effect) { return std::max(kLeft, kLeft * kPerCent * effect); }

double effect_on(const Inference& inference, const VectorXd& change, const std::vector<bool>& acts) {
  double sum = 0.0;
  int rows = 0;
  for (const int r : inference.training()) {
    const Row& row = inference.map().features().rows[static_cast<std::size_t>(r)];
    if (row.type != RowType::frequency || !acts[static_cast<std::size_t>(row.condition)]) continue;
    sum += change[r] * change[r];
    ++rows;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0.0;
}

std::vector<bool> acting_conditions(const LawSetting& setting, const Candidate& candidate, int contrast) {
  const FeatureSet& features = setting.plain.map().features();
  std::vector<bool> out;
  for (std::size_t c = 0; c < features.conditions.size(); ++c)
    out.push_back(!candidate.state.empty() ? candidate.acts_in(features.conditions[c])
                  : contrast < 0           ? true
                                 : setting.contrasts[static_cast<std::size_t>(contrast)].weight[static_cast<Index>(c)] != 0.0);
  return out;
}

void collect_entries(const LawSetting& setting, LawSearch& search, const std::vector<const Candidate*>& candidates) {
  std::vector<LawEntry> all(candidates.size());
  parallel_for_told(
      candidates.size(),
      [&](std::size_t i) {
        all[i].candidate = candidates[i];
        all[i].contrasts = contrasts_of(*candidates[i], setting.contrasts);
        all[i].contrast = all[i].contrasts.empty() ? -1 : all[i].contrasts.front();
        all[i].tried = setting.informed.tried(search.base, *candidates[i]);
      },
      [&](int done, int of) { setting.progress("entries tried", done, of); });
  std::map<std::pair<bool, int>, double> share;  // prior of a class of causes: channels, or one contrast
  const auto class_of = [](const LawEntry& e) { return std::pair(is_of_a_channel(*e.candidate), e.contrast); };
  std::vector<VectorXd> columns;
  for (LawEntry& entry : all) {
    const auto shows = [&](const Inference::Tried& t) {
      return setting.informed.whitened(search.base, t.change).norm() > kShows;
    };
    if (std::ranges::none_of(entry.tried, shows)) continue;
    const std::vector<bool> acts = acting_conditions(setting, *entry.candidate, entry.contrast);
    entry.first_signature = std::ssize(columns);
    for (const Inference::Tried& tried : entry.tried) {
      entry.effects.push_back(effect_on(setting.plain, tried.change, acts));
      columns.emplace_back(tried.change(setting.plain.training()));
    }
    share[class_of(entry)] += std::exp(entry.candidate->log_prior);
    search.entries.push_back(std::move(entry));
  }
  for (LawEntry& entry : search.entries) {
    // An error of the model beside a change is no answer, so it needs no low prior odds.
    const bool in_all_alike = entry.contrast < 0 && !is_of_a_channel(*entry.candidate) && !is_model_error(setting, entry);
    entry.log_prior = entry.candidate->log_prior - std::log(share.at(class_of(entry))) +
                      (in_all_alike ? setting.static_odds : kOddsOfAChange);
  }
  search.system.signatures.resize(std::ssize(setting.plain.training()), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) search.system.signatures.col(static_cast<Index>(k)) = columns[k];
}

void screen_by_law(const LawSetting& setting, LawSearch& search, const OneLaw& law) {
  Screen screen(setting, search, law);
  screen.weigh_nothing();
  screen.weigh_entries();
  sort_accounts(search.accounts);
}

void sort_accounts(std::vector<LawAccount>& accounts) {
  std::ranges::stable_sort(accounts, [](const LawAccount& a, const LawAccount& b) { return a.log_weight > b.log_weight; });
}

}  // namespace twindeck::diagnosis
