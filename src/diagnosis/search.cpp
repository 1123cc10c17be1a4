#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/parallel.hpp"
#include "diagnosis/inference.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Log odds above which a leading entry is worth a joint fit [nats].
constexpr double kLeastLeading = -2.0;

/// What a screen promises: half its likelihood ratio and the prior.
double promise_of(const Scored& scored) { return 0.5 * scored.screen + scored.candidate->log_prior; }

/// The entries that are fitted on the linearised base: the most promising, those near the best, and the best of each family
/// that screens well. What is tuned is probed instead. All others stand as not weighed.
std::vector<Scored*> short_list(std::vector<Scored>& found, const SearchOptions& options) {
  std::set<std::string> families;
  int fitted = 0;
  std::vector<Scored*> list;
  for (Scored& scored : found) {
    scored.log_odds = -kNotFitted;
    if (scored.candidate->tuned >= 0) continue;
    const bool new_family = !families.contains(scored.candidate->hypothesis->id);
    const bool near = promise_of(scored) > promise_of(found.front()) - std::max(12.0, 0.3 * promise_of(found.front()));
    if (fitted < options.short_list || (near && fitted < options.longest_list) ||
        (new_family && scored.screen > options.family_screen)) {
      list.push_back(&scored);
      ++fitted;
      families.insert(scored.candidate->hypothesis->id);
    }
  }
  return list;
}

/// A refitted entry stands above its neighbours that were weighed on the linearised base alone: the nearest of its family are
/// refitted too, so that the place is chosen among equals. So is all that a damper which leads can have wrong, which shows
/// alike.
std::vector<Scored*> siblings_of_leader(std::vector<Scored>& found, const SearchOptions& options) {
  const Scored& first = found.front();
  const double near = first.log_odds - std::max(options.refine_within, 0.3 * first.log_odds);
  const auto lead = std::find_if(found.begin(), found.end(), [&](const Scored& s) {
    const Hypothesis& h = *s.candidate->hypothesis;
    return s.stage == 3 && h.set.starts_with("damper") && (&s == &first || h.prior_weight > 1.0);
  });
  int deepened = 0;
  std::vector<Scored*> siblings;
  for (Scored& scored : found) {
    if (lead != found.end() && scored.stage < 3 && scored.candidate->location == lead->candidate->location) {
      siblings.push_back(&scored);
    } else if (deepened < options.deepened && scored.stage == 2 && scored.log_odds > near &&
               scored.candidate->hypothesis == first.candidate->hypothesis) {
      siblings.push_back(&scored);
      ++deepened;
    }
  }
  return siblings;
}

}  // namespace

void sort_by_odds(std::vector<Scored>& found) {
  std::stable_sort(found.begin(), found.end(), [](const Scored& a, const Scored& b) { return a.log_odds > b.log_odds; });
}

std::vector<VectorXd> Inference::starts_at(const Fit& base, const Candidate& candidate) const {
  std::vector<VectorXd> starts = candidate.starts;
  if (candidate.tuned < 0 || !base.all.valid) return starts;
  const auto u = static_cast<Index>(candidate.tuned);
  const auto& modes = map_.measured_modes();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Tuning& tuning = candidate.tuning[i];
    for (std::size_t m = 0; m < modes.size(); ++m) {
      if (tuning.mode.empty() || modes[m].condition != tuning.condition || modes[m].label != tuning.mode) continue;
      const double f = tuning.factor * base.all.frequency_Hz[m];
      starts[i][u] =
          std::clamp(candidate.log[static_cast<std::size_t>(u)] ? std::log(f) : f, candidate.low[u], candidate.high[u]);
    }
  }
  return starts;
}

std::vector<Inference::Tried> Inference::tried(const Fit& base, const Candidate& candidate) const {
  std::vector<Tried> out;
  for (const VectorXd& a : starts_at(base, candidate))
    if (VectorXd of_start = change(base, candidate, a); of_start.size() > 0) out.push_back({a, std::move(of_start)});
  return out;
}

ScreenTable Inference::screen_table(const Fit& base) const {
  std::vector<std::vector<VectorXd>> changes(candidates_.size());
  parallel_for(candidates_.size(), [&](std::size_t i) {
    const Candidate& candidate = *candidates_[i];
    // Where a stay's own frequency was measured, its starts are those of one data set: they are always computed anew.
    if (candidate.tuned >= 0 && (candidate.high - candidate.low)[candidate.tuned] < 0.25) return;
    for (const VectorXd& a : starts_at(base, candidate)) changes[i].push_back(change(base, candidate, a));
  });
  ScreenTable table;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (!changes[i].empty()) table.change[candidates_[i]->id()] = std::move(changes[i]);
  return table;
}

Scored Inference::screen(const Fit& base, const Promise& promise, const std::vector<VectorXd>* from_table,
                         std::vector<std::pair<double, std::size_t>>* by_start, std::vector<VectorXd>* record) const {
  const Candidate& candidate = *promise.candidate;
  const std::vector<VectorXd> starts = starts_at(base, candidate);
  Scored best;
  best.candidate = &candidate;
  best.screen = -1e300;
  std::vector<std::pair<double, std::size_t>> all;
  if (record != nullptr) record->resize(starts.size());
  std::vector<std::size_t> used;
  MatrixXd signatures(static_cast<Index>(training_.size()), std::ssize(starts));
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!promise.starts.empty() && std::find(promise.starts.begin(), promise.starts.end(), i) == promise.starts.end()) continue;
    VectorXd of_start;
    if (from_table == nullptr)
      of_start = change(base, candidate, starts[i]);
    else if (i < from_table->size())
      of_start = (*from_table)[i];
    if (of_start.size() > 0) {
      signatures.col(std::ssize(used)) = of_start(training_);
      used.push_back(i);
    }
    if (record != nullptr) (*record)[i] = std::move(of_start);
  }
  // All at once: a solve takes its time to read the factor.
  signatures = linalg::lower_solve(base.total_factor, signatures.leftCols(std::ssize(used)));
  for (std::size_t k = 0; k < used.size(); ++k) {
    const std::size_t i = used[k];
    const auto s = signatures.col(static_cast<Index>(k));
    const double along = s.dot(base.whitened), norm = s.squaredNorm();
    if (!(norm > 1e-12)) continue;
    const double scale = along / norm;
    const double t = !candidate.low.size() || scale <= 0.0 || scale > 3.0 ? 2.0 * along - norm : along * along / norm;
    all.emplace_back(t, i);
    if (t > best.screen) {
      best.screen = t;
      best.a = starts[i];
      best.signature = s;
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  // Of what is tuned there are many, each near a mode of its own.
  for (std::size_t k = 1; k < all.size() && (k < 2 || candidate.tuned < 0); ++k)
    best.other_starts.push_back(starts[all[k].second]);
  if (by_start != nullptr) *by_start = std::move(all);
  return best;
}

/// Candidates that are worth a new signature: those that the table shows best, and the best few of every family.
std::vector<Inference::Promise> Inference::promising(const Fit& base, const SearchOptions& options,
                                                     const ScreenTable* known_changes) const {
  std::vector<const Candidate*> all;
  for (const auto& candidate : candidates_)
    if (std::none_of(base.causes.begin(), base.causes.end(),
                     [&](const Cause& cause) { return cause.candidate->key() == candidate->key(); }))
      all.push_back(candidate.get());
  if (known_changes == nullptr) {
    std::vector<Promise> everything;
    for (const Candidate* candidate : all) everything.push_back({candidate, {}});
    return everything;
  }
  std::vector<std::pair<double, Promise>> ranked(all.size());
  parallel_for(all.size(), [&](std::size_t i) {
    const Candidate* candidate = all[i];
    Promise promise{candidate, {}};
    const auto known = known_changes->change.find(candidate->key());
    double t = 1e300;
    if (known != known_changes->change.end()) {
      std::vector<std::pair<double, std::size_t>> by_start;
      t = screen(base, promise, &known->second, &by_start, nullptr).screen;
      if (candidate->tuned >= 0)
        for (std::size_t k = 0; k < std::min<std::size_t>(2, by_start.size()); ++k)
          promise.starts.push_back(by_start[k].second);
    }
    ranked[i] = {0.5 * t + candidate->log_prior, std::move(promise)};
  });
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::map<std::string, int> of_family, starts;
  for (const Candidate* candidate : all) starts[candidate->hypothesis->id] += static_cast<int>(candidate->starts.size());
  std::vector<Promise> chosen;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const Candidate& candidate = *ranked[i].second.candidate;
    const Hypothesis& family = *candidate.hypothesis;
    // Families of few magnitudes, and those that leave the structure alone, cost little to compute anew.
    const bool cheap = family.measurement || starts[family.id] <= 32;
    const int least = candidate.tuned >= 0 ? options.tabled_tuned : 2;
    if (of_family[family.id]++ < least || static_cast<int>(i) < options.tabled || cheap)
      chosen.push_back(std::move(ranked[i].second));
  }
  return chosen;
}

/// What is tuned to a mode splits it, and what it does turns with the last per cent of the ratio; a mass or a joint turns close
/// modes into each other. There, signatures at the base tell where to look, not how much there is. So a few steps of the joint
/// fit are made from the best starts of all such entries.
void Inference::probe(const Fit& base, std::vector<Scored>& found, const SearchOptions& options) const {
  struct Probe {
    std::size_t at;
    VectorXd a;
    double promise;
  };
  std::vector<Probe> probes;
  double best = 0.0;
  for (const Scored& scored : found) best = std::max(best, scored.log_odds);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Scored& scored = found[i];
    if (scored.screen < options.family_screen) continue;
    const double promise = 0.5 * scored.screen + scored.candidate->log_prior;
    // Others only where the full effect at the base is far from what its direction promised, or was not looked at.
    if (scored.candidate->tuned < 0 && (scored.candidate->low.size() == 0 || scored.log_odds > promise - 5.0)) continue;
    if (promise < std::max(0.5 * best - 3.0, options.least_promise)) continue;
    probes.push_back({i, scored.a, promise});
    if (scored.candidate->tuned >= 0)
      for (const VectorXd& a : scored.other_starts) probes.push_back({i, a, promise - 1.0});
  }
  std::stable_sort(probes.begin(), probes.end(), [](const Probe& a, const Probe& b) { return a.promise > b.promise; });
  if (static_cast<int>(probes.size()) > options.probes) probes.resize(static_cast<std::size_t>(options.probes));
  std::vector<Scored> looked(probes.size());
  parallel_for(probes.size(), [&](std::size_t k) {
    looked[k] = found[probes[k].at];
    looked[k].a = probes[k].a;
    looked[k].log_odds = -1e300;
    // From the prior's mean: the base's x has taken up what the cause should, and may have paired modes by it.
    refine(base, looked[k], {}, options.probe_iterations);
  });
  for (std::size_t k = 0; k < probes.size(); ++k) {
    if (looked[k].log_odds > found[probes[k].at].log_odds) found[probes[k].at] = looked[k];
    best = std::max(best, found[probes[k].at].log_odds);
  }
  // What promised more than was found, and was not on its way to it, goes on from the base's x; and what was tried at one
  // magnitude alone, afresh from the next: on the way from too much to the right one, modes may change partners.
  struct Again {
    std::size_t at;
    Scored scored;
    VectorXd x;
  };
  std::vector<Again> again;
  int broken = 0;
  for (std::size_t k = 0; k < probes.size() && broken < options.probes_again; ++k) {
    if (looked[k].stage >= 3 || probes[k].promise <= best + options.broken_promise) continue;
    ++broken;
    again.push_back({probes[k].at, looked[k], base.map.x});
    if (looked[k].candidate->tuned >= 0 || looked[k].other_starts.empty()) continue;
    again.push_back({probes[k].at, looked[k], {}});
    again.back().scored.a = looked[k].other_starts.front();
  }
  parallel_for(again.size(), [&](std::size_t i) { refine(base, again[i].scored, again[i].x, 3 * options.probe_iterations); });
  for (const Again& a : again)
    if (a.scored.log_odds > found[a.at].log_odds) found[a.at] = a.scored;
}

std::vector<Scored> Inference::screened(const Fit& base, const SearchOptions& options, const ScreenTable* known,
                                        ScreenTable* record) const {
  // Candidates are held against the base one by one: the number of threads changes nothing.
  const ScreenTable* table = known != nullptr ? known : table_;
  const std::vector<Promise> chosen = promising(base, options, table);
  std::vector<Scored> all(chosen.size());
  std::vector<std::vector<VectorXd>> changes(chosen.size());
  const bool records = record != nullptr && table == nullptr;
  parallel_for(chosen.size(),
               [&](std::size_t i) { all[i] = screen(base, chosen[i], nullptr, nullptr, records ? &changes[i] : nullptr); });
  if (records)
    for (std::size_t i = 0; i < chosen.size(); ++i) record->change[chosen[i].candidate->key()] = std::move(changes[i]);
  std::vector<Scored> found;
  for (Scored& scored : all)
    if (scored.signature.size() > 0) found.push_back(std::move(scored));
  std::stable_sort(found.begin(), found.end(), [&](const Scored& a, const Scored& b) { return promise_of(a) > promise_of(b); });
  return found;
}

void Inference::refine_all(const Fit& base, const std::vector<Scored*>& these) const {
  parallel_for(these.size(), [&](std::size_t i) {
    if (these[i]->stage == 1) fit_linearised(base, *these[i]);
    refine(base, *these[i], these[i]->x.size() > 0 ? Eigen::VectorXd(these[i]->x) : base.map.x);
  });
}

void Inference::refine_leading(const Fit& base, std::vector<Scored>& found, const SearchOptions& options) const {
  for (int round = 0; round < options.most_rounds && (round == 0 || found.front().stage == 2); ++round) {
    const double best = found.front().log_odds;
    std::vector<Scored*> leading;
    for (int i = 0; i < options.most_refined && i < static_cast<int>(found.size()); ++i) {
      Scored& scored = found[static_cast<std::size_t>(i)];
      if (scored.stage == 2 && scored.log_odds > best - std::max(options.refine_within, 0.1 * best)) leading.push_back(&scored);
    }
    refine_all(base, leading);
    sort_by_odds(found);
    if (round == 0 && found.front().log_odds < best - options.refine_within) {  // others had looked not worth a probe beside it
      probe(base, found, options);
      sort_by_odds(found);
    }
  }
}

void Inference::refine_other_starts(const Fit& base, Scored& leading) const {
  std::vector<Scored> otherwise(leading.other_starts.size(), leading);
  std::vector<Scored*> these;
  for (std::size_t i = 0; i < otherwise.size(); ++i) {
    otherwise[i].a = leading.other_starts[i];
    these.push_back(&otherwise[i]);
  }
  refine_all(base, these);
  for (const Scored& other : otherwise)
    if (other.log_odds > leading.log_odds) leading = other;
}

std::vector<Scored> Inference::search(const Fit& base, const SearchOptions& options, const ScreenTable* known,
                                      ScreenTable* record) const {
  std::vector<Scored> found = screened(base, options, known, record);
  const std::vector<Scored*> list = short_list(found, options);
  parallel_for(list.size(), [&](std::size_t i) { fit_linearised(base, *list[i]); });
  probe(base, found, options);
  sort_by_odds(found);
  if (found.empty() || !(found.front().log_odds > kLeastLeading)) return found;
  // Odds on the linearised base are a promise: who leads must have been refitted, or the next one does.
  refine_leading(base, found, options);
  refine_all(base, siblings_of_leader(found, options));
  sort_by_odds(found);
  // Who leads is fitted from its other magnitudes too: a damper that friction holds in one fit may slide in a better one.
  Scored& leading = found.front();
  if (leading.stage == 3 && leading.candidate->tuned < 0) refine_other_starts(base, leading);
  return found;
}

}  // namespace twindeck::diagnosis
