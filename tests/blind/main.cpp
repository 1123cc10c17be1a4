/// blind_trials N [first seed]: runs sealed cases, scores them, prints the table with 95 % intervals. From 400 trials on the
/// targets are judged: exit code 1 when an interval lies wholly on the wrong side of one. Fewer trials are held against the
/// method's own rates: exit code 1 for what these give once in a thousand runs. 0 otherwise. A signal ends
/// the run with the table of what was done. blind_trials --nulls N: calibration of the residual
/// test. blind_trials --count N: what N trials hide, by family, without a diagnosis. blind_trials --explain SEED …: the
/// evidence of single cases. blind_trials --coverage N SEED …: how often intervals hold the size when the cause is given, each
/// case in N campaigns.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <tuple>

#include "blind/explain.hpp"
#include "blind/score_table.hpp"
#include "blind/trial.hpp"
#include "core/parallel.hpp"

namespace {

using twindeck::blind::Score;

volatile std::sig_atomic_t stopped = 0;
void stop(int) { stopped = 1; }

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

std::string line_of(std::uint64_t seed, const Score& s) {
  return fmt::format(
      "{:>4} {:<9} D {:>7.1f} chi2/dof {:.2f} p {:.3g} block {:.3g} s {:>5.1f} gain {:.2f} {:>5.2f} s | {} | found {}", seed,
      s.verdict, s.log_odds, s.chi_squared_ratio, s.p_value, s.block_p_value, s.sigma, s.held_out_ratio, s.seconds, s.seal,
      s.found.empty() ? "nothing" : s.found);
}

/// Runs `work(i)` for i < count on all threads, results printed in order as they come; stops early at a signal, and
/// returns what was done without a gap.
std::vector<Score> run_all(int count, const std::function<Score(int)>& work,
                           const std::function<std::string(int, const Score&)>& line) {
  std::vector<std::optional<Score>> done(static_cast<std::size_t>(count));
  std::size_t printed = 0;
  std::mutex printing;
  twindeck::parallel_for(count, [&](int i) {
    if (stopped) return;
    Score score = work(i);
    const std::scoped_lock lock(printing);
    done[static_cast<std::size_t>(i)] = std::move(score);
    for (; printed < done.size() && done[printed]; ++printed)
      fmt::print("{}\n", line(static_cast<int>(printed), *done[printed]));
    std::fflush(stdout);
  });
  std::vector<Score> scores;
  for (const auto& s : done) {
    if (!s) break;
    scores.push_back(*s);
  }
  return scores;
}

/// Nulls alone: how often the residual test rejects, and what is named when the noise is understated.
int null_calibration(const twindeck::blind::Bench& bench, int count, std::uint64_t first) {
  std::vector<double> p(static_cast<std::size_t>(count), 1.0), block(p), ratio(p);
  twindeck::parallel_for(count, [&](int i) {
    const auto test = twindeck::blind::residual_test(bench, first + static_cast<std::uint64_t>(i));
    p[static_cast<std::size_t>(i)] = test.p_value;
    block[static_cast<std::size_t>(i)] = test.block_p_value;
    ratio[static_cast<std::size_t>(i)] = test.chi_squared / test.dof;
  });
  double mean = 0.0;
  for (const double r : ratio) mean += r / count;
  bool held = true;
  for (const auto& [level, low, high] : {std::tuple{0.05, 0.025, 0.08}, std::tuple{0.01, 0.0, 0.025}}) {
    const auto k = static_cast<int>(std::count_if(p.begin(), p.end(), [&, l = level](double v) { return v < l; }));
    const auto [from, to] = twindeck::blind::exact_interval(k, count);
    const bool wrong = to < low || from > high;
    held = held && !wrong;
    fmt::print("residual test at {:.0f} %: rejects {}/{} nulls = {:.1f} % [{:.1f}, {:.1f}], target {:.1f} to {:.1f} %  {}\n",
               100.0 * level, k, count, 100.0 * k / count, 100.0 * from, 100.0 * to, 100.0 * low, 100.0 * high,
               wrong ? "MISSED" : "held");
  }
  fmt::print("mean chi2/dof {:.3f}\n", mean);
  // Bonferroni's bound over blocks that overlap: at most the level, and less.
  const auto rejected = static_cast<int>(std::count_if(block.begin(), block.end(), [](double v) { return v < 0.05; }));
  const auto [least, most] = twindeck::blind::exact_interval(rejected, count);
  held = held && least <= 0.05;
  fmt::print("blocks of rows at 5 %: rejects {}/{} nulls = {:.1f} % [{:.1f}, {:.1f}], target at most 5 %  {}\n", rejected,
             count, 100.0 * rejected / count, 100.0 * least, 100.0 * most, least <= 0.05 ? "held" : "MISSED");
  const auto scores = run_all(
      count,
      [&](int i) {
        return twindeck::blind::run_case(bench,
                                         twindeck::blind::make_case(bench, first + static_cast<std::uint64_t>(i), 1.3, true));
      },
      [&](int i, const Score& s) { return "noise x 1.3: " + line_of(first + static_cast<std::uint64_t>(i), s); });
  const auto named =
      static_cast<int>(std::count_if(scores.begin(), scores.end(), [](const Score& s) { return !s.found.empty(); }));
  const auto [from, to] = twindeck::blind::exact_interval(named, static_cast<int>(scores.size()));
  fmt::print("noise 30 % larger than declared: a cause named in {}/{} nulls = {:.1f} % [{:.1f}, {:.1f}]\n", named,
             scores.size(), scores.empty() ? 0.0 : 100.0 * named / static_cast<double>(scores.size()), 100.0 * from,
             100.0 * to);
  return held && from <= 0.02 ? 0 : 1;
}

/// Whether every family with a place on the bench was hidden alone at least `least` times, in a line.
bool print_shares(const std::map<std::string, int>& hidden, int least) {
  std::string seldom;
  for (const auto& [family, cases] : hidden)
    if (cases < least) seldom += fmt::format(" {} ({})", family, cases);
  fmt::print("  families hidden alone fewer than {} times:{}  {}\n", least, seldom.empty() ? " none" : seldom,
             seldom.empty() ? "held" : "MISSED");
  return seldom.empty();
}

/// Cases with one cause of known size, each in so many campaigns.
int print_coverage(const twindeck::blind::Bench& bench, int campaigns, const std::vector<std::string>& seeds) {
  int covered = 0, all = 0;
  for (const std::string& seed : seeds) {
    const auto one = twindeck::blind::coverage(bench, std::stoull(seed), campaigns);
    fmt::print("{:>4} of {:>4}  {}\n", one.covered, one.campaigns, one.seal);
    std::fflush(stdout);
    covered += one.covered;
    all += one.campaigns;
  }
  if (all == 0) return 0;
  const auto [from, to] = twindeck::blind::exact_interval(covered, all);
  fmt::print("90 % intervals that hold the size, the cause given: {} of {} = {:.1f} % [{:.1f}, {:.1f}]\n", covered, all,
             100.0 * covered / all, 100.0 * from, 100.0 * to);
  return 0;
}

/// How many families could be named at best, of single causes that were found: what the answers' own probabilities expect, and
/// the rate where no other family has the signature of the hidden one.
void print_what_limits_families(const std::vector<Score>& scores) {
  double expected = 0.0;
  int alone = 0, named = 0;
  for (const Score& s : scores) {
    if (s.kind != "effect" || !s.detected) continue;
    expected += s.family_probability;
    alone += !s.said_by_others;
    named += !s.said_by_others && s.family_named;
  }
  const auto [low, high] = twindeck::blind::exact_interval(named, alone);
  fmt::print(
      "  of these the answers' own probabilities expect {:.1f} families named; where no other family has the signature {} of "
      "{} = {:.1f} % "
      "[{:.1f}, {:.1f}]\n",
      expected, named, alone, alone ? 100.0 * named / alone : 0.0, 100.0 * low, 100.0 * high);
}

/// What `count` trials hide: kinds, families, sizes.
int dry_run(const twindeck::blind::Bench& bench, const std::vector<std::string>& catalogue, int count, std::uint64_t first) {
  std::vector<twindeck::blind::Sealed> seals(static_cast<std::size_t>(count));
  twindeck::parallel_for(count, [&](int i) {
    seals[static_cast<std::size_t>(i)] = twindeck::blind::hide(bench, first + static_cast<std::uint64_t>(i), {}).seal;
  });
  std::map<std::string, int> kinds, hidden;
  for (const std::string& family : catalogue) hidden[family] = 0;
  int strong = 0;
  for (const auto& seal : seals) {
    ++kinds[seal.kind];
    if (seal.kind != "effect") continue;
    ++hidden[seal.families[0]];
    strong += seal.sigma >= 6.0 ? 1 : 0;
  }
  for (const auto& [kind, cases] : kinds) fmt::print("{:<12} {:>4}\n", kind, cases);
  for (const auto& [family, cases] : hidden) fmt::print("  {:<12} {:>4}\n", family, cases);
  fmt::print("{} of the single effects of six standard deviations and more\n", strong);
  return print_shares(hidden, count >= 400 ? 5 : count / 80) ? 0 : 1;
}

/// How often each family was hidden, found, named and in the reported set. @return whether none was hidden too seldom
bool print_families(const std::vector<Score>& scores, const std::vector<std::string>& catalogue) {
  std::map<std::string, std::array<int, 4>> families;
  for (const std::string& family : catalogue) families[family] = {};
  for (const Score& s : scores) {
    auto& f = families[s.kind == "effect" ? s.family : "(" + s.kind + ")"];
    f[0] += 1;
    f[1] += s.detected;
    f[2] += s.kind == "null" ? 0 : s.family_named;
    f[3] += s.in_set;
  }
  fmt::print("\nby family: cases, detected, family named, truth in the reported set\n");
  for (const auto& [family, f] : families) fmt::print("  {:<12} {:>4} {:>4} {:>4} {:>4}\n", family, f[0], f[1], f[2], f[3]);
  std::map<std::string, int> alone;
  for (const std::string& family : catalogue) alone[family] = families[family][0];
  return scores.size() < 400 || print_shares(alone, 5);
}

/// Sizes of the reported sets and what they predict of rows held out. @return whether the sets are small enough, where that is
/// judged
bool print_sets(const std::vector<Score>& scores, twindeck::blind::Judge judge) {
  double sizes = 0.0, squares = 0.0;
  int sets = 0;
  std::vector<double> ratios, with_truth;
  for (const Score& s : scores) {
    if (s.kind != "effect" || !s.detected || s.set_size <= 0) continue;
    sizes += s.set_size;
    squares += s.set_size * s.set_size;
    ++sets;
    ratios.push_back(s.held_out_ratio);
    with_truth.push_back(s.ratio_with_truth);
  }
  if (sets < 2) return true;
  const double mean = sizes / sets, half = 1.96 * std::sqrt(std::max(squares / sets - mean * mean, 0.0) / (sets - 1));
  const bool wrong = mean - half > 1.5 && judge == twindeck::blind::Judge::targets;
  fmt::print("  mean size of the reported set {:.2f} [{:.2f}, {:.2f}], target <= 1.5  {}\n", mean, mean - half, mean + half,
             wrong ? "MISSED" : "held");
  fmt::print(
      "  held-out RMS, after over before, median of {} accepted causes {:.2f}, target <= 0.8; with the truth known {:.2f}\n",
      ratios.size(), median(ratios), median(with_truth));
  return !wrong;
}

void print_seconds(const std::vector<Score>& scores) {
  double seconds = 0.0, slowest = 0.0;
  for (const Score& s : scores) {
    seconds += s.seconds / static_cast<double>(scores.size());
    slowest = std::max(slowest, s.seconds);
  }
  fmt::print("  CPU seconds a trial: mean {:.2f}, largest {:.2f}, target <= 5\n", seconds, slowest);
}

void print_errors_of_sizes(const std::vector<Score>& scores) {
  std::map<std::string, std::vector<double>> errors;
  int limits = 0;
  for (const Score& s : scores) {
    limits += s.sized && s.one_sided;
    if (s.sized && !s.one_sided) errors[s.family].push_back(s.magnitude_error);  // a limit has no size to compare
  }
  fmt::print("median relative error of the magnitude, where the entry is exact:");
  for (const auto& [family, values] : errors) fmt::print(" {} {:.1f} % ({})", family, 100.0 * median(values), values.size());
  fmt::print("; {} more have a limit on one side only\n", limits);
}

/// `count` trials from seed `first` on: run, scored and judged. @return exit code
int score_trials(const twindeck::blind::Bench& bench, const std::vector<std::string>& catalogue, int count,
                 std::uint64_t first) {
  const auto run = [&](std::uint64_t seed) {
    return twindeck::blind::run_case(bench, twindeck::blind::make_case(bench, seed));
  };
  const auto scores = run_all(
      count, [&](int i) { return run(first + static_cast<std::uint64_t>(i)); },
      [&](int i, const Score& s) { return line_of(first + static_cast<std::uint64_t>(i), s); });
  if (static_cast<int>(scores.size()) < count)
    fmt::print("{} of {} trials ran: the first ones in order, none left out\n", scores.size(), count);
  const bool shared_out = print_families(scores, catalogue);
  // Fewer trials settle no target: of 19 effects the family of 16 is named once in six runs of a method that names 93 %.
  const auto judge = scores.size() < 400 ? twindeck::blind::Judge::own_rates : twindeck::blind::Judge::targets;
  fmt::print("\nscore, exact 95 % intervals\n");
  bool held = twindeck::blind::print_scores(twindeck::blind::score_lines(), scores, judge) && shared_out;
  print_what_limits_families(scores);
  held = print_sets(scores, judge) && held;
  print_seconds(scores);
  print_errors_of_sizes(scores);
  if (std::getenv("TWINDECK_FRESH") != nullptr) {
    const std::uint64_t seed = std::random_device{}();
    fmt::print("\none trial with a fresh seed, {}:\n{}\n", seed, line_of(seed, run(seed)));
  }
  const char* what = judge == twindeck::blind::Judge::targets
                         ? "target is missed"
                         : "count is worse than the method's own rate gives in a thousand runs";
  fmt::print("{} {}\n", held ? "no" : "a", what);
  return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGTERM, stop);
  std::signal(SIGINT, stop);
  const bool nulls = argc > 1 && std::string(argv[1]) == "--nulls";
  const int shift = nulls ? 1 : 0;
  const int count = argc > 1 + shift ? std::atoi(argv[1 + shift]) : 60;
  const auto first = static_cast<std::uint64_t>(argc > 2 + shift ? std::atoll(argv[2 + shift]) : nulls ? 100001 : 1);
  const auto bench = twindeck::blind::make_bench();
  const auto catalogue = twindeck::blind::families_of(bench);
  fmt::print("{} rows, truth on {} dofs, diagnosis on {} dofs, {} families have a place here\n", bench.rows.rows.size(),
             bench.truth.model->loaded.system.size(), bench.diagnosing.model->loaded.system.size(), catalogue.size());
  if (argc > 2 && std::string(argv[1]) == "--explain") {
    for (int i = 2; i < argc; ++i) twindeck::blind::explain_case(bench, static_cast<std::uint64_t>(std::atoll(argv[i])));
    return 0;
  }
  if (argc > 3 && std::string(argv[1]) == "--coverage")
    return print_coverage(bench, std::atoi(argv[2]), {argv + 3, argv + argc});
  if (argc > 2 && std::string(argv[1]) == "--count") return dry_run(bench, catalogue, std::atoi(argv[2]), 1);
  if (nulls) return null_calibration(bench, count, first);
  return score_trials(bench, catalogue, count, first);
}
