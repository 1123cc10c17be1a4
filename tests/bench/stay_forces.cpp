/// How often the interval of a cable force holds the force: bench_stay_forces STAYS SEED. Random stays and hangers, hinged or
/// clamped, xi 6 to 400 (uniform logarithm), lambda² 0 to 30, three to ten harmonics of which one is missing in two of five,
/// frequencies known to 2e-4 to 1e-3, a foreign mode in three of ten.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "blind/exact_intervals.hpp"
#include "core/random.hpp"
#include "identification/tension.hpp"

using namespace twindeck;

namespace {

constexpr double kLevel = 0.9, kLength_m = 80.0;

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t stay) : seed_(seed), stay_(stay) {}
  double normal() { return normal_number(seed_, stay_, at_++); }
  double uniform(double low, double high) { return low + (high - low) * 0.5 * std::erfc(-normal() / std::sqrt(2.0)); }
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

 private:
  std::uint64_t seed_, stay_, at_ = 0;
};

struct Stay {
  double c_Hz = 0.0;
  std::size_t harmonics = 0;
  std::vector<identification::Harmonic> found;
};

Stay drawn(Draws& draw) {
  const identification::TensionedBeam beam{draw.logarithmic(6.0, 400.0), draw.uniform(0.0, 30.0),
                                           draw.uniform(0.0, 1.0) < 0.5 ? 0.0 : 1.0};
  const int most = static_cast<int>(draw.uniform(3.0, 11.0));
  const int missing = most > 3 && draw.uniform(0.0, 1.0) < 0.4 ? static_cast<int>(draw.uniform(1.0, most)) : 0;
  const double relative = draw.logarithmic(2e-4, 1e-3);
  Stay stay;
  stay.c_Hz = draw.logarithmic(0.5, 5.0);
  for (int n = 1; n <= most; ++n) {
    const double f = stay.c_Hz * identification::frequency_ratio(n, beam);
    if (n != missing) stay.found.push_back({0, f * (1.0 + relative * draw.normal()), relative * f});
  }
  stay.harmonics = stay.found.size();
  const double foreign = stay.found.back().frequency_Hz * draw.uniform(0.2, 1.0);
  if (draw.uniform(0.0, 1.0) < 0.3) stay.found.push_back({0, foreign, relative * foreign});
  std::sort(stay.found.begin(), stay.found.end(), [](const identification::Harmonic& a, const identification::Harmonic& b) {
    return a.frequency_Hz < b.frequency_Hz;
  });
  return stay;
}

void print(const char* what, std::vector<double> widths, int held) {
  if (widths.empty()) return;
  std::sort(widths.begin(), widths.end());
  const auto n = static_cast<int>(widths.size());
  const auto [low, high] = blind::exact_interval(held, n);
  fmt::print("{}: {} of {} forces held at {:.0f} % ({:.1f} %, 95 %: {:.1f} to {:.1f} %), median width {:.2f} %\n", what, held,
             n, 100.0 * kLevel, 100.0 * held / n, 100.0 * low, 100.0 * high, 100.0 * widths[widths.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  const int stays = argc > 1 ? std::atoi(argv[1]) : 400;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  std::vector<double> all, five;
  int held = 0, held_five = 0;
  for (int i = 0; i < stays; ++i) {
    Draws draw(seed, static_cast<std::uint64_t>(i));
    const Stay stay = drawn(draw);
    const identification::StayFit fit = identification::fit_stay(stay.found, {kLength_m}, kLevel);
    const double force = std::pow(2.0 * kLength_m * stay.c_Hz, 2);
    const bool holds = fit.tension_per_mass.low <= force && force <= fit.tension_per_mass.high;
    all.push_back((fit.tension_per_mass.high - fit.tension_per_mass.low) / force);
    held += holds ? 1 : 0;
    if (stay.harmonics < 5) continue;
    five.push_back(all.back());
    held_five += holds ? 1 : 0;
  }
  print("all stays", all, held);
  print("five harmonics or more", five, held_five);
}
