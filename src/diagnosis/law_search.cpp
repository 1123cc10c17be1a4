#include "diagnosis/law_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "diagnosis/law_fits.hpp"
#include "diagnosis/law_openings.hpp"
#include "diagnosis/law_screen.hpp"
#include "diagnosis/law_sets.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kLeading = 6, kOfFewPlaces = 6;
constexpr double kNear = 12.0, kNearShare = 0.3;  // nats below the best, or part of its lead, that get a fit
constexpr double kFarBelow = -8.0;  // nats against "nothing"; below it no fit could reach a probability of five per cent

/// Start scales of a set: those of its best scored member, with a scale in each of its contrasts.
VectorXd start_of_set(const LawSearch& search, const LawAccount& set) {
  VectorXd out = search.none.tau;
  const auto is_member = [&](const LawAccount& account) {
    return account.members.size() == 1 && contains(set.members, account.members.front());
  };
  if (const auto best = std::ranges::find_if(search.accounts, is_member); best != search.accounts.end())
    out = best->evidence.tau;
  out.tail(out.size() - kFirstContrast) *= 0.0;
  for (const int m : set.members)
    for (const int contrast : search.entries[static_cast<std::size_t>(m)].contrasts) out[kFirstContrast + contrast] = kLeft;
  return out;
}

/// The entry of a search for the same candidate.
const LawEntry* known_entry(const LawSearch& search, const LawEntry& entry) {
  return &*std::ranges::find(search.entries, entry.candidate, &LawEntry::candidate);
}

/// Screens the entries of a search at the fit with the leader in the model. @return false if the rows cannot be weighed there
bool screen_beside(const LawSetting& setting, const LawAccount& leader, LawSearch& beside) {
  MatrixXd signatures = std::move(beside.system.signatures);
  beside.base = leader.with;
  beside.system = law_system(setting.plain, beside.base, setting.contrasts);
  beside.system.signatures = std::move(signatures);
  beside.accounts.clear();
  if (!can_be_weighed(beside.system)) return false;
  screen_by_law(setting, beside, OneLaw(beside.system));
  return beside.none.weight.size() > 0;
}

/// Sets of the leader with one further entry, for the most promising entries at the fit with the leader in the model. Entries
/// in `among` that promise nothing are removed, so that they are not tried in larger sets.
/// @param beside  receives the screen
std::vector<LawAccount> sets_beside(const LawSetting& setting, const LawSearch& search, const LawAccount& leader,
                                    std::vector<const LawEntry*>& among, LawSearch& beside) {
  beside.base = leader.with;
  collect_entries(setting, beside, each_of(among, &LawEntry::candidate));
  std::vector<LawAccount> out;
  for (LawEntry& entry : beside.entries) entry.log_prior = known_entry(search, entry)->log_prior;
  if (!screen_beside(setting, leader, beside)) return out;
  std::vector<const LawEntry*> leading;
  for (const LawAccount& found : beside.accounts) {
    const LawEntry* entry = known_entry(search, beside.entries[static_cast<std::size_t>(found.members.front())]);
    if (leading.size() < kMembersOfSets) leading.push_back(entry);
    if (out.size() == kTried || found.log_weight < beside.none.log_evidence + kFarBelow) continue;
    const auto position = static_cast<int>(entry - search.entries.data());
    const auto is_known = [&](int m) { return is_same_cause(search.entries[static_cast<std::size_t>(m)], *entry); };
    if (std::ranges::any_of(leader.members, is_known)) continue;
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

/// Adds an account; the better of two with the same members is kept.
void keep_better(LawSearch& search, LawAccount account) {
  const auto same = std::ranges::find_if(
      search.accounts, [&](const LawAccount& a) { return std::ranges::is_permutation(a.members, account.members); });
  if (same == search.accounts.end())
    search.accounts.push_back(std::move(account));
  else if (account.log_weight > same->log_weight)
    *same = std::move(account);
}

/// Fits sets from given parameters and adds them to the accounts.
void add_fitted_sets(const LawSetting& setting, LawSearch& search, std::vector<LawAccount> sets, const VectorXd& x) {
  parallel_for_told(
      sets.size(), [&](std::size_t i) { refine_by_law(setting, search, sets[i], {x}); },
      [&](int done, int of) { setting.progress("further causes fitted", done, of); });
  for (LawAccount& set : sets) keep_better(search, std::move(set));
  std::erase_if(search.accounts, [](const LawAccount& a) { return a.members.size() > 1 && !a.scored; });
  sort_accounts(search.accounts);
}

std::vector<const LawEntry*> all_entries(const LawSearch& search) {
  std::vector<const LawEntry*> out;
  for (const LawEntry& entry : search.entries) out.push_back(&entry);
  return out;
}

/// Looks for further causes with the leading account in the model. A large cause hides others at the base, because modes may be
/// open there. @return the screen of all entries beside the leading single cause
LawSearch look_beside_leader(const LawSetting& setting, LawSearch& search) {
  std::vector<const LawEntry*> among = all_entries(search);
  LawSearch screen;
  for (std::size_t size = 1; size < kMostInASet; ++size) {
    const auto best =
        std::ranges::find_if(search.accounts, [&](const LawAccount& a) { return a.members.size() == size && a.refined(); });
    if (best == search.accounts.end()) break;
    const LawAccount leader = *best;
    LawSearch here;
    add_fitted_sets(setting, search, sets_beside(setting, search, leader, among, here), parameters_of(setting, leader));
    if (size == 1) screen = std::move(here);
  }
  return screen;
}

/// Takes each member out of the leading set and looks for rivals with the others in the model. The others alone compete too,
/// because they may never have been fitted. The screen gives the changes of all entries beside the leading single cause. The
/// changes of the most promising entries are computed anew.
void exchange_members(const LawSetting& setting, LawSearch& search, LawSearch screen) {
  if (search.accounts.empty() || !search.accounts.front().refined()) return;
  const LawAccount leader = search.accounts.front();
  for (std::size_t c = 0; leader.members.size() > 1 && c < leader.members.size(); ++c) {
    LawAccount rest;
    rest.evidence.tau = leader.evidence.tau;
    for (std::size_t m = 0; m < leader.members.size(); ++m) {
      if (m == c) continue;
      rest.members.push_back(leader.members[m]);
      rest.causes.push_back(leader.causes[m]);
      rest.log_prior += search.entries[static_cast<std::size_t>(leader.members[m])].log_prior;
    }
    const VectorXd x = parameters_of(setting, leader);
    refine_by_law(setting, search, rest, {x});
    if (!rest.refined()) continue;
    keep_better(search, rest);
    if (!screen_beside(setting, rest, screen)) continue;
    std::vector<const LawEntry*> among;
    for (std::size_t i = 0; i < std::min(kMembersOfSets, screen.accounts.size()); ++i)
      among.push_back(known_entry(search, screen.entries[static_cast<std::size_t>(screen.accounts[i].members.front())]));
    LawSearch here;
    add_fitted_sets(setting, search, sets_beside(setting, search, rest, among, here), x);
  }
}

/// Names of the families that an entry belongs to: its hypothesis, and this at places whose stiffness has the same parameters.
std::vector<std::string> families_of(const Candidate& candidate) {
  std::vector<std::string> out = {candidate.hypothesis->id};
  if (candidate.places.size() != 1) return out;
  std::string parameters;
  for (const fe::ParameterFactor& factor : candidate.places.front()->stiffness_law.ratio.factors)
    parameters += fmt::format(" {}", factor.parameter);
  if (!parameters.empty()) out.push_back(out.front() + parameters);
  return out;
}

/// Accounts that get a fit: the best ones and the best one of each family.
std::vector<LawAccount*> leading_accounts(LawSearch& search, const std::set<int>& done) {
  const double best = search.accounts.front().log_weight, over = std::max(0.0, best - search.none.log_evidence);
  const double near = best - std::max(kNear, kNearShare * over);
  const auto candidate_of = [&](const LawAccount& account) {
    return search.entries[static_cast<std::size_t>(account.members.front())].candidate;
  };
  std::map<std::string, std::size_t> places;
  for (const LawAccount& account : search.accounts)
    if (candidate_of(account)->further_states.empty())
      for (const std::string& family : families_of(*candidate_of(account))) ++places[family];
  std::set<std::string> families, wholly;
  std::vector<LawAccount*> out;
  const std::string leading_place = candidate_of(search.accounts.front())->location;
  for (std::size_t i = 0; i < search.accounts.size(); ++i) {
    LawAccount& account = search.accounts[i];
    const Candidate& candidate = *candidate_of(account);
    const bool first_of_family = !families.contains(candidate.hypothesis->id);
    // A family with few locations is fitted at all of them. The base may have fitted a common parameter to one location, and
    // the screen would then favour the opposite change at the others.
    bool in_few_places = false;
    for (const std::string& family : families_of(candidate)) {
      if (families.insert(family).second && account.log_weight > search.none.log_evidence && places[family] <= kOfFewPlaces)
        wholly.insert(family);
      in_few_places = in_few_places || wholly.contains(family);
    }
    const bool near_best = (i < kLeading || first_of_family) && account.log_weight > near;
    // Another family at the leader's location is its nearest rival; it is always fitted, because trial magnitudes are coarse.
    const bool same_place = candidate.location == leading_place && leading_place.find(':') != std::string::npos;
    const bool worth = in_few_places || same_place || (near_best && out.size() < kMostLeading);
    if (worth && !done.contains(account.members.front())) out.push_back(&account);
  }
  return out;
}

}  // namespace

bool is_same_cause(const LawEntry& a, const LawEntry& b) {
  return a.candidate->hypothesis == b.candidate->hypothesis && a.candidate->location == b.candidate->location;
}

bool is_model_error(const LawSetting& setting, const LawEntry& entry) {
  const FeatureSet& features = setting.plain.map().features();
  return entry.contrast < 0 && !is_of_a_channel(*entry.candidate) && states_of(features).size() > 1 &&
         std::ranges::all_of(features.conditions,
                             [&](const Condition& condition) { return entry.candidate->acts_in(condition); });
}

const LawAccount& account_to_take(const std::vector<const LawAccount*>& possible) {
  const auto before = [](const LawAccount* a, const LawAccount* b) {
    return a->scored != b->scored ? a->scored : a->members.size() < b->members.size();
  };
  return **std::min_element(possible.begin(), possible.end(), before);
}

namespace {

/// "Nothing", or a change in one contrast, at a fit without catalogue causes.
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

/// Weighs "nothing", and "something else" in each contrast, in the same way as causes: from a fit without causes, with their
/// own open modes and scales. The better of two starts is kept.
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
  out.weighed = can_be_weighed(out.system);
  if (!out.weighed) return out;
  screen_by_law(setting, out, law);
  out.weighed = out.none.weight.size() > 0;
  if (!out.weighed) return out;
  out.else_weight.assign(setting.contrasts.size(), -1e300);
  weigh_nothing(setting, out, base);
  if (out.accounts.empty() || out.accounts.front().log_weight < out.none.log_evidence + kFarBelow) return out;
  const std::vector<VectorXd> starts = {out.base.map.x.head(std::ssize(setting.plain.map().nuisances())), {}};
  std::set<int> done;
  for (int round = 0; round < kLeadingRounds; ++round) {  // a fit may bring other entries among the leading ones
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
        score_at_base(law, out, account);  // start magnitudes of the fit
        if (account.scored) refine_by_law(setting, out, account, starts);
      },
      setting.progress, sets);
  for (LawAccount& account : sets) out.accounts.push_back(std::move(account));
  sort_accounts(out.accounts);
  LawSearch screen = look_beside_leader(setting, out);
  settle_rivals(setting, out);
  exchange_members(setting, out, std::move(screen));
  settle_rivals(setting, out);
  // "Nothing" is fitted from the leader's parameters too, because a better start must not look like a cause.
  if (!out.accounts.empty() && out.accounts.front().refined())
    weigh_nothing(setting, out, setting.informed.fit(base.causes, parameters_of(setting, out.accounts.front())));
  return out;
}

}  // namespace twindeck::diagnosis
