/// blind_records N [first seed [time]]: sealed cases as records of the truth integrated in time, identified and then diagnosed.
/// Prints the score with 95 % intervals; exit code 1 when an interval lies wholly on the wrong side of its target, 2 for a tier
/// that is none.
#include <fmt/format.h>

#include <cstdlib>

#include "blind/records.hpp"
#include "blind/score_table.hpp"

namespace twindeck::blind {

namespace {

bool is_effect(const Score& s) { return s.kind == "effect"; }
bool is_null(const Score& s) { return s.kind == "null"; }

/// Other physics than the diagnosis': three in four named, never a wrong name that the residual test lets pass.
std::vector<ScoreLine> time_lines() {
  return {{"names given on nulls", is_null, [](const Score& s) { return !s.found.empty(); }, 0.07, false},
          {"family named", is_effect, [](const Score& s) { return s.family_named; }, 0.75, true},
          {"truth in the reported set, given detected", [](const Score& s) { return is_effect(s) && s.detected; },
           [](const Score& s) { return s.in_set; }, 0.92, true},
          {"wrong name with a passing residual test", [](const Score& s) { return !is_null(s); },
           [](const Score& s) { return !s.found.empty() && !s.family_named && s.verdict != "unknown" && s.p_value > 0.05; },
           0.0, false}};
}

}  // namespace

}  // namespace twindeck::blind

int main(int argc, char** argv) {
  using namespace twindeck::blind;
  if (argc > 3 && std::string(argv[3]) != "time") {
    fmt::print(stderr, "blind_records: '{}' is no tier, expected time\n", argv[3]);
    return 2;
  }
  const int count = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const auto bench = make_bench();
  const auto& families = families_of_integrated_records();
  fmt::print("truth on {} dofs, diagnosis on {} dofs, {} families\n", bench.truth.model->loaded.system.size(),
             bench.diagnosing.model->loaded.system.size(), families.size());
  std::vector<Score> scores;
  // N effects from six sigma up, for the question is other physics and not power, every second family in turn, then two nulls
  // and one outside the catalogue.
  const int cases = count + 3;
  for (int i = 0; i < cases; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    HideOptions options{families, 6.0, 0, -1};
    options.kind = i < count ? 'e' : i < count + 2 ? 'n' : 'o';
    options.family = static_cast<int>((2 * seed - 1) % families.size());
    const Hidden hidden = hide(bench, seed, options);
    const Score s = run_records(bench, hidden, integrated_records(bench, hidden));
    fmt::print("{:>4} {:<9} D {:>7.1f} chi2/dof {:.2f} p {:.3g} s {:>5.1f} held out {:.2f} {:>5.1f} s | {} | found {}\n", seed,
               s.verdict, s.log_odds, s.chi_squared_ratio, s.p_value, s.sigma, s.held_out_ratio, s.seconds, s.seal,
               s.found.empty() ? "nothing" : s.found);
    std::fflush(stdout);
    scores.push_back(s);
  }
  fmt::print("\nscore, exact 95 % intervals; sigma is that of the rows of the tier of features\n");
  const bool held = print_scores(time_lines(), scores);
  fmt::print("{}\n", held ? "targets held" : "a target is missed");
  return held ? 0 : 1;
}
