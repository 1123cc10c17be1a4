#include "diagnosis/law_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/parallel.hpp"
#include "diagnosis/form_frame.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "diagnosis/law_sets.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const double kOddsOfAChange = std::log(0.1);  // of all causes of a contrast against nothing, of "something else", of channels
constexpr double kLeftPart = 0.1;             // of a cause's effect: scale of what it leaves over in its contrast …
constexpr double kLeastLeft = 0.1;            // … in units of the class, at least
constexpr double kPerCent = 100.0;            // units of a class in a relative effect
const double kShrinks[] = {0.0, 1.5, 3.0};    // of ln tau: a large cause leaves smaller errors than nothing does
constexpr double kShows = 1e-3;               // deviations: below, these rows show nothing of an entry
constexpr double kKeptMagnitudes = 10.0;      // nats of the best: farther ones add nothing
constexpr double kOneFit = 0.01;              // prior deviations: nearer fits are one
constexpr std::size_t kLeading = 6, kMostLeading = 10, kOfFewPlaces = 6;
constexpr int kLeadingRounds = 4;
constexpr std::size_t kTriedBeside = 3;                   // entries that are tried beside the leading account
constexpr double kNear = 8.0, kNearFamily = 12.0;         // nats of the best: worth a fit of their own …
constexpr double kNearShare = 0.1, kFamilyShareOf = 0.3;  // … or this much of what it has over nothing
constexpr double kFarBelow = -8.0;  // nats against nothing: where the best entry is below, no fit brings it to five per cent

double log_sum_of(const VectorXd& v) {
  const double top = v.maxCoeff();
  return top + std::log((v.array() - top).exp().sum());
}

/// RMS change of the frequencies in the conditions where something acts.
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

/// Scale of what a cause leaves over, in units of its contrast's class.
double left_scale(double effect) { return std::max(kLeastLeft, kLeftPart * kPerCent * effect); }

/// Fills entries and the signatures of the base's system.
void collect_entries(const LawSetting& setting, LawSearch& search) {
  const auto& candidates = setting.plain.candidates();
  std::vector<LawEntry> all(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    all[i].candidate = candidates[i].get();
    all[i].contrast = contrast_of(*candidates[i], setting.contrasts);
    all[i].tried = setting.informed.tried(search.base, *candidates[i]);
  });
  std::map<std::pair<bool, int>, double> share;  // of a class of causes: channels, or by contrast
  const auto class_of = [](const LawEntry& e) { return std::pair(is_of_a_channel(*e.candidate), e.contrast); };
  std::vector<VectorXd> columns;
  for (LawEntry& entry : all) {
    const auto shows = [&](const Inference::Tried& t) {
      return setting.informed.whitened(search.base, t.change).norm() > kShows;
    };
    if (std::none_of(entry.tried.begin(), entry.tried.end(), shows)) continue;
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
    const bool everywhere = entry.contrast < 0 && !is_of_a_channel(*entry.candidate);
    entry.log_prior =
        entry.candidate->log_prior - std::log(share.at(class_of(entry))) + (everywhere ? setting.static_odds : kOddsOfAChange);
  }
  search.system.signatures.resize(std::ssize(setting.plain.training()), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) search.system.signatures.col(static_cast<Index>(k)) = columns[k];
}

/// Scales at which entries are looked at, with the volume of Laplace's approximation.
struct ScreenPoint {
  VectorXd tau;
  double log_volume = 0.0;
  int contrast = -1;
};

double volume_of(const LawEvidence& evidence, double value) { return evidence.log_evidence - value; }

class Screen {
 public:
  Screen(const LawSetting& setting, LawSearch& search, const OneLaw& law)
      : setting_(setting),
        search_(search),
        law_(law),
        residual_(law.whitened(search.system.residual)),
        signatures_(law.whitened(search.system.signatures)) {}

  /// The modes of nothing and of something else.
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
      search_.else_weight.push_back(search_.something_else[c].log_evidence + kOddsOfAChange);
      add_point(search_.something_else[c], value[c], static_cast<int>(c));
    }
  }

  /// Every entry alone, its magnitudes summed over, at the best of the points.
  void weigh_entries() {
    search_.accounts.resize(search_.entries.size());
    for (std::size_t i = 0; i < search_.entries.size(); ++i) {
      search_.accounts[i].members = {static_cast<int>(i)};
      search_.accounts[i].log_prior = search_.entries[i].log_prior;
    }
    for (const ScreenPoint& point : points_) {
      const OneLaw::Point at = law_.at(point.tau);
      if (at.lower.size() == 0) continue;
      const VectorXd residual = linalg::lower_solve(at.lower, residual_);
      const MatrixXd signatures = linalg::lower_solve(at.lower, signatures_);
      const VectorXd along = signatures.transpose() * residual, square = signatures.colwise().squaredNorm();
      parallel_for(search_.accounts.size(), [&](std::size_t i) {
        const LawEntry& entry = search_.entries[i];
        if (entry.contrast != point.contrast) return;
        LawAccount& account = search_.accounts[i];
        const std::vector<double> factors = magnitude_factors(*entry.candidate);
        VectorXd terms(std::ssize(entry.tried) * std::ssize(factors));
        Index k = 0;
        for (std::size_t m = 0; m < entry.tried.size(); ++m)
          for (const double t : factors) {
            const Index s = entry.first_signature + static_cast<Index>(m);
            terms[k++] = t * along[s] - 0.5 * t * t * square[s] + prior_of(point, t * entry.effects[m]);
          }
        const double value = log_sum_of(terms) - std::log(static_cast<double>(terms.size())) -
                             0.5 * (residual.squaredNorm() + at.log_determinant) + point.log_volume;
        if (!(value + account.log_prior > account.log_weight)) return;
        account.log_weight = value + account.log_prior;
        account.evidence.tau = point.tau;
        account.evidence.log_evidence = value;
        Index best = 0;
        terms.maxCoeff(&best);
        const auto factor = static_cast<std::size_t>(best) % factors.size(),
                   tried = static_cast<std::size_t>(best) / factors.size();
        account.causes = {{entry.candidate, entry.tried[tried].a}};
        if (is_a_size(*entry.candidate))
          account.causes.front().a[0] = scaled_magnitude(*entry.candidate, account.causes.front().a[0], factors[factor]);
        account.effect = factors[factor] * entry.effects[tried];
        account.evidence.chi_squared = residual.squaredNorm() - 2.0 * terms[best];
      });
    }
  }

 private:
  /// A mode and the same errors made smaller; of nothing also with a little left over in each contrast.
  void add_point(const LawEvidence& evidence, double value, int contrast) {
    if (evidence.tau.size() == 0) return;
    for (const double shrink : kShrinks) {
      points_.push_back({std::exp(-shrink) * evidence.tau, volume_of(evidence, value), contrast});
      if (contrast >= 0) continue;
      for (std::size_t c = 0; c < setting_.contrasts.size(); ++c) {
        ScreenPoint with = points_.back();
        with.contrast = static_cast<int>(c);
        with.tau[kFirstContrast + static_cast<int>(c)] = kLeastLeft;
        with.log_volume += 0.5 * std::log(2.0 * std::numbers::pi);
        points_.push_back(with);
      }
    }
  }

  /// ln prior of a point's scales beside an effect.
  [[nodiscard]] double prior_of(const ScreenPoint& point, double effect) const {
    double sum = 0.0;
    for (Index c = 0; c < point.tau.size(); ++c)
      if (point.tau[c] > 0.0) sum += log_half_t(std::log(point.tau[c]), c >= kFirstContrast ? left_scale(effect) : 1.0);
    return sum;
  }

  const LawSetting& setting_;
  LawSearch& search_;
  const OneLaw& law_;
  MatrixXd residual_, signatures_;
  std::vector<ScreenPoint> points_;
};

void sort_accounts(std::vector<LawAccount>& accounts) {
  std::stable_sort(accounts.begin(), accounts.end(),
                   [](const LawAccount& a, const LawAccount& b) { return a.log_weight > b.log_weight; });
}

/// Classes of a set of causes; an effect sets what is left over in each of its contrasts.
std::vector<ActiveClass> classes_of(const LawSearch& search, const LawSystem& system, const LawAccount& account,
                                    double effect) {
  std::vector<ActiveClass> out = lasting_classes(system);
  std::set<int> contrasts;
  for (const int m : account.members) contrasts.insert(search.entries[static_cast<std::size_t>(m)].contrast);
  for (const int contrast : contrasts)
    if (contrast >= 0) out.push_back({kFirstContrast + contrast, left_scale(effect)});
  return out;
}

/// A set at the base: all combinations of its members' magnitudes, those that add nothing left out, at its own scales.
void score_at_base(const OneLaw& law, const LawSearch& search, LawAccount& account) {
  struct Choice {
    VectorXd change;
    std::vector<VectorXd> a;
    double square = 0.0;  // of the effect
  };
  std::vector<Choice> choices = {{VectorXd::Zero(search.system.residual.size()), {}, 0.0}};
  for (const int m : account.members) {
    const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
    std::vector<Choice> next;
    for (const Choice& before : choices)
      for (std::size_t i = 0; i < entry.tried.size(); ++i)
        for (const double t : magnitude_factors(*entry.candidate)) {
          Choice choice = before;
          choice.change += t * search.system.signatures.col(entry.first_signature + static_cast<Index>(i));
          choice.a.push_back(entry.tried[i].a);
          if (is_a_size(*entry.candidate)) choice.a.back()[0] = scaled_magnitude(*entry.candidate, choice.a.back()[0], t);
          choice.square += t * t * entry.effects[i] * entry.effects[i];
          next.push_back(std::move(choice));
        }
    choices = std::move(next);
  }
  MatrixXd left(search.system.residual.size(), std::ssize(choices));
  for (Index k = 0; k < left.cols(); ++k) left.col(k) = search.system.residual - choices[static_cast<std::size_t>(k)].change;
  const OneLaw::Point at = law.at(account.evidence.tau);
  if (at.lower.size() == 0) return;
  const VectorXd chi_squared = linalg::lower_solve(at.lower, law.whitened(left)).colwise().squaredNorm();
  std::vector<int> kept;
  Index best = 0;
  chi_squared.minCoeff(&best);
  for (Index k = 0; k < left.cols(); ++k)
    if (chi_squared[k] < chi_squared[best] + 2.0 * kKeptMagnitudes) kept.push_back(static_cast<int>(k));
  const double effect = std::sqrt(choices[static_cast<std::size_t>(best)].square);
  LawHypothesis hypothesis{left(Eigen::all, kept),
                           VectorXd::Constant(std::ssize(kept), -std::log(static_cast<double>(left.cols()))),
                           MatrixXd(left.rows(), 0),
                           {},
                           {},
                           classes_of(search, search.system, account, effect)};
  const LawEvidence evidence = law.scored(hypothesis, account.evidence.tau);
  if (evidence.weight.size() == 0) return;
  Index most = 0;
  evidence.weight.maxCoeff(&most);
  const Choice& chosen = choices[static_cast<std::size_t>(kept[static_cast<std::size_t>(most)])];
  account.causes.clear();
  for (std::size_t m = 0; m < account.members.size(); ++m)
    account.causes.push_back({search.entries[static_cast<std::size_t>(account.members[m])].candidate, chosen.a[m]});
  account.effect = std::sqrt(chosen.square);
  account.evidence = evidence;
  account.hypothesis = std::move(hypothesis);
  account.log_weight = evidence.log_evidence + account.log_prior;
  account.scored = true;
}

/// A set with its causes in the model, fitted from each start; the largest evidence counts.
void refine_by_law(const LawSetting& setting, const LawSearch& search, LawAccount& account,
                   const std::vector<VectorXd>& starts) {
  std::vector<Cause> start = search.base.causes;
  start.insert(start.end(), account.causes.begin(), account.causes.end());
  const VectorXd tau = account.evidence.tau;
  std::vector<bool> acts(setting.plain.map().features().conditions.size(), false);
  for (const int m : account.members) {
    const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
    const std::vector<bool> own = acting_conditions(setting, *entry.candidate, entry.contrast);
    for (std::size_t c = 0; c < acts.size(); ++c) acts[c] = acts[c] || own[c];
  }
  VectorXd found_before;
  for (const VectorXd& x : starts) {
    Fit with = setting.informed.fit(start, x);
    if (!with.made()) continue;
    if (found_before.size() > 0 && (with.map.x - found_before).norm() < kOneFit) continue;
    found_before = with.map.x;
    auto system = std::make_shared<LawSystem>(law_system(setting.plain, with, setting.contrasts, account.members.size()));
    if (!can_be_weighed(*system)) continue;  // costs the entry, not the results
    const OneLaw law(*system);
    if (!law.sound()) continue;
    const Prediction without = setting.plain.map().predict(with.base, search.base.causes, false);
    const double effect = without.valid ? effect_on(setting.plain, change_between(without, with.all), acts) : account.effect;
    LawHypothesis hypothesis{system->residual,
                             VectorXd::Zero(1),
                             system->signatures,
                             VectorXd(system->signatures.cols()),
                             VectorXd(system->signatures.cols()),
                             classes_of(search, *system, account, effect)};
    Index at = 0;
    for (std::size_t c = search.base.causes.size(); c < with.causes.size(); ++c)
      for (Index k = 0; k < with.causes[c].a.size(); ++k, ++at) {
        hypothesis.low[at] = with.causes[c].candidate->low[k] - with.causes[c].a[k];
        hypothesis.high[at] = with.causes[c].candidate->high[k] - with.causes[c].a[k];
      }
    const LawEvidence evidence = law.scored(hypothesis, tau);
    if (!(evidence.log_evidence + account.log_prior > account.log_weight)) continue;
    account.log_weight = evidence.log_evidence + account.log_prior;
    account.evidence = evidence;
    account.hypothesis = std::move(hypothesis);
    account.effect = effect;
    account.causes.assign(with.causes.begin() + std::ssize(search.base.causes), with.causes.end());
    account.with = std::move(with);
    account.system = std::move(system);
  }
}

/// Scales that a set starts from: those of its best member that was scored, with what is left over in each of its contrasts.
VectorXd start_of_set(const LawSearch& search, const LawAccount& set) {
  VectorXd out = search.none.tau;
  const auto is_member = [&](const LawAccount& account) {
    return account.members.size() == 1 &&
           std::find(set.members.begin(), set.members.end(), account.members.front()) != set.members.end();
  };
  if (const auto best = std::find_if(search.accounts.begin(), search.accounts.end(), is_member); best != search.accounts.end())
    out = best->evidence.tau;
  out.tail(out.size() - kFirstContrast) *= 0.0;
  for (const int m : set.members)
    if (const int contrast = search.entries[static_cast<std::size_t>(m)].contrast; contrast >= 0)
      out[kFirstContrast + contrast] = kLeastLeft;
  return out;
}

/// A better optimiser must not look like a further cause: what the leading set's parameters do for each of its causes alone.
void fit_alone_from_sets(const LawSetting& setting, LawSearch& search) {
  sort_accounts(search.accounts);
  const LawAccount leader = search.accounts.front();
  if (leader.members.size() < 2 || !leader.refined()) return;
  const VectorXd x = leader.with.map.x.head(static_cast<Index>(setting.plain.map().nuisances().size()));
  const auto is_of_leader = [&](int m) {
    return std::find(leader.members.begin(), leader.members.end(), m) != leader.members.end();
  };
  for (LawAccount& account : search.accounts)
    if (account.members.size() < leader.members.size() && account.refined() &&
        std::all_of(account.members.begin(), account.members.end(), is_of_leader))
      refine_by_law(setting, search, account, {x});
}

/// Entries that promise most at the fit with the leading account in the model, each beside it.
std::vector<LawAccount> sets_beside(const LawSetting& setting, const LawSearch& search, const LawAccount& leader) {
  LawSearch beside;
  beside.base = leader.with;
  beside.system = law_system(setting.plain, beside.base, setting.contrasts);
  collect_entries(setting, beside);
  const OneLaw law(beside.system);
  std::vector<LawAccount> out;
  if (!can_be_weighed(beside.system) || !law.sound()) return out;
  Screen screen(setting, beside, law);
  screen.weigh_nothing();
  screen.weigh_entries();
  sort_accounts(beside.accounts);
  for (const LawAccount& found : beside.accounts) {
    if (out.size() == kTriedBeside || found.log_weight < beside.none.log_evidence + kFarBelow) break;
    const Candidate* candidate = beside.entries[static_cast<std::size_t>(found.members.front())].candidate;
    const auto entry =
        std::find_if(search.entries.begin(), search.entries.end(), [&](const LawEntry& e) { return e.candidate == candidate; });
    const auto position = static_cast<int>(entry - search.entries.begin());
    if (entry == search.entries.end() ||
        std::find(leader.members.begin(), leader.members.end(), position) != leader.members.end())
      continue;
    LawAccount set;
    set.members = leader.members;
    set.members.push_back(position);
    set.log_prior = leader.log_prior + entry->log_prior;
    set.evidence.tau = leader.evidence.tau;
    set.causes = leader.causes;
    set.causes.push_back(found.causes.front());
    out.push_back(std::move(set));
  }
  return out;
}

/// Further causes beside the leading account, looked for with it in the model: one that is large hides the others from the
/// base, where modes may be none of the model's for its sake.
void look_beside_leader(const LawSetting& setting, LawSearch& search) {
  for (std::size_t size = 1; size < kMostInASet; ++size) {
    const auto best = std::find_if(search.accounts.begin(), search.accounts.end(),
                                   [&](const LawAccount& a) { return a.members.size() == size && a.refined(); });
    if (best == search.accounts.end() || (size > 1 && best != search.accounts.begin())) return;
    const LawAccount leader = *best;
    std::vector<LawAccount> sets = sets_beside(setting, search, leader);
    const VectorXd x = leader.with.map.x.head(static_cast<Index>(setting.plain.map().nuisances().size()));
    parallel_for(sets.size(), [&](std::size_t i) { refine_by_law(setting, search, sets[i], {x}); });
    for (LawAccount& set : sets) {
      set.scored = set.refined();
      const auto same = std::find_if(search.accounts.begin(), search.accounts.end(), [&](const LawAccount& a) {
        return std::is_permutation(a.members.begin(), a.members.end(), set.members.begin(), set.members.end());
      });
      if (same == search.accounts.end())
        search.accounts.push_back(std::move(set));
      else if (set.log_weight > same->log_weight)
        *same = std::move(set);
    }
    std::erase_if(search.accounts, [](const LawAccount& a) { return a.members.size() > 1 && !a.scored; });
    sort_accounts(search.accounts);
  }
}

/// Accounts that are worth a fit of their own: the best and the best of each family.
std::vector<LawAccount*> leading_accounts(LawSearch& search, const std::set<int>& done) {
  const double best = search.accounts.front().log_weight, over = std::max(0.0, best - search.none.log_evidence);
  const double near = best - std::max(kNear, kNearShare * over);
  const double near_family = best - std::max(kNearFamily, kFamilyShareOf * over);
  const auto candidate_of = [&](const LawAccount& account) {
    return search.entries[static_cast<std::size_t>(account.members.front())].candidate;
  };
  std::map<std::string, std::size_t> places;
  for (const LawAccount& account : search.accounts)
    if (candidate_of(account)->further_states.empty()) ++places[candidate_of(account)->hypothesis->id];
  std::set<std::string> families, wholly;
  std::vector<LawAccount*> out;
  const std::string leading_place = candidate_of(search.accounts.front())->location;
  for (std::size_t i = 0; i < search.accounts.size(); ++i) {
    LawAccount& account = search.accounts[i];
    const Candidate& candidate = *candidate_of(account);
    const std::string& family = candidate.hypothesis->id;
    const bool first_of_family = families.insert(family).second;
    // The base has taken a cause at one of few places up into a parameter of them all, so that the screen sees its reverse at
    // the others.
    if (first_of_family && account.log_weight > search.none.log_evidence && places[family] <= kOfFewPlaces)
      wholly.insert(family);
    const bool near_best = (i < kLeading && account.log_weight > near) || (first_of_family && account.log_weight > near_family);
    // Another family at the leader's own place is its nearest rival, however coarse the screen's magnitudes are.
    const bool same_place = candidate.location == leading_place && leading_place.find(':') != std::string::npos;
    const bool worth = wholly.contains(family) || same_place || (near_best && out.size() < kMostLeading);
    if (worth && !done.contains(account.members.front())) out.push_back(&account);
  }
  return out;
}

}  // namespace

// A wrong label of a mode looks like an error of the form.
bool is_of_a_channel(const Candidate& candidate) { return candidate.hypothesis->measurement && !candidate.channels.empty(); }

std::vector<ActiveClass> lasting_classes(const LawSystem& system) {
  std::vector<ActiveClass> out;
  for (int c = 0; c < kFirstContrast; ++c)
    if (system.classes[static_cast<std::size_t>(c)].cols() > 0) out.push_back({c, 1.0});
  return out;
}

LawSearch search_by_law(const LawSetting& setting, const Fit& base) {
  LawSearch out;
  out.base = base;
  out.system = law_system(setting.plain, base, setting.contrasts);
  collect_entries(setting, out);
  const OneLaw law(out.system);
  out.weighed = can_be_weighed(out.system) && law.sound();
  if (!out.weighed) return out;
  Screen screen(setting, out, law);
  screen.weigh_nothing();
  screen.weigh_entries();
  sort_accounts(out.accounts);
  if (out.accounts.empty() || out.accounts.front().log_weight < out.none.log_evidence + kFarBelow) return out;
  const auto n = static_cast<Index>(setting.plain.map().nuisances().size());
  const std::vector<VectorXd> starts = {out.base.map.x.head(n), {}};
  std::set<int> done;
  for (int round = 0; round < kLeadingRounds && !done.contains(out.accounts.front().members.front()); ++round) {
    const std::vector<LawAccount*> these = leading_accounts(out, done);
    if (these.empty()) break;
    parallel_for(these.size(), [&](std::size_t i) {
      score_at_base(law, out, *these[i]);
      if (these[i]->scored) refine_by_law(setting, out, *these[i], starts);
    });
    for (const LawAccount* account : these) done.insert(account->members.front());
    sort_accounts(out.accounts);
  }
  std::vector<LawAccount> sets;
  add_sets(
      out, law,
      [&](LawAccount& account) {
        account.evidence.tau = start_of_set(out, account);
        score_at_base(law, out, account);
        if (account.scored) refine_by_law(setting, out, account, starts);
      },
      sets);
  for (LawAccount& account : sets) out.accounts.push_back(std::move(account));
  sort_accounts(out.accounts);
  look_beside_leader(setting, out);
  fit_alone_from_sets(setting, out);
  sort_accounts(out.accounts);
  return out;
}

}  // namespace twindeck::diagnosis
