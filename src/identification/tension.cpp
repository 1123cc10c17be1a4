#include "identification/tension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::identification {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kSeen = 0.85;           ///< probability that a record shows a harmonic below the highest one
constexpr double kWorthComparing = 7.0;  ///< [nats] below the most probable numbering; less probable ones are dropped
constexpr double kAtANode = 0.05;        ///< probability that the sensor sits at the node of a harmonic, for each of two
constexpr double kWorthNaming = 0.01;    ///< probability

struct Explained {
  Numbers numbers;
  std::vector<Harmonic> harmonics;
  StayPosterior posterior;
  double log_probability = 0.0;
};

/// ln probability that a record shows just these harmonics of all up to the highest. Each is missed by chance; a sensor at mid
/// length or at a third of it misses every second or third one together.
double log_probability_of(const Numbers& numbers) {
  const int highest = numbers.rbegin()->first;
  const auto seen = static_cast<double>(numbers.size());
  const auto with_missed = [&](double missed) { return seen * std::log(kSeen) + missed * std::log(1.0 - kSeen); };
  double sum = std::exp(with_missed(highest - seen));
  for (const int node : {2, 3}) {
    const bool hidden = std::ranges::none_of(numbers, [&](const auto& n) { return n.first % node == 0; });
    if (hidden) sum += kAtANode * std::exp(with_missed(highest - seen - highest / node));
  }
  return std::log(sum);
}

Explained explain(const std::vector<Harmonic>& frequencies, const Numbers& numbers, const StaySection& section, Effort effort) {
  Explained result;
  result.numbers = numbers;
  for (const auto& [number, at] : numbers)
    result.harmonics.push_back({number, frequencies[at].frequency_Hz, frequencies[at].deviation_Hz});
  result.posterior = stay_posterior(result.harmonics, section, effort);
  result.log_probability = result.posterior.log_evidence + log_probability_of(numbers);
  return result;
}

const StayPart& likeliest(const StayPosterior& posterior) {
  return *std::ranges::max_element(posterior.parts, {}, &StayPart::log_weight);
}

struct Share {
  double weight;
  StayPart part;
};

/// The parts of all numberings with their probabilities.
std::vector<Share> shares_of(const std::vector<Explained>& numberings) {
  double most = -1e300, sum = 0.0;
  const auto log_share = [](const Explained& e, const StayPart& part) {
    return part.log_weight + e.log_probability - e.posterior.log_evidence;
  };
  for (const Explained& e : numberings)
    for (const StayPart& part : e.posterior.parts) most = std::max(most, log_share(e, part));
  std::vector<Share> shares;
  for (const Explained& e : numberings) {
    for (const StayPart& part : e.posterior.parts) {
      const double weight = std::exp(log_share(e, part) - most);
      if (weight < 1e-6) continue;
      shares.push_back({weight, part});
      sum += weight;
    }
  }
  for (Share& share : shares) share.weight /= sum;
  return shares;
}

struct Mixture {
  struct Law {
    double weight, mean, deviation;
  };
  std::vector<Law> laws;
  double low = 1e300, high = -1e300;

  void add(const Law& law) {
    laws.push_back(law);
    low = std::min(low, law.mean - 6.0 * law.deviation);
    high = std::max(high, law.mean + 6.0 * law.deviation);
  }
  [[nodiscard]] double below(double x) const {
    double sum = 0.0;
    for (const Law& law : laws) sum += law.weight * normal_probability((x - law.mean) / law.deviation);
    return sum;
  }
  /// x with below(x) = share, by bisection.
  [[nodiscard]] double quantile(double share) const {
    double from = low, to = high;
    while (to - from > 1e-7 * (high - low)) {
      const double middle = 0.5 * (from + to);
      (below(middle) < share ? from : to) = middle;
    }
    return 0.5 * (from + to);
  }
  /// Median, and the shortest interval. If two kinds of ends explain the data, an interval with equal tails would cut both.
  [[nodiscard]] Bounded bounds(double level) const {
    constexpr int kSteps = 20;
    Bounded best{quantile(0.5), 0.0, 1e300};
    for (int i = 0; i <= kSteps; ++i) {
      const double from = (1.0 - level) * i / kSteps, start = quantile(from), end = quantile(from + level);
      if (end - start < best.high - best.low) best = {best.value, start, end};
    }
    return best;
  }
};

Bounded bounded_c(const std::vector<Share>& shares, double level, const StaySection& section) {
  Mixture mixture;
  for (const Share& share : shares) {
    const double c = std::exp(share.part.log_c);
    const double weight = section.length_m > 0.0 ? kGravity_m_s2 / (4.0 * section.length_m * c * c) : 0.0;  // g L/(T/m)
    mixture.add({share.weight, share.part.log_c, std::hypot(share.part.log_c_deviation, weight * weight / 24.0)});
  }
  const Bounded log_c = mixture.bounds(level);
  return {std::exp(log_c.value), std::exp(log_c.low), std::exp(log_c.high)};
}

Bounded bounded_sag(const std::vector<Share>& shares, double level) {
  Mixture mixture;
  for (const Share& share : shares) mixture.add({share.weight, share.part.sag, std::max(share.part.sag_deviation, 1e-9)});
  const Bounded sag = mixture.bounds(level);
  const auto lambda_squared = [](double x) { return std::max(0.0, std::expm1(x)); };
  return {lambda_squared(sag.value), lambda_squared(sag.low), lambda_squared(sag.high)};
}

/// Median of xi, and its bounds by equal tails.
Bounded bounded_xi(const std::vector<Share>& shares, double level) {
  std::map<double, double> sorted;
  for (const Share& share : shares) sorted[share.part.beam.xi] += share.weight;
  const auto at = [&](double share) {
    double sum = 0.0;
    for (const auto& [x, weight] : sorted) {
      sum += weight;
      if (sum >= share) return x;
    }
    return sorted.rbegin()->first;
  };
  return {at(0.5), at(0.5 * (1.0 - level)), at(0.5 * (1.0 + level))};
}

Numbering named(const Explained& explained, double probability) {
  Numbering numbering{explained.harmonics, {}, probability};
  for (const auto& [number, at] : explained.numbers) numbering.positions.push_back(at);
  return numbering;
}

double residual_of(const Explained& explained) {
  const StayPart& part = likeliest(explained.posterior);
  double sum = 0.0;
  for (const Harmonic& h : explained.harmonics) {
    const double expected = std::exp(part.log_c) * frequency_ratio(h.number, part.beam);
    sum += std::pow((h.frequency_Hz - expected) / h.deviation_Hz, 2);
  }
  return std::sqrt(sum / static_cast<double>(explained.harmonics.size()));
}

/// @param numberings  the most probable first
StayFit fit_of(const std::vector<Explained>& numberings, const StaySection& section, double level) {
  StayFit fit;
  const std::vector<Share> shares = shares_of(numberings);
  fit.c_Hz = bounded_c(shares, level, section);
  const auto tension = [&](double c) { return std::pow(2.0 * std::max(section.length_m, 0.0) * c, 2); };
  fit.tension_per_mass = {tension(fit.c_Hz.value), tension(fit.c_Hz.low), tension(fit.c_Hz.high)};
  fit.lambda_squared = bounded_sag(shares, level);
  fit.xi = bounded_xi(shares, level);
  for (const Share& share : shares) {
    if (share.part.beam.fixity <= 0.0) fit.hinged += share.weight;
    if (share.part.beam.fixity >= 1.0) fit.clamped += share.weight;
  }
  double sum = 0.0;
  for (const Explained& e : numberings) sum += std::exp(e.log_probability - numberings.front().log_probability);
  for (const Explained& e : numberings) {
    const double probability = std::exp(e.log_probability - numberings.front().log_probability) / sum;
    if (&e == &numberings.front()) {
      fit.numbering = named(e, probability);
    } else if (probability > kWorthNaming) {
      fit.others.push_back(named(e, probability));
    }
  }
  fit.residual = residual_of(numberings.front());
  return fit;
}

/// Numberings from the coarse grid. Each is renumbered with its best beam; frequencies that this beam does not explain are left
/// out.
std::vector<Explained> compared(const std::vector<Harmonic>& frequencies, const StaySection& section, double lowest_Hz,
                                double highest_Hz) {
  constexpr double kReach = 0.05;        // of the spacing
  constexpr double kLeastReach = 0.004;  // of the frequency
  const std::vector<double> values = each_of(frequencies, &Harmonic::frequency_Hz);
  std::set<Numbers> done;
  std::vector<Explained> numberings;
  for (Numbers numbers : candidate_numbers(values, lowest_Hz, highest_Hz)) {
    for (int turn = 0; turn < 3 && numbers.size() >= 2 && done.insert(numbers).second; ++turn) {
      numberings.push_back(explain(frequencies, numbers, section, Effort::quick));
      const StayPart& part = likeliest(numberings.back().posterior);
      numbers = numbers_near(values, std::exp(part.log_c), part.beam, kReach, kLeastReach);
    }
  }
  return numberings;
}

void most_probable_first(std::vector<Explained>& numberings) {
  std::ranges::stable_sort(numberings, std::greater{}, &Explained::log_probability);
  std::erase_if(numberings,
                [&](const Explained& e) { return e.log_probability < numberings.front().log_probability - kWorthComparing; });
}

constexpr int kHighest = 16;          ///< highest harmonic in the search
constexpr int kHighestThrough = 12;   ///< highest number of the frequency that fixes c
constexpr double kCoarseReach = 0.2;  ///< [-] of the spacing of harmonics, the resolution of the grid
constexpr std::size_t kMostCandidates = 12;

struct Scored {
  Numbers numbers;
  double score;
};

/// Harmonics of a beam in units of c, from the first.
std::vector<double> ratios_of(const TensionedBeam& beam) {
  std::vector<double> ratios;
  for (int n = 1; n <= kHighest; ++n) ratios.push_back(frequency_ratio(n, beam));
  return ratios;
}

/// Harmonics of one beam of the coarse grid, in units of c.
std::vector<std::vector<double>> coarse_grid() {
  std::vector<std::vector<double>> grid;
  for (const double fixity : {0.0, 1.0}) {
    for (double xi = 4.5; xi < 1000.0; xi *= 1.4) {
      // Equal steps of the first harmonic's ratio; sag raises it from 1 to 2.2.
      for (int step = 0; step <= 12; ++step) {
        const double lambda_squared = 40.0 * step / 12.0 * (1.0 + step / 12.0) / 2.0;
        grid.push_back(ratios_of({xi, lambda_squared, fixity}));
      }
    }
  }
  return grid;
}

/// One-to-one, the nearest first come. @param ratios  in units of c, from the first
Numbers near_ratios(const std::vector<double>& frequencies_Hz, double c_Hz, const std::vector<double>& ratios, double reach,
                    double least, double* misfit) {
  Numbers numbers;
  std::map<std::size_t, std::pair<int, double>> taken;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    const double f = c_Hz * ratios[k];
    if (f > frequencies_Hz.back() * (1.0 + least) + c_Hz) break;
    const double spacing = c_Hz * std::abs(k + 1 < ratios.size() ? ratios[k + 1] - ratios[k] : ratios[k] - ratios[k - 1]);
    const double within = std::max(reach * spacing, least * f);
    const auto above = std::lower_bound(frequencies_Hz.begin(), frequencies_Hz.end(), f);
    std::size_t best = frequencies_Hz.size();
    double off = within;
    for (auto at = above == frequencies_Hz.begin() ? above : above - 1; at != frequencies_Hz.end() && at <= above; ++at) {
      if (std::abs(*at - f) > off) continue;
      off = std::abs(*at - f);
      best = static_cast<std::size_t>(at - frequencies_Hz.begin());
    }
    if (best == frequencies_Hz.size()) continue;
    const auto before = taken.find(best);
    if (before != taken.end()) {
      if (before->second.second <= off) continue;
      numbers.erase(before->second.first);
    }
    taken[best] = {static_cast<int>(k) + 1, off};
    numbers[static_cast<int>(k) + 1] = best;
    if (misfit != nullptr) *misfit += std::pow(off / within, 2);
  }
  return numbers;
}

}  // namespace

StayFit fit_stay(const std::vector<Harmonic>& frequencies, const StaySection& section, double level, double lowest_Hz,
                 double highest_Hz) {
  if (frequencies.size() < 2) return {};
  std::vector<Explained> numberings = compared(frequencies, section, lowest_Hz, highest_Hz);
  if (numberings.empty()) return {};
  most_probable_first(numberings);
  constexpr std::size_t kMost = 3;
  if (numberings.size() > kMost) numberings.resize(kMost);
  for (Explained& e : numberings) e = explain(frequencies, e.numbers, section, Effort::full);
  most_probable_first(numberings);
  return fit_of(numberings, section, level);
}

StayFit fit_numbered(const std::vector<Harmonic>& harmonics, const StaySection& section, double level) {
  if (harmonics.size() < 2)
    throw InputError({"", 0, "stay"}, fmt::format("has {} harmonics, expected at least two", harmonics.size()),
                     "identify higher modes of the stay");
  Numbers numbers;
  for (std::size_t i = 0; i < harmonics.size(); ++i) numbers[harmonics[i].number] = i;
  return fit_of({explain(harmonics, numbers, section, Effort::full)}, section, level);
}

Numbers numbers_near(const std::vector<double>& frequencies_Hz, double c_Hz, const TensionedBeam& beam, double reach,
                     double least) {
  return near_ratios(frequencies_Hz, c_Hz, ratios_of(beam), reach, least, nullptr);
}

std::vector<Numbers> candidate_numbers(const std::vector<double>& frequencies_Hz, double lowest_Hz, double highest_Hz) {
  static const std::vector<std::vector<double>> grid = coarse_grid();
  std::map<std::vector<std::pair<int, std::size_t>>, Scored> best;
  for (const std::vector<double>& ratios : grid) {
    for (const double f : frequencies_Hz) {
      for (int n = 1; n <= kHighestThrough; ++n) {
        const double c = f / ratios[static_cast<std::size_t>(n - 1)];
        if (c < lowest_Hz || (highest_Hz > 0.0 && c > highest_Hz)) continue;
        double misfit = 0.0;
        Numbers numbers = near_ratios(frequencies_Hz, c, ratios, kCoarseReach, 0.0, &misfit);
        if (numbers.size() < 2) continue;
        const double missed = numbers.rbegin()->first - static_cast<double>(numbers.size());
        const double score = 2.0 * static_cast<double>(numbers.size()) - missed - misfit;
        std::vector<std::pair<int, std::size_t>> key(numbers.begin(), numbers.end());
        const auto [at, is_new] = best.try_emplace(std::move(key), Scored{numbers, score});
        if (!is_new) at->second.score = std::max(at->second.score, score);
      }
    }
  }
  std::vector<Scored> ranked;
  for (auto& [key, scored] : best) ranked.push_back(std::move(scored));
  std::ranges::stable_sort(ranked, [](const Scored& a, const Scored& b) { return a.score > b.score; });
  if (ranked.size() > kMostCandidates) ranked.resize(kMostCandidates);
  return each_of(ranked, &Scored::numbers);
}

}  // namespace twindeck::identification
