/// Runs FORM and subset simulation on the published problems of tests/unit/reliability. Prints `problem method probability
/// calls seconds` lines for tests/bench/reliability.py: medians of processor time, probability (0: not converged) and calls of
/// the first run.
///
///     bench_reliability REPEATS
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "published_problems.hpp"
#include "reliability/form.hpp"
#include "reliability/subset_simulation.hpp"

namespace {

using namespace twindeck::reliability;

struct Problem {
  std::string name;
  LimitState g;
  Eigen::Index n;
};

template <typename Run>
void time(const std::string& problem, const char* method, int repeats, const Run& run) {
  std::vector<double> seconds;
  auto first = run(1);
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::clock();
    static_cast<void>(run(static_cast<std::uint64_t>(k + 1)));
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  std::printf("%s %s %.6e %d %.6e\n", problem.c_str(), method, first.status.converged ? first.probability : 0.0, first.calls,
              seconds[static_cast<std::size_t>(repeats / 2)]);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  twindeck::set_thread_count(1);
  const std::vector<Problem> problems = {{"R-S", published::resistance_less_load, 2},
                                         {"four_branches", published::four_branches, 2},
                                         {"RP22", published::rp22, 2},
                                         {"RP25", published::rp25, 2},
                                         {"RP31", published::rp31, 2},
                                         {"linear_2", published::linear(3.5), 2},
                                         {"linear_20", published::linear(3.5), 20},
                                         {"linear_200", published::linear(3.5), 200},
                                         {"RP107", published::linear(5.0), 10}};
  for (const Problem& problem : problems) {
    time(problem.name, "form", repeats, [&](std::uint64_t seed) {
      FormOptions options;  // the design point alone: no further starts, no test for others
      options.starts = 0;
      options.largest_test = 0;
      options.seed = seed;
      return form(problem.g, problem.n, options);
    });
    time(problem.name, "subset", repeats, [&](std::uint64_t seed) {
      SubsetOptions options;
      options.seed = seed;
      return subset_simulation(problem.g, problem.n, options);
    });
  }
  return 0;
}
