/// Runs FORM and subset simulation on the published problems of tests/unit/reliability. Prints `problem method probability
/// calls seconds` lines for tests/bench/reliability.py: medians of processor time, probability (0: not converged) and calls of
/// the first run.
///
///     bench_reliability REPEATS
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "core/parallel.hpp"
#include "published_problems.hpp"

namespace {

using namespace twindeck::reliability;

template <typename Run>
double median_seconds(int repeats, const Run& run) {
  std::vector<double> seconds;
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::clock();
    run(static_cast<std::uint64_t>(k + 1));
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repeats / 2)];
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  twindeck::set_thread_count(1);
  for (const published::Problem& problem : published::all()) {
    const FormResult point = form(problem.g, problem.n, published::design_point_alone());
    const double form_seconds =
        median_seconds(repeats, [&](auto seed) { (void)form(problem.g, problem.n, published::design_point_alone(seed)); });
    std::printf("%s form %.12e %d %.6e\n", problem.name.c_str(), point.status.converged ? point.probability : 0.0, point.calls,
                form_seconds);
    const published::MeanSubset subset = published::mean_subset(problem);
    const double subset_seconds = median_seconds(repeats, [&](auto seed) {
      SubsetOptions options;
      options.seed = seed;
      (void)subset_simulation(problem.g, problem.n, options);
    });
    std::printf("%s subset %.12e %d %.6e\n", problem.name.c_str(), subset.probability, subset.calls, subset_seconds);
  }
  return 0;
}
