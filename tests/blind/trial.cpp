#include "blind/trial.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <tuple>

#include "blind/explain.hpp"
#include "core/parallel.hpp"
#include "diagnosis/law_diagnosis.hpp"

namespace twindeck::blind {

namespace {

using diagnosis::Candidate;
using diagnosis::Cause;
using Eigen::Index;
using Eigen::VectorXd;

class Stream {
 public:
  explicit Stream(std::uint64_t seed) : random_(seed * 7919 + 104729) { random_.discard(20); }
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1.0p-53; }
  double normal() { return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform()); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)) % n; }

 private:
  std::mt19937_64 random_;
};

/// What a magnitude of nothing is, in coordinates of the first unknown; NaN where there is none.
double neutral(const Candidate& c) {
  if (c.low.size() == 0) return std::nan("");
  if (c.low[0] < 0.0 && c.high[0] > 0.0) return 0.0;  // a rate, an angle, ln of a factor
  const std::string& name = c.hypothesis->unknowns[0].name;
  if (c.hypothesis->id == "dampk") return c.high[0] + 2.0;  // a stiff mount is none
  if (name == "factor") return 0.0;
  return name == "mass_kg" || name == "ratio" || name == "stiffness_N_m" || name == "exponent" ? c.low[0] - 2.0 : std::nan("");
}

std::string family_of(const std::string& id) { return id.substr(0, id.find('@')); }

/// The truth's entry and the diagnosing one for the same place: the sets are laid down in one order on both meshes.
struct Twin {
  const Candidate* truth;
  const Candidate* diagnosing;
};

/// Everything about a bench that all cases share.
struct Shared {
  diagnosis::Instantiated truth, diagnosing;
  std::unique_ptr<diagnosis::FeatureMap> nominal;
  std::unique_ptr<diagnosis::Inference> inference;
  diagnosis::Fit base;
  std::map<std::string, std::vector<VectorXd>> changes;  ///< by key of an entry: of all rows, at the magnitudes of its starts
  std::map<std::string, std::vector<Twin>> families;
  Eigen::MatrixXd noise_factor;
};

const Shared& shared_of(const Bench& bench) {
  static const Bench* last = nullptr;
  static std::unique_ptr<Shared> shared;
  if (last == &bench) return *shared;
  shared = std::make_unique<Shared>();
  last = &bench;
  // What is hidden ranges wider than what one campaign leaves open: a stay's frequency by 10 % about the nominal one.
  diagnosis::FeatureSet wide = bench.rows;
  for (diagnosis::Row& row : wide.rows)
    if (row.type == diagnosis::RowType::stay_frequency) row.std = 0.033 * row.value;
  shared->truth = diagnosis::instantiate(bench.catalogue, *bench.truth.reduced, wide);
  shared->diagnosing = diagnosis::instantiate(bench.catalogue, *bench.diagnosing.reduced, wide);
  shared->nominal = std::make_unique<diagnosis::FeatureMap>(*bench.diagnosing.reduced, bench.rows, bench.scatter);
  shared->inference = std::make_unique<diagnosis::Inference>(*shared->nominal, shared->diagnosing.candidates);
  shared->base = shared->inference->fit({}, {});
  for (const auto& candidate : shared->diagnosing.candidates) {
    // What a stay does whose own frequency is measured is said by nothing else.
    if (candidate->tuned >= 0 && (candidate->high - candidate->low)[candidate->tuned] < 0.25) continue;
    for (const VectorXd& a : candidate->starts)
      shared->changes[candidate->key()].push_back(shared->inference->change(shared->base, *candidate, a));
  }
  shared->noise_factor = shared->nominal->covariance().llt().matrixL();
  for (std::size_t i = 0; i < shared->truth.candidates.size(); ++i) {
    const Candidate& c = *shared->truth.candidates[i];
    shared->families[c.hypothesis->id].push_back({&c, shared->diagnosing.candidates[i].get()});
  }
  return *shared;
}

/// A place and magnitude of a family that these data show with `target` standard deviations or nearly. False where they show it
/// by 2.5 nowhere that was tried: then what they show best of it.
bool draw_effect(const Shared& shared, const std::string& family, double target, Stream& random, Twin& twin, VectorXd& a,
                 double& sigma) {
  const auto& twins = shared.families.at(family);
  // Of nineteen supports the mast's alone shows much, and only where it is soft by orders: it takes more draws to meet it.
  const bool supports =
      twins.front().diagnosing->hypothesis->set == "supports" || twins.front().diagnosing->hypothesis->set == "foundations";
  const double margin = supports ? 0.0 : 0.1;
  struct Best {
    Twin twin{};
    VectorXd a;
    double sigma = -1.0;
  } best;
  for (int attempt = 0; attempt < (supports ? 100 : 12); ++attempt) {
    twin = twins[random.below(twins.size())];
    const Candidate& c = *twin.diagnosing;
    a = c.low;
    for (Index i = 0; i < a.size(); ++i)
      a[i] = c.low[i] + (margin + (1.0 - 2.0 * margin) * random.uniform()) * (c.high[i] - c.low[i]);
    const auto visible = [&](const VectorXd& at) {
      const VectorXd s = shared.inference->signature(shared.base, c, at);
      return s.size() > 0 ? s.norm() : 0.0;
    };
    sigma = visible(a);
    if (sigma > best.sigma) best = {twin, a, sigma};
    if (sigma < 3.0) continue;
    const double none = neutral(c);
    if (sigma > target && std::isfinite(none)) {
      double near = std::clamp(none, c.low[0], c.high[0]), far = a[0];
      for (int i = 0; i < 10; ++i) {
        a[0] = 0.5 * (near + far);
        sigma = visible(a);
        (sigma > target ? far : near) = a[0];
      }
    }
    if (sigma >= 2.5) return true;
  }
  std::tie(twin, a, sigma) = std::tie(best.twin, best.a, best.sigma);
  return false;
}

double cosine(const VectorXd& one, const VectorXd& other) {
  const double norms = one.norm() * other.norm();
  return norms > 0.0 ? std::abs(one.dot(other)) / norms : 0.0;
}

/// The signature of an entry, from one of its starts on towards nothing or its bound until it shows as much as `size`.
VectorXd signature_of_size(const Shared& shared, const Candidate& candidate, VectorXd a, double size) {
  const auto signature = [&](double first) {
    a[0] = first;
    return shared.inference->signature(shared.base, candidate, a);
  };
  const double none = neutral(candidate), start = a[0];
  VectorXd s = signature(start);
  double near = std::clamp(none, candidate.low[0], candidate.high[0]), far = start;
  if (s.norm() < size) {
    near = start;
    far = none < start ? candidate.high[0] : candidate.low[0];
  }
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (near + far);
    s = signature(middle);
    (s.norm() > size ? far : near) = middle;
  }
  return s;
}

/// Whether another family says the same in other words: a signature that runs along this one, at the magnitudes of its starts
/// or where it shows as much (thirty tonnes on the deck are another shape than three).
bool said_by_others(const Shared& shared, const Candidate& truth, const VectorXd& a) {
  constexpr double same = 0.9, similar = 0.8;
  const VectorXd s = shared.inference->signature(shared.base, truth, a);
  if (s.size() == 0) return true;
  for (const auto& candidate : shared.diagnosing.candidates) {
    if (candidate->hypothesis == truth.hypothesis) continue;
    const auto known = shared.changes.find(candidate->key());
    if (known == shared.changes.end()) continue;  // a stay whose own frequency is measured: nothing else has that
    const bool tuned = candidate->tuned >= 0, here = candidate->location == truth.location;
    for (std::size_t k = 0; k < known->second.size(); ++k) {
      const VectorXd& change = known->second[k];
      if (change.size() == 0) continue;
      const double cos = cosine(shared.inference->whitened(shared.base, change), s);
      if (cos > same) return true;
      if (tuned || !(here || cos > similar) || !std::isfinite(neutral(*candidate))) continue;
      if (cosine(signature_of_size(shared, *candidate, candidate->starts[k], s.norm()), s) > same) return true;
    }
  }
  return false;
}

}  // namespace

std::string Sealed::text() const {
  std::string out = fmt::format("{} seed {}", kind, seed);
  for (std::size_t i = 0; i < families.size(); ++i)
    out += fmt::format("; {}@{} ({:.4g})", families[i], locations[i], fmt::join(magnitudes[i], ", "));
  return out;
}

namespace {

Hidden hide(const Bench& bench, std::uint64_t seed, Stream& random, const HideOptions& options, bool null) {
  const Shared& shared = shared_of(bench);
  Hidden hidden;
  hidden.seal.seed = seed;
  // 1. What kind of case, in turn: of twenty, five nulls, three outside the catalogue, one with two causes, eleven with one.
  static const std::string turn = "neeoneeeneeonteoneee";  // the place in it is seed mod 20
  const char by_seed = null ? 'n' : turn[seed % 20];
  const char kind = options.kind != 0 ? options.kind : by_seed;
  hidden.seal.kind = kind == 'n' ? "null" : kind == 'o' ? "outside" : kind == 't' ? "two" : "effect";
  std::vector<std::string> names;
  for (const auto& [family, twins] : shared.families)
    if (options.only.empty() || options.only.contains(family)) names.push_back(family);
  // Families in turn, so that each has its share of the cases with one cause; place and size by chance.
  std::uint64_t effects_before = 0;
  for (std::uint64_t s = 1; s < seed % 20; ++s) effects_before += turn[s] == 'e' ? 1 : 0;
  static const std::uint64_t effects_in_turn = [] {
    std::uint64_t count = 0;
    for (const char c : turn) count += c == 'e' ? 1 : 0;
    return count;
  }();
  std::size_t next = static_cast<std::size_t>((seed / 20 * effects_in_turn + effects_before) % names.size());
  if (options.family >= 0) next = static_cast<std::size_t>(options.family);
  std::vector<Cause>& truth = hidden.causes;
  const int wanted = kind == 'n' ? 0 : kind == 't' ? 2 : 1;
  while (static_cast<int>(truth.size()) < wanted) {
    // Outside the catalogue only what no other family says in other words (an oscillator tuned far above the measured modes is
    // a mass; a damper whose threshold is never reached is its mount, so friction is not among them).
    static const std::vector<std::string> outside = {"tie", "osc", "joint", "brg", "freeze", "tempE", "cable"};
    std::string family;
    if (kind == 'o')
      family = outside[random.below(outside.size())];
    else if (kind == 't')
      family = names[random.below(names.size())];
    else
      family = names[next++ % names.size()];  // the next one where these data show the family nowhere at all
    if (std::find(names.begin(), names.end(), family) == names.end()) continue;
    const double least = kind == 'o' ? 10.0 : kind == 't' ? 7.0 : options.least_sigma;
    const double target = least * std::pow(kind == 'e' ? 15.0 / options.least_sigma : 3.0, random.uniform());
    Twin twin{};
    VectorXd a;
    double sigma = 0.0;
    const bool shown = draw_effect(shared, family, target, random, twin, a, sigma) && sigma >= 0.8 * least;
    // A family that these data hardly show is hidden all the same: what is said of it then is of interest too.
    if (!shown && !(kind == 'e' && options.least_sigma <= 3.0 && sigma > 0.0)) continue;
    hidden.seal.said_by_others = kind != 't' && said_by_others(shared, *twin.diagnosing, a);
    if (kind == 'o' && hidden.seal.said_by_others) continue;
    if (!truth.empty() && truth[0].candidate->hypothesis == twin.truth->hypothesis) continue;
    truth.push_back({twin.truth, a});
    hidden.seal.sigma = truth.size() == 1 ? sigma : std::min(hidden.seal.sigma, sigma);
    hidden.seal.families.push_back(family);
    hidden.seal.locations.push_back(twin.diagnosing->location);
    std::vector<double> magnitude;
    for (Index i = 0; i < a.size(); ++i) magnitude.push_back(twin.truth->physical(a, i));
    hidden.seal.magnitudes.push_back(magnitude);
  }
  if (hidden.seal.kind == "outside") hidden.removed = hidden.seal.families[0];
  return hidden;
}

}  // namespace

namespace {

/// A stay that swings with the deck does so at its own frequency: its pull is what makes it.
void swing_at_own_pull(const diagnosis::FeatureMap& map, const std::vector<Cause>& truth, VectorXd& x) {
  for (const Cause& cause : truth) {
    if (cause.candidate->hypothesis->id != "cable") continue;
    const diagnosis::ReducedPlace& stay = *cause.candidate->places[0];
    for (std::size_t j = 0; j < map.nuisances().size(); ++j) {
      const diagnosis::Nuisance& v = map.nuisances()[j];
      if (v.kind == diagnosis::Nuisance::Kind::stay_pull && v.name == stay.id + " pull")
        x[static_cast<Index>(j)] =
            2.0 * std::log(cause.candidate->physical(cause.a, 0) / stay.attributes.at("f_cable")) / v.deviation;
    }
  }
}

}  // namespace

Hidden hide(const Bench& bench, std::uint64_t seed, const HideOptions& options) {
  Stream random(seed);
  return hide(bench, seed, random, options, false);
}

Case make_case(const Bench& bench, std::uint64_t seed, double noise_scale, bool null, std::uint64_t campaign) {
  const Shared& shared = shared_of(bench);
  Stream random(seed);
  const Hidden drawn = hide(bench, seed, random, {}, null);
  if (campaign > 0) random = Stream(seed + 1000003 * campaign);
  Case hidden;
  hidden.seal = drawn.seal;
  hidden.removed = drawn.removed;
  const std::vector<Cause>& truth = drawn.causes;
  // 2. Parameters and element scatter of this bridge, then what is measured on it.
  const diagnosis::FeatureMap map(*bench.truth.reduced, bench.rows, bench.scatter);
  for (;;) {
    VectorXd x(static_cast<Index>(map.nuisances().size()));
    for (Index j = 0; j < x.size(); ++j) {
      const diagnosis::Nuisance& v = map.nuisances()[static_cast<std::size_t>(j)];
      do
        x[j] = v.kind == diagnosis::Nuisance::Kind::mode_damping || v.kind == diagnosis::Nuisance::Kind::level
                   ? 0.3 * random.normal()
                   : random.normal();
      while (x[j] < v.lower || x[j] > v.upper);
    }
    swing_at_own_pull(map, truth, x);
    const diagnosis::Prediction p = map.predict(map.base(x), truth, false);
    if (!p.valid) continue;
    VectorXd noise(p.g.size());
    for (Index r = 0; r < noise.size(); ++r) noise[r] = random.normal();
    hidden.values = p.g + noise_scale * (shared.noise_factor * noise);
    return hidden;
  }
}

/// What `use` makes of the inference on a case's values, by the catalogue without the family that the case takes away.
template <typename Use>
static auto on_inference(const Bench& bench, const Case& hidden, const Use& use) {
  const Shared& shared = shared_of(bench);
  std::vector<diagnosis::Hypothesis> catalogue;
  for (const diagnosis::Hypothesis& h : bench.catalogue)
    if (h.id != hidden.removed) catalogue.push_back(h);
  diagnosis::FeatureMap map = *shared.nominal;
  map.set_values(hidden.values);
  const diagnosis::Instantiated entries = diagnosis::instantiate(catalogue, *bench.diagnosing.reduced, map.features());
  diagnosis::Inference inference(map, entries.candidates);
  return use(inference);
}

diagnosis::Cause cause_of(const Candidate& entry, const Sealed& seal) {
  Cause cause{&entry, entry.low};
  for (std::size_t f = 0; f < seal.families.size(); ++f) {
    if (entry.hypothesis->id != seal.families[f]) continue;
    for (Index i = 0; i < cause.a.size(); ++i) {
      const double value = seal.magnitudes[f][static_cast<std::size_t>(i)];
      cause.a[i] = entry.log[static_cast<std::size_t>(i)] ? std::log(value) : value;
    }
  }
  return cause;
}

namespace {

/// What the best possible answer gains: the hidden cause itself in the model, its size fitted to the training rows.
double ratio_with_truth(const diagnosis::Inference& inference, const Sealed& seal, const diagnosis::Fit& before) {
  std::vector<Cause> causes;
  for (const auto& entry : inference.candidates())
    for (std::size_t f = 0; f < seal.families.size(); ++f)
      if (entry->id() == seal.families[f] + "@" + seal.locations[f]) causes.push_back(cause_of(*entry, seal));
  const diagnosis::Fit with = inference.fit(causes, before.map.x);
  if (with.chi_squared > 1e299) return 1.0;
  const diagnosis::Gain gain = diagnosis::held_out_gain(inference, before, with, 1, seal.seed);
  return gain.before > 0.0 ? gain.after / gain.before : 1.0;
}

}  // namespace

Coverage coverage(const Bench& bench, std::uint64_t seed, int campaigns) {
  const Sealed seal = hide(bench, seed, {}).seal;
  Coverage out{seal.text(), 0, 0};
  if (seal.kind != "effect" || seal.magnitudes[0].empty()) return out;
  std::vector<char> covered(static_cast<std::size_t>(campaigns), 0);
  parallel_for(campaigns, [&](int i) {
    const Case hidden = make_case(bench, seed, 1.0, false, static_cast<std::uint64_t>(i) + 1);
    covered[static_cast<std::size_t>(i)] = on_inference(bench, hidden, [&](auto& inference) {
      const auto& all = inference.candidates();
      const auto truth = std::find_if(
          all.begin(), all.end(), [&](const auto& entry) { return entry->id() == seal.families[0] + "@" + seal.locations[0]; });
      TWINDECK_ASSERT(truth != all.end());
      const diagnosis::Fit with = inference.fit({cause_of(**truth, seal)}, inference.fit({}, {}).map.x);
      const diagnosis::EffectParameter size = diagnosis::effect_parameters(inference, with, 0).front();
      const double value = seal.magnitudes[0][0];
      return value >= std::min(size.low, size.high) && value <= std::max(size.low, size.high);
    });
  });
  out.campaigns = campaigns;
  out.covered = static_cast<int>(std::count(covered.begin(), covered.end(), 1));
  return out;
}

/// [nats] Of all causes together that act in all conditions: here the model's form is exact, and no error of it looks like one.
constexpr double kEvenOdds = 0.0;

Score run_case(const Bench& bench, const Case& hidden) {
  timespec begin{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  return on_inference(bench, hidden, [&](auto& inference) {  // what is found refers to the inference's entries
    diagnosis::DiagnoseOptions options;
    options.static_odds = kEvenOdds;
    const diagnosis::Diagnosis result = diagnosis::diagnose(inference, options, hidden.seal.seed);
    timespec end{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    Score score =
        score_of(hidden.seal, result,
                 static_cast<double>(end.tv_sec - begin.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec));
    if (score.kind == "effect" && !result.effects.empty())
      score.ratio_with_truth = ratio_with_truth(inference, hidden.seal, result.before);
    return score;
  });
}

void explain_case(const Bench& bench, std::uint64_t seed) {
  const Case hidden = make_case(bench, seed);
  on_inference(bench, hidden, [&](auto& inference) { explain(inference, hidden.seal, 14); });
}

namespace {

/// Sum of the probabilities of a family's entries; the odds are those of the first search, nothing missing has odds 1.
double family_probability(const std::vector<diagnosis::Scored>& ranking, const std::string& family) {
  double top = 0.0;
  for (const auto& scored : ranking) top = std::max(top, scored.log_odds);
  double of_family = 0.0, all = std::exp(-top);
  for (const auto& scored : ranking) {
    const double odds = std::exp(scored.log_odds - top);
    all += odds;
    if (family_of(scored.candidate->id()) == family) of_family += odds;
  }
  return of_family / all;
}

}  // namespace

Score score_of(const Sealed& seal, const diagnosis::Diagnosis& result, double seconds) {
  Score score;
  score.kind = seal.kind;
  score.family = seal.families.empty() ? "" : seal.families[0];
  score.sigma = seal.sigma;
  score.said_by_others = seal.said_by_others;
  score.seal = seal.text();
  score.seconds = seconds;
  score.verdict = name_of(result.verdict);
  score.log_odds = result.log_odds;
  score.detected = !result.effects.empty() || result.verdict == diagnosis::Verdict::unknown;
  score.p_value = result.residual.p_value;
  score.block_p_value = result.residual.block_p_value;
  score.chi_squared_ratio = result.before.chi_squared / result.residual.dof;
  score.gain_claimed = !result.effects.empty() && result.gain.low_pct > 0.0;
  score.held_out_ratio = result.gain.before > 0.0 ? result.gain.after / result.gain.before : 1.0;
  score.unknown = result.verdict == diagnosis::Verdict::unknown || result.verdict == diagnosis::Verdict::none;
  std::vector<bool> named(seal.families.size(), false);
  for (const auto& effect : result.effects) {
    score.found += (score.found.empty() ? "" : " + ") + effect.cluster.front();
    for (std::size_t m = 1; m < effect.cluster.size() && m < 5; ++m) score.found += " or " + effect.cluster[m];
    score.found += fmt::format(" [{:.1f}]", effect.log_odds);
    for (std::size_t i = 0; i < named.size(); ++i)
      named[i] = named[i] || effect.cause.candidate->hypothesis->id == seal.families[i];
  }
  score.both = std::all_of(named.begin(), named.end(), [](bool n) { return n; });
  if (!result.effects.empty() && !seal.families.empty()) {
    const auto& first = result.effects.front();
    score.family_probability = family_probability(result.ranking, family_of(first.cluster.front()));
    const std::string truth = seal.families[0] + "@" + seal.locations[0];
    score.family_named = family_of(first.cluster.front()) == seal.families[0] || (seal.kind == "two" && named[0]);
    score.exact = first.cause.candidate->id() == truth;
    score.in_set = std::find(first.cluster.begin(), first.cluster.end(), truth) != first.cluster.end();
    score.set_size = static_cast<int>(first.cluster.size());
    if (score.exact && !first.parameters.empty()) {
      score.sized = true;
      const double value = seal.magnitudes[0][0];
      const auto [low, high] = std::minmax(first.parameters[0].low, first.parameters[0].high);
      score.covered = value >= low && value <= high;
      score.one_sided = first.parameters[0].at_low_bound || first.parameters[0].at_high_bound;
      score.magnitude_error = std::abs(first.parameters[0].value - value) / std::max(std::abs(value), 1e-12);
    }
  }
  return score;
}

NullTest residual_test(const Bench& bench, std::uint64_t seed) {
  const Shared& shared = shared_of(bench);
  diagnosis::FeatureMap map = *shared.nominal;
  map.set_values(make_case(bench, seed, 1.0, true).values);
  const diagnosis::Inference inference(map, shared.diagnosing.candidates);
  const diagnosis::Fit fit = inference.fit({}, {});
  const diagnosis::ResidualTest test = diagnosis::residual_test(inference, fit);
  return {test.statistic, test.dof, test.p_value, test.block_p_value};
}

std::vector<std::string> families_of(const Bench& bench) {
  std::vector<std::string> names;
  for (const auto& [family, twins] : shared_of(bench).families) names.push_back(family);
  return names;
}

}  // namespace twindeck::blind
