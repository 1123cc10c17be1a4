#include "diagnosis/law_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "core/parallel.hpp"
#include "diagnosis/form_base.hpp"
#include "diagnosis/form_magnitudes.hpp"
#include "diagnosis/law_openings.hpp"
#include "diagnosis/law_screen.hpp"
#include "diagnosis/law_sets.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kKeptMagnitudes = 10.0;  // nats of the best: farther ones add nothing
constexpr double kOneFit = 0.01;          // prior deviations: nearer fits are one
constexpr std::size_t kLeading = 6, kMostLeading = 10, kOfFewPlaces = 6;
constexpr int kLeadingRounds = 4;
constexpr double kStands = 1.0;                   // nats that one more fit gains: less is the same fit
constexpr double kNear = 12.0, kNearShare = 0.3;  // nats of the best, or part of what it has over nothing: worth a fit
constexpr double kFarBelow = -8.0;  // nats against nothing: where the best entry is below, no fit brings it to five per cent

/// Classes of a set of causes; an effect sets what is left over in each of its contrasts.
std::vector<ActiveClass> classes_of(const LawSearch& search, const LawSystem& system, const LawAccount& account,
                                    double effect) {
  std::vector<ActiveClass> out = lasting_classes(system);
  std::set<int> contrasts;
  for (const int m : account.members) {
    const std::vector<int>& own = search.entries[static_cast<std::size_t>(m)].contrasts;
    contrasts.insert(own.begin(), own.end());
  }
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
  const VectorXd chi_squared = law.solved(at, law.whitened(left)).colwise().squaredNorm();
  std::vector<int> kept;
  const Index best = first_of_equals(-chi_squared);
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
  const Index most = first_of_equals(evidence.weight);
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

bool acts_in_contrast(const LawSearch& search, const LawAccount& account, int contrast) {
  return std::any_of(account.members.begin(), account.members.end(), [&](int m) {
    const std::vector<int>& own = search.entries[static_cast<std::size_t>(m)].contrasts;
    return std::find(own.begin(), own.end(), contrast) != own.end();
  });
}

/// A set at a fit with its causes in the model. Of fits the one of the largest evidence counts, and it takes the place of what
/// the screen found.
void weigh_fit(const LawSetting& setting, const LawSearch& search, LawAccount& account, const VectorXd& tau, Fit with) {
  std::vector<bool> acts(setting.plain.map().features().conditions.size(), false);
  for (const int m : account.members) {
    const LawEntry& entry = search.entries[static_cast<std::size_t>(m)];
    const std::vector<bool> own = acting_conditions(setting, *entry.candidate, entry.contrast);
    for (std::size_t c = 0; c < acts.size(); ++c) acts[c] = acts[c] || own[c];
  }
  std::vector<Contrast> contrasts = setting.contrasts;  // those of the set alone: the others' classes are absent
  for (std::size_t c = 0; c < contrasts.size(); ++c)
    if (!acts_in_contrast(search, account, static_cast<int>(c))) contrasts[c].weight.setZero();
  auto system = std::make_shared<FitSystem>(law_system(setting.plain, with, contrasts, account.members.size()));
  if (!can_be_weighed(*system)) return;  // costs the entry, not the results
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
  OpenedEvidence found = scored_with_openings(setting.plain, *system, hypothesis, tau);
  const double weight = found.evidence.log_evidence + account.log_prior;
  if (found.evidence.weight.size() == 0 || (account.refined() && !(weight > account.log_weight))) return;
  account.log_weight = weight;
  account.evidence = std::move(found.evidence);
  account.opened = std::move(found.opened);
  account.hypothesis = std::move(hypothesis);
  account.effect = effect;
  account.causes.assign(with.causes.begin() + std::ssize(search.base.causes), with.causes.end());
  account.with = std::move(with);
  account.system = std::move(system);
  account.scored = true;
}

/// Puts a weighed account to its fit under its own scales, whatever that takes from the weight, and on while that grows.
/// @param weighed  an account as it stands at another fit, without a system where it cannot be weighed there
void settle(const LawSetting& setting, LawAccount& account, const std::function<LawAccount(const LawAccount&, Fit)>& weighed) {
  for (int round = 0; round < kLeadingRounds; ++round) {
    Fit with = fit_by_own_scales(setting, account);
    if (!with.made()) return;
    LawAccount anew = weighed(account, std::move(with));
    if (!anew.refined() || !anew.scored || (round > 0 && anew.log_weight < account.log_weight + kStands)) return;
    account = std::move(anew);
  }
}

void settle_causes(const LawSetting& setting, const LawSearch& search, LawAccount& account) {
  account.settled = true;
  account.first_weight = account.log_weight;
  settle(setting, account, [&](const LawAccount& before, Fit with) {
    LawAccount anew = before;
    anew.system.reset();
    weigh_fit(setting, search, anew, before.evidence.tau, std::move(with));
    return anew;
  });
}

/// Fits a set with its causes in the model from each start of the parameters. A single factor starts from both sides of one:
/// the base may have moved a parameter of several places for one of them, and the others then look as if they had changed.
void refine_by_law(const LawSetting& setting, const LawSearch& search, LawAccount& account,
                   const std::vector<VectorXd>& starts) {
  std::vector<std::vector<Cause>> causes = {search.base.causes};
  causes[0].insert(causes[0].end(), account.causes.begin(), account.causes.end());
  if (account.members.size() == 1 && account.across.size() > 0) {
    causes.push_back(causes[0]);
    causes[1].back().a = account.across;
  }
  const VectorXd tau = account.evidence.tau;
  for (const std::vector<Cause>& start : causes)
    for (const VectorXd& x : starts) {
      Fit with = setting.informed.fit(start, x);
      const auto is_same = [&](const VectorXd& before) { return (with.map.x - before).norm() < kOneFit; };
      if (!with.made() || std::any_of(account.fitted.begin(), account.fitted.end(), is_same)) continue;
      account.fitted.push_back(with.map.x);
      weigh_fit(setting, search, account, tau, std::move(with));
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
    for (const int contrast : search.entries[static_cast<std::size_t>(m)].contrasts) out[kFirstContrast + contrast] = kLeft;
  return out;
}

VectorXd parameters_of(const LawSetting& setting, const LawAccount& account) {
  return account.with.map.x.head(std::ssize(setting.plain.map().nuisances()));
}

/// Puts the leader and its rivals to their fits under their own scales, until none among them is new. A better optimiser must
/// look neither like a further cause nor like another one: the rivals are fitted from the leader's parameters too. From their
/// own starts they may have paired a measured mode with another mode of the model.
void settle_rivals(const LawSetting& setting, LawSearch& search) {
  for (int round = 0; round < kLeadingRounds; ++round) {
    sort_accounts(search.accounts);
    if (search.accounts.empty() || !search.accounts.front().refined()) return;
    const LawAccount leader = search.accounts.front();
    const VectorXd x = parameters_of(setting, leader);
    std::vector<LawAccount*> rivals;
    for (std::size_t i = 0; i < std::min(kMostLeading, search.accounts.size()); ++i) {
      LawAccount& account = search.accounts[i];
      if (account.refined() && !(account.settled && account.beside == leader.members)) rivals.push_back(&account);
    }
    if (rivals.empty()) return;
    parallel_for_told(
        rivals.size(),
        [&](std::size_t i) {
          LawAccount& account = *rivals[i];
          account.beside = leader.members;
          LawAccount anew = account;
          anew.system.reset();
          if (account.members != leader.members) refine_by_law(setting, search, anew, {x});
          account.fitted = anew.fitted;
          const double before = account.settled ? account.first_weight : account.log_weight;
          const bool promises = anew.refined() && anew.log_weight > before;
          if (!account.settled) {
            if (promises) account = anew;
            settle_causes(setting, search, account);
          } else if (promises) {
            settle_causes(setting, search, anew);
            if (anew.log_weight > account.log_weight) account = std::move(anew);
          }
        },
        [&](int done, int of) { setting.progress("rivals fitted", done, of); });
  }
  sort_accounts(search.accounts);
}

/// Entries that promise most at the fit with the leading account in the model, each beside it. Of `among` the leading ones are
/// left, the best first: what promises nothing beside the leader is not tried beside more.
std::vector<LawAccount> sets_beside(const LawSetting& setting, const LawSearch& search, const LawAccount& leader,
                                    std::vector<const LawEntry*>& among) {
  LawSearch beside;
  beside.base = leader.with;
  beside.system = law_system(setting.plain, beside.base, setting.contrasts);
  std::vector<const Candidate*> candidates;
  for (const LawEntry* entry : among) candidates.push_back(entry->candidate);
  collect_entries(setting, beside, candidates);
  const OneLaw law(beside.system);
  std::vector<LawAccount> out;
  if (!can_be_weighed(beside.system) || !law.sound()) return out;
  const auto known_as = [&](const LawEntry& entry) {
    return *std::find_if(among.begin(), among.end(), [&](const LawEntry* e) { return e->candidate == entry.candidate; });
  };
  for (LawEntry& entry : beside.entries) entry.log_prior = known_as(entry)->log_prior;
  screen_by_law(setting, beside, law);
  std::vector<const LawEntry*> leading;
  for (const LawAccount& found : beside.accounts) {
    const LawEntry* entry = known_as(beside.entries[static_cast<std::size_t>(found.members.front())]);
    if (leading.size() < kMembersOfSets) leading.push_back(entry);
    if (out.size() == kTried || found.log_weight < beside.none.log_evidence + kFarBelow) continue;
    const auto position = static_cast<int>(entry - search.entries.data());
    const auto is_known = [&](int m) { return is_same_cause(search.entries[static_cast<std::size_t>(m)], *entry); };
    if (std::any_of(leader.members.begin(), leader.members.end(), is_known)) continue;
    LawAccount set;
    set.members = leader.members;
    set.members.push_back(position);
    set.log_prior = leader.log_prior + entry->log_prior;
    set.evidence.tau = leader.evidence.tau;
    set.causes = leader.causes;
    set.causes.push_back(found.causes.front());
    out.push_back(std::move(set));
  }
  among = std::move(leading);
  return out;
}

/// Further causes beside the leading account, looked for with it in the model: one that is large hides the others from the
/// base, where modes may be none of the model's for its sake.
void look_beside_leader(const LawSetting& setting, LawSearch& search) {
  std::vector<const LawEntry*> among;
  for (const LawEntry& entry : search.entries) among.push_back(&entry);
  for (std::size_t size = 1; size < kMostInASet; ++size) {
    const auto best = std::find_if(search.accounts.begin(), search.accounts.end(),
                                   [&](const LawAccount& a) { return a.members.size() == size && a.refined(); });
    if (best == search.accounts.end()) return;
    const LawAccount leader = *best;
    std::vector<LawAccount> sets = sets_beside(setting, search, leader, among);
    const VectorXd x = parameters_of(setting, leader);
    parallel_for_told(
        sets.size(), [&](std::size_t i) { refine_by_law(setting, search, sets[i], {x}); },
        [&](int done, int of) { setting.progress("further causes fitted", done, of); });
    for (LawAccount& set : sets) {
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
    const bool near_best = (i < kLeading || first_of_family) && account.log_weight > near;
    // Another family at the leader's own place is its nearest rival, however coarse the screen's magnitudes are.
    const bool same_place = candidate.location == leading_place && leading_place.find(':') != std::string::npos;
    const bool worth = wholly.contains(family) || same_place || (near_best && out.size() < kMostLeading);
    if (worth && !done.contains(account.members.front())) out.push_back(&account);
  }
  return out;
}

}  // namespace

Fit fit_by_own_scales(const LawSetting& setting, const LawAccount& account, const std::vector<int>& aside) {
  const LawSystem& system = *account.system;
  const Index rows = system.residual.size();
  MatrixXd share = MatrixXd::Zero(rows, rows);
  for (std::size_t c = 0; c < system.classes.size(); ++c) {
    if (c == kGains) continue;  // unknowns of the fit itself
    const MatrixXd columns = account.evidence.tau[static_cast<Index>(c)] * system.classes[c];
    if (columns.size() > 0) share += linalg::square(columns);
  }
  for (const int row : aside) share(row, row) += kAside * kAside;
  const FeatureMap& plain = setting.plain.map();
  MatrixXd further = MatrixXd::Zero(plain.values().size(), plain.values().size());
  further(setting.plain.training(), setting.plain.training()) = share;
  FeatureMap map = with_open(plain, account.opened);
  map.add_covariance(further);
  std::vector<Cause> causes = account.with.causes;
  Index at = 0;
  for (std::size_t c = causes.size() - account.causes.size(); c < causes.size(); ++c)
    for (Index k = 0; k < causes[c].a.size(); ++k, ++at) causes[c].a[k] += account.evidence.shift[at];
  return Inference(map, setting.plain.candidates()).fit(causes, account.with.map.x.head(std::ssize(plain.nuisances())));
}

bool is_same_cause(const LawEntry& a, const LawEntry& b) {
  return a.candidate->hypothesis == b.candidate->hypothesis && a.candidate->location == b.candidate->location;
}

bool is_model_error(const LawSetting& setting, const LawEntry& entry) {
  const FeatureSet& features = setting.plain.map().features();
  return entry.contrast < 0 && !is_of_a_channel(*entry.candidate) && states_of(features).size() > 1 &&
         std::all_of(features.conditions.begin(), features.conditions.end(),
                     [&](const Condition& condition) { return entry.candidate->acts_in(condition); });
}

const LawAccount& account_to_take(const std::vector<const LawAccount*>& possible) {
  const auto before = [](const LawAccount* a, const LawAccount* b) {
    return a->scored != b->scored ? a->scored : a->members.size() < b->members.size();
  };
  return **std::min_element(possible.begin(), possible.end(), before);
}

namespace {

/// No cause, and at most one contrast's class, at a fit without causes of the catalogue.
LawAccount weigh_without(const LawSetting& setting, FitSystem system, const std::vector<ActiveClass>& contrast,
                         const VectorXd& tau, const Fit& with) {
  system.signatures.resize(system.residual.size(), 0);
  LawAccount account;
  account.hypothesis = {system.residual, VectorXd::Zero(1), system.signatures, {}, {}, lasting_classes(system)};
  account.hypothesis.active.insert(account.hypothesis.active.end(), contrast.begin(), contrast.end());
  auto held = std::make_shared<FitSystem>(std::move(system));
  OpenedEvidence opened = scored_with_openings(setting.plain, *held, account.hypothesis, tau);
  account.evidence = std::move(opened.evidence);
  account.opened = std::move(opened.opened);
  account.log_weight = account.evidence.log_evidence;
  account.system = std::move(held);
  account.with = with;
  account.scored = account.evidence.weight.size() > 0;
  return account;
}

/// No cause, and "something else" in each contrast, as they are held against the causes: from a fit without causes, with modes
/// of their own opened and under their own scales. The better one of two starts counts.
void weigh_nothing(const LawSetting& setting, LawSearch& search, const Fit& start) {
  if (!start.made()) return;
  const FitSystem at_start = law_system(setting.plain, start, setting.contrasts);
  if (!can_be_weighed(at_start)) return;
  const auto weigh = [&](const std::vector<ActiveClass>& contrast, const VectorXd& tau) {
    LawAccount account = weigh_without(setting, at_start, contrast, tau, start);
    if (!account.scored) return account;
    settle(setting, account, [&](const LawAccount& before, const Fit& with) {
      FitSystem system = law_system(setting.plain, with, setting.contrasts);
      if (!can_be_weighed(system)) return LawAccount{};
      return weigh_without(setting, std::move(system), contrast, before.evidence.tau, with);
    });
    return account;
  };
  parallel_for(search.else_weight.size() + 1, [&](std::size_t k) {
    if (k == 0) {
      LawAccount found = weigh({}, search.none.tau);
      if (!search.nothing.scored || found.log_weight > search.nothing.log_weight) search.nothing = std::move(found);
      return;
    }
    const LawAccount found = weigh({{kFirstContrast + static_cast<int>(k) - 1, 1.0}}, search.something_else[k - 1].tau);
    if (found.scored) search.else_weight[k - 1] = std::max(search.else_weight[k - 1], kOddsOfAChange + found.log_weight);
  });
}

}  // namespace

LawSearch search_by_law(const LawSetting& setting, const Fit& base) {
  LawSearch out;
  out.base = base;
  out.system = law_system(setting.plain, base, setting.contrasts);
  std::vector<const Candidate*> candidates;
  for (const auto& candidate : setting.plain.candidates()) candidates.push_back(candidate.get());
  collect_entries(setting, out, candidates);
  const OneLaw law(out.system);
  out.weighed = can_be_weighed(out.system) && law.sound();
  if (!out.weighed) return out;
  screen_by_law(setting, out, law);
  out.else_weight.assign(setting.contrasts.size(), -1e300);
  weigh_nothing(setting, out, base);
  if (out.accounts.empty() || out.accounts.front().log_weight < out.none.log_evidence + kFarBelow) return out;
  const std::vector<VectorXd> starts = {out.base.map.x.head(std::ssize(setting.plain.map().nuisances())), {}};
  std::set<int> done;
  for (int round = 0; round < kLeadingRounds; ++round) {  // a fit may bring other entries among the leading
    const std::vector<LawAccount*> these = leading_accounts(out, done);
    if (these.empty()) break;
    parallel_for_told(
        these.size(),
        [&](std::size_t i) {
          refine_by_law(setting, out, *these[i], starts);
          if (!these[i]->refined()) score_at_base(law, out, *these[i]);
        },
        [&](int fitted, int of) { setting.progress("causes fitted", fitted, of); });
    for (const LawAccount* account : these) done.insert(account->members.front());
    // What no fit and no scales can be found for is no account.
    std::erase_if(out.accounts, [&](const LawAccount& a) { return done.contains(a.members.front()) && !a.scored; });
    if (out.accounts.empty()) return out;
    sort_accounts(out.accounts);
  }
  settle_rivals(setting, out);
  std::vector<LawAccount> sets;
  add_sets(
      out, law,
      [&](LawAccount& account) {
        account.evidence.tau = start_of_set(out, account);
        score_at_base(law, out, account);  // the magnitudes that a fit starts at
        if (account.scored) refine_by_law(setting, out, account, starts);
      },
      setting.progress, sets);
  for (LawAccount& account : sets) out.accounts.push_back(std::move(account));
  sort_accounts(out.accounts);
  look_beside_leader(setting, out);
  settle_rivals(setting, out);
  // A better optimiser must not look like a cause either: nothing too is fitted from the leader's parameters.
  if (!out.accounts.empty() && out.accounts.front().refined())
    weigh_nothing(setting, out, setting.informed.fit(base.causes, parameters_of(setting, out.accounts.front())));
  return out;
}

}  // namespace twindeck::diagnosis
