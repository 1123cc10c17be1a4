#include "identification/numbering.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::identification {

namespace {

constexpr int kHighest = 16;          ///< harmonic that is thought of
constexpr int kHighestThrough = 12;   ///< number that a single frequency may have
constexpr double kCoarseReach = 0.2;  ///< [-] of the spacing: the grid is as coarse as that
constexpr std::size_t kMostCandidates = 12;

struct Scored {
  Numbers numbers;
  double score;
};

/// Harmonics of one beam of the coarse grid, in units of c.
std::vector<std::vector<double>> coarse_grid() {
  std::vector<std::vector<double>> grid;
  for (const double fixity : {0.0, 1.0}) {
    for (double xi = 4.5; xi < 1000.0; xi *= 1.4) {
      // In equal steps of the first harmonic's ratio, which sag raises from 1 to 2.2.
      for (int step = 0; step <= 12; ++step) {
        const double lambda_squared = 40.0 * step / 12.0 * (1.0 + step / 12.0) / 2.0;
        std::vector<double> ratios;
        for (int n = 1; n <= kHighest; ++n) ratios.push_back(frequency_ratio(n, {xi, lambda_squared, fixity}));
        grid.push_back(std::move(ratios));
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

Numbers numbers_near(const std::vector<double>& frequencies_Hz, double c_Hz, const TensionedBeam& beam, double reach,
                     double least) {
  std::vector<double> ratios;
  for (int n = 1; n <= kHighest; ++n) ratios.push_back(frequency_ratio(n, beam));
  return near_ratios(frequencies_Hz, c_Hz, ratios, reach, least, nullptr);
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
  std::stable_sort(ranked.begin(), ranked.end(), [](const Scored& a, const Scored& b) { return a.score > b.score; });
  if (ranked.size() > kMostCandidates) ranked.resize(kMostCandidates);
  std::vector<Numbers> candidates;
  for (Scored& scored : ranked) candidates.push_back(std::move(scored.numbers));
  return candidates;
}

}  // namespace twindeck::identification
