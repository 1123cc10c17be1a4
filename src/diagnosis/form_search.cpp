#include "diagnosis/form_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "diagnosis/form_magnitudes.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNone = 0.5, kSomethingElse = 0.05, kCatalogue = 0.4;  // prior probabilities
constexpr double kElseScale = 0.03;                                     // of kappa where something else changed
constexpr double kLeftoverPart = 0.1;                                   // of a cause's effect: scale of what it leaves over
constexpr double kLeastEffect = 0.001;                                  // of a cause on frequencies, ln
constexpr int kRefined = 6, kMostRefined = 10, kRounds = 4;
constexpr int kFewPlaces = 6;                                // of a family: all of them are refined
constexpr double kRefineWithin = 8.0, kFamilyWithin = 12.0;  // nats of the best …
constexpr double kRefineShare = 0.1,
                 kFamilyShare = 0.3;  // … or this much of what it has over none, whatever is more: screens are coarse
constexpr double kLeastScale = 0.02, kMostScale = 3.0;  // of a signature, as far as its direction holds
constexpr double kSeen = 1e-3;                          // deviations: below, these rows show nothing of an entry
constexpr double kSameFit = 0.01;                       // prior deviations: nearer fits are one
constexpr double kWorthRefining = -4.0;                 // nats against none: below, the best entry is far from any threshold

/// RMS change of the frequencies in the conditions where a cause acts: those of its states, or those that its contrast weighs.
double effect_of(const Inference& inference, const VectorXd& change, const Candidate& candidate, const Contrast* contrast) {
  const FeatureSet& features = inference.map().features();
  const auto acts_in = [&](int condition) {
    if (!candidate.state.empty()) return candidate.acts_in(features.conditions[static_cast<std::size_t>(condition)]);
    return contrast == nullptr || contrast->weight[condition] != 0.0;
  };
  double sum = 0.0;
  int rows = 0;
  for (const int r : inference.training()) {
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    if (row.type != RowType::frequency || !acts_in(row.condition)) continue;
    sum += change[r] * change[r];
    ++rows;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0.0;
}

/// ln prior of kappa's leftover points beside an effect.
VectorXd leftover_weights(const ScaleGrid& grid, double effect) {
  const Part part = leftover_part();
  return half_t_weights(grid.change.segment(part.first, part.count), kLeftoverPart * std::max(effect, kLeastEffect))
      .array()
      .log();
}

/// Terms of one hypothesis at one point, over kappa where something is left over.
/// @param density  ln density and chi² for a Quadratic
template <typename Density>
void add_terms(std::vector<EvidenceTerm>& terms, const ScaleGrid& grid, int point, const AtScales& at, int contrast,
               double effect, Density density) {
  const double prior = grid.points[static_cast<std::size_t>(point)].log_prior;
  if (contrast < 0) {
    const auto [log_density, chi_squared] = density(at.without);
    terms.push_back({prior + log_density, point, -1, chi_squared});
    return;
  }
  const VectorXd weight = leftover_weights(grid, effect);
  const Part part = leftover_part();
  for (Index k = 0; k < part.count; ++k) {
    const auto kappa = static_cast<std::size_t>(part.first + k);
    const auto [log_density, chi_squared] = density(at.change[static_cast<std::size_t>(contrast)][kappa]);
    terms.push_back({prior + weight[k] + log_density, point, static_cast<int>(kappa), chi_squared});
  }
}

/// The contrast in which something is left over under an entry.
int leftover_contrast(const FormEntry& entry, const Leftover& leftover) {
  return entry.contrast >= 0 ? entry.contrast : leftover.contrast;
}

double leftover_effect(const FormEntry& entry, double own, const Leftover& leftover) {
  if (entry.contrast < 0) return leftover.effect;
  return entry.contrast == leftover.contrast ? std::max(own, leftover.effect) : own;
}

/// Screen of every entry, none and something else at the base.
class Screen {
 public:
  Screen(const FormSetting& setting, FormSearch& search, const Leftover& leftover)
      : setting_(setting), search_(search), leftover_(leftover) {
    place_signatures();
    const FormEvidence evidence(search.system, setting.grid);
    const std::size_t points = setting.grid.points.size();
    std::vector<std::vector<std::vector<EvidenceTerm>>> of_point(points);
    parallel_for(points,
                 [&](std::size_t p) { of_point[p] = terms_at(evidence.at(setting.grid.points[p]), static_cast<int>(p)); });
    const std::size_t hypotheses = 1 + setting.contrasts.size() + search.entries.size();
    std::vector<HypothesisEvidence> found(hypotheses);
    for (std::size_t h = 0; h < hypotheses; ++h) {
      std::vector<EvidenceTerm> terms;
      for (const auto& of : of_point) terms.insert(terms.end(), of[h].begin(), of[h].end());
      found[h] = summed(terms, setting.grid);
    }
    search.none = found[0];
    search.none_weight = found[0].log_evidence + log_prior_of_none();
    search.something_else.assign(found.begin() + 1, found.begin() + 1 + std::ssize(setting.contrasts));
    for (const HypothesisEvidence& e : search.something_else)
      search.else_weight.push_back(e.log_evidence + log_prior_of_something_else());
    for (std::size_t i = 0; i < search.entries.size(); ++i) {
      FormEntry& entry = search.entries[i];
      entry.evidence = found[1 + setting.contrasts.size() + i];
      entry.log_weight = entry.evidence.log_evidence + log_prior_of(*entry.candidate);
    }
    choose_magnitudes(evidence);
  }

 private:
  /// The signatures of all entries side by side, and which of them are asked with which contrast.
  void place_signatures() {
    std::vector<VectorXd> columns;
    const std::vector<int>& rows = setting_.plain.training();
    for (FormEntry& entry : search_.entries) {
      entry.first_signature = static_cast<int>(columns.size());
      const int contrast = leftover_contrast(entry, leftover_);
      for (const Inference::Tried& tried : entry.tried) {
        if (contrast >= 0) {
          auto& asked = search_.system.change[static_cast<std::size_t>(contrast)].signatures;
          position_.push_back(static_cast<int>(asked.size()));
          asked.push_back(static_cast<int>(columns.size()));
        } else {
          position_.push_back(static_cast<int>(columns.size()));
        }
        columns.emplace_back(tried.change(rows));
      }
    }
    search_.system.signatures.resize(std::ssize(rows), std::ssize(columns));
    for (std::size_t k = 0; k < columns.size(); ++k) search_.system.signatures.col(static_cast<Index>(k)) = columns[k];
  }

  [[nodiscard]] const Contrast* contrast_of_entry(const FormEntry& entry) const {
    return entry.contrast < 0 ? nullptr : &setting_.contrasts[static_cast<std::size_t>(entry.contrast)];
  }

  std::vector<std::vector<EvidenceTerm>> terms_at(const AtScales& at, int point) const {
    std::vector<std::vector<EvidenceTerm>> out(1);
    const ScaleGrid& grid = setting_.grid;
    add_terms(out[0], grid, point, at, leftover_.contrast, leftover_.effect,
              [](const Quadratic& q) { return std::pair(q.log_density(), q.chi_squared); });
    const Part part = something_else_part();
    const VectorXd weight = half_t_weights(grid.change.segment(part.first, part.count), kElseScale).array().log();
    for (std::size_t c = 0; c < setting_.contrasts.size(); ++c) {
      out.emplace_back();
      for (Index k = 0; k < part.count; ++k) {
        const auto kappa = static_cast<std::size_t>(part.first + k);
        const Quadratic& q = at.change[c][kappa];
        out.back().push_back({grid.points[static_cast<std::size_t>(point)].log_prior + weight[k] + q.log_density(), point,
                              static_cast<int>(kappa), q.chi_squared});
      }
    }
    for (const FormEntry& entry : search_.entries) out.push_back(entry_terms(entry, at, point));
    return out;
  }

  std::vector<EvidenceTerm> entry_terms(const FormEntry& entry, const AtScales& at, int point) const {
    const std::vector<double> factors = magnitude_factors(*entry.candidate);
    std::vector<EvidenceTerm> out;
    const double share = -std::log(static_cast<double>(entry.tried.size() * factors.size()));
    for (std::size_t i = 0; i < entry.tried.size(); ++i) {
      const double own = effect_of(setting_.plain, entry.tried[i].change, *entry.candidate, contrast_of_entry(entry));
      const Index s = position_[static_cast<std::size_t>(entry.first_signature) + i];
      for (const double t : factors)
        add_terms(out, setting_.grid, point, at, leftover_contrast(entry, leftover_),
                  leftover_effect(entry, t * own, leftover_),
                  [&](const Quadratic& q) { return std::pair(share + q.log_density(s, t), q.remaining(s, t)); });
    }
    // Magnitudes are summed over here: they need not be kept for every point.
    std::vector<EvidenceTerm> by_kappa;
    for (const EvidenceTerm& term : out) {
      const auto same =
          std::find_if(by_kappa.begin(), by_kappa.end(), [&](const EvidenceTerm& b) { return b.kappa == term.kappa; });
      if (same == by_kappa.end()) {
        by_kappa.push_back(term);
        continue;
      }
      if (term.log_weight > same->log_weight) same->chi_squared = term.chi_squared;
      same->log_weight = log_sum({same->log_weight, term.log_weight});
    }
    return by_kappa;
  }

  /// Where fits start. Many entries have their best point in common: each point is computed once.
  void choose_magnitudes(const FormEvidence& evidence) const {
    std::map<int, std::vector<FormEntry*>> by_point;
    for (FormEntry& entry : search_.entries) by_point[entry.evidence.best.point].push_back(&entry);
    const std::vector<std::pair<int, std::vector<FormEntry*>>> points(by_point.begin(), by_point.end());
    parallel_for(points.size(), [&](std::size_t p) {
      const AtScales at = evidence.at(setting_.grid.points[static_cast<std::size_t>(points[p].first)]);
      for (FormEntry* entry : points[p].second) choose_magnitude(*entry, at);
    });
  }

  /// The best scale of any of the screen's magnitudes at the best point.
  void choose_magnitude(FormEntry& entry, const AtScales& at) const {
    const int contrast = leftover_contrast(entry, leftover_);
    const Quadratic& q =
        contrast < 0 ? at.without
                     : at.change[static_cast<std::size_t>(contrast)][static_cast<std::size_t>(entry.evidence.best.kappa)];
    const bool scales = is_a_size(*entry.candidate);
    double best = -1e300;
    for (std::size_t i = 0; i < entry.tried.size(); ++i) {
      const Index s = position_[static_cast<std::size_t>(entry.first_signature) + i];
      const double t = scales && q.square[s] > 0.0 ? std::clamp(q.along[s] / q.square[s], kLeastScale, kMostScale) : 1.0;
      if (q.log_density(s, t) <= best) continue;
      best = q.log_density(s, t);
      entry.a = entry.tried[i].a;
      if (scales) entry.a[0] = scaled_magnitude(*entry.candidate, entry.a[0], t);
      entry.effect = t * effect_of(setting_.plain, entry.tried[i].change, *entry.candidate, contrast_of_entry(entry));
    }
  }

  const FormSetting& setting_;
  FormSearch& search_;
  const Leftover& leftover_;
  std::vector<int> position_;  // of each signature in the Quadratics that its entry is weighed with
};

/// Evidence with the entry in the model: its magnitudes are Gaussian about the fit, inside their bounds.
struct Linearised {
  HypothesisEvidence evidence;
  VectorXd a;
};

Linearised linearised(const FormSetting& setting, const FormEntry& entry, const FormSystem& system, const VectorXd& fitted,
                      double effect, const Leftover& leftover) {
  const Candidate& candidate = *entry.candidate;
  const FormEvidence evidence(system, setting.grid);
  const auto shift_of = [&](const Quadratic& q) -> VectorXd {
    if (fitted.size() == 0) return {};
    MatrixXd h = q.products;
    h.diagonal().array() += 1e-12 * (1.0 + h.diagonal().array().abs());
    const VectorXd moved = fitted + VectorXd(h.ldlt().solve(q.along));
    return moved.cwiseMax(candidate.low).cwiseMin(candidate.high) - fitted;
  };
  const auto density = [&](const Quadratic& q) {
    if (fitted.size() == 0) return std::pair(q.log_density(), q.chi_squared);
    const VectorXd shift = shift_of(q);
    const double chi_squared = q.chi_squared - 2.0 * shift.dot(q.along) + shift.dot(q.products * shift);
    return std::pair(-0.5 * (chi_squared + q.log_determinant) + ockham(q.products, candidate), chi_squared);
  };
  std::vector<std::vector<EvidenceTerm>> of_point(setting.grid.points.size());
  const int contrast = leftover_contrast(entry, leftover);
  parallel_for(of_point.size(), [&](std::size_t p) {
    add_terms(of_point[p], setting.grid, static_cast<int>(p), evidence.at(setting.grid.points[p], contrast), contrast,
              leftover_effect(entry, effect, leftover), density);
  });
  std::vector<EvidenceTerm> terms;
  for (const auto& of : of_point) terms.insert(terms.end(), of.begin(), of.end());
  Linearised out{summed(terms, setting.grid), fitted};
  if (fitted.size() > 0) {
    const AtScales at = evidence.at(setting.grid.points[static_cast<std::size_t>(out.evidence.best.point)], contrast);
    out.a += shift_of(contrast < 0
                          ? at.without
                          : at.change[static_cast<std::size_t>(contrast)][static_cast<std::size_t>(out.evidence.best.kappa)]);
  }
  return out;
}

void refine_with_form(const FormSetting& setting, const Fit& base, const Leftover& leftover, FormEntry& entry) {
  const auto n = static_cast<Index>(setting.plain.map().nuisances().size());
  std::vector<Cause> causes = base.causes;
  causes.push_back({entry.candidate, entry.a});
  VectorXd refined_a, found_before;
  for (const VectorXd& start : {VectorXd(base.map.x.head(n)), VectorXd()}) {
    Fit with = setting.informed.fit(causes, start);
    if (!with.made()) continue;
    if (found_before.size() > 0 && (with.map.x - found_before).norm() < kSameFit) continue;
    found_before = with.map.x;
    const Prediction without = setting.plain.map().predict(with.base, base.causes, false);
    const Contrast* contrast = entry.contrast < 0 ? nullptr : &setting.contrasts[static_cast<std::size_t>(entry.contrast)];
    const double effect =
        without.valid ? effect_of(setting.plain, with.all.g - without.g, *entry.candidate, contrast) : entry.effect;
    FormSystem system = form_system(setting.plain, with, setting.contrasts, entry.a.size());
    if (!can_be_weighed(system)) continue;  // costs the entry, not the results
    const Linearised found = linearised(setting, entry, system, with.causes.back().a, effect, leftover);
    const double log_weight = found.evidence.log_evidence + log_prior_of(*entry.candidate);
    if (!(log_weight > entry.log_weight)) continue;
    entry.evidence = found.evidence;
    entry.log_weight = log_weight;
    entry.effect = effect;
    entry.fitted = with.causes.back().a;
    entry.with = std::move(with);
    refined_a = found.a;
    entry.system = std::move(system);
    entry.refined = true;
  }
  if (entry.refined) entry.a = refined_a;
}

/// Entries that are worth a fit of their own: the best and the best of each family.
std::vector<FormEntry*> worth_refining(FormSearch& search, const std::set<const Candidate*>& done) {
  const double best = search.entries.front().log_weight, over_none = std::max(0.0, best - search.none_weight);
  const double near = best - std::max(kRefineWithin, kRefineShare * over_none);
  const double near_family = best - std::max(kFamilyWithin, kFamilyShare * over_none);
  std::map<std::string, int> places;
  for (const FormEntry& entry : search.entries)
    if (entry.candidate->further_states.empty()) ++places[entry.candidate->hypothesis->id];
  std::set<std::string> families, wholly;
  std::vector<FormEntry*> out;
  for (std::size_t i = 0; i < search.entries.size(); ++i) {
    FormEntry& entry = search.entries[i];
    if (entry.a.size() != entry.candidate->low.size()) continue;
    const std::string& family = entry.candidate->hypothesis->id;
    const bool first_of_family = families.insert(family).second;
    // The base has taken a cause at one of few places up into a parameter of them all, so that the screen sees its reverse at
    // the others.
    if (first_of_family && entry.log_weight > search.none_weight && places[family] <= kFewPlaces) wholly.insert(family);
    const bool near_best = (i < kRefined && entry.log_weight > near) || (first_of_family && entry.log_weight > near_family);
    // Another family at the leader's own place is its nearest rival, however coarse the screen's magnitudes are.
    const bool same_place = entry.candidate->location == search.entries.front().candidate->location &&
                            entry.candidate->location.find(':') != std::string::npos;
    const bool worth = wholly.contains(family) || same_place || (near_best && out.size() < kMostRefined);
    if (worth && !done.contains(entry.candidate)) out.push_back(&entry);
  }
  return out;
}

}  // namespace

double log_prior_of_none() { return std::log(kNone); }
double log_prior_of_something_else() { return std::log(kSomethingElse); }
double log_prior_of(const Candidate& candidate) { return std::log(kCatalogue) + candidate.log_prior; }

FormSearch search_with_form(const FormSetting& setting, const Fit& base, const Leftover& leftover) {
  FormSearch out;
  out.base = base;
  out.system = form_system(setting.plain, base, setting.contrasts);
  out.weighed = can_be_weighed(out.system);
  if (!out.weighed) return out;
  const auto& candidates = setting.plain.candidates();
  std::vector<FormEntry> entries(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    entries[i].candidate = candidates[i].get();
    entries[i].contrast = contrast_of(*candidates[i], setting.contrasts);
    entries[i].tried = setting.informed.tried(base, *candidates[i]);
  });
  for (FormEntry& entry : entries) {
    const bool in_model = std::any_of(base.causes.begin(), base.causes.end(),
                                      [&](const Cause& cause) { return cause.candidate == entry.candidate; });
    const auto seen = [&](const Inference::Tried& t) { return setting.informed.whitened(base, t.change).norm() > kSeen; };
    if (!in_model && std::any_of(entry.tried.begin(), entry.tried.end(), seen)) out.entries.push_back(std::move(entry));
  }
  Screen(setting, out, leftover);
  const auto sort = [&] {
    std::stable_sort(out.entries.begin(), out.entries.end(),
                     [](const FormEntry& a, const FormEntry& b) { return a.log_weight > b.log_weight; });
  };
  sort();
  if (out.entries.empty() || out.entries.front().log_weight < out.none_weight + kWorthRefining) return out;
  std::set<const Candidate*> done;
  for (int round = 0; round < kRounds && !done.contains(out.entries.front().candidate); ++round) {
    const std::vector<FormEntry*> these = worth_refining(out, done);
    if (these.empty()) break;
    parallel_for(these.size(), [&](std::size_t i) { refine_with_form(setting, base, leftover, *these[i]); });
    for (const FormEntry* entry : these) done.insert(entry->candidate);
    sort();
  }
  return out;
}

}  // namespace twindeck::diagnosis
