/// blind_form N [first seed [file.csv]]: sealed trials whose truth is of another model class than the model that diagnoses it
/// (docs/rates.md section 1). From 400 trials on each line is judged by its point estimate, and a tenth as many trials with
/// a form error of 4 % are shown beside: exit code 1 when a line is missed. Fewer trials are held against the method's own
/// rates. blind_form --count N [first seed]: what N trials hide and how far their form errors reach, without a diagnosis.
/// A run's last two words --held FILE hold the numbers of its diagnoses against a file (exit code 1 when one moved), --hold
/// FILE writes the file anew. blind_form --explain SEED …: the form, its main features and the evidence of single trials.
/// TWINDECK_BLIND_SECONDS: no trial starts after so many seconds; the table is of those that ran.
/// Seeds 9000 to 9099 were looked at while the bench was written: they count for nothing.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "blind/form/form_table.hpp"
#include "core/parallel.hpp"

namespace twindeck::blind::form {

namespace {

constexpr double kBeside = 0.04;  ///< form error that is shown beside the others
constexpr int kJudged = 400;      ///< trials from which on targets are judged

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

FormScore run_one(std::uint64_t seed, std::optional<double> level) {
  const double begin = cpu_seconds();
  const FormCase hidden = make_form_case(seed, level);
  const double made = cpu_seconds() - begin;
  FormScore score = prepare_score(hidden);
  try {
    run_form_case(hidden, score);
  } catch (
      const std::exception& error) {  // a diagnosis that ends without an answer is one of the worst, and the other trials go on
    score.verdict = "failed";
    score.found = error.what();
  }
  score.seconds_made = made;
  return score;
}

/// Trials in the order of their seeds, side by side; those that started in time.
std::vector<FormScore> run_all(int count, std::uint64_t first, std::optional<double> level, double seconds) {
  std::vector<std::optional<FormScore>> done(static_cast<std::size_t>(count));
  std::size_t printed = 0;
  std::mutex printing;
  const auto begin = std::chrono::steady_clock::now();
  parallel_for(count, [&](int i) {
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > seconds) return;
    FormScore score = run_one(first + static_cast<std::uint64_t>(i), level);
    const std::scoped_lock lock(printing);
    done[static_cast<std::size_t>(i)] = std::move(score);
    for (; printed < done.size() && done[printed]; ++printed) fmt::print("{}\n", line_of(*done[printed]));
    std::fflush(stdout);
  });
  std::vector<FormScore> scores;
  for (const auto& s : done) {
    if (!s) break;
    scores.push_back(*s);
  }
  return scores;
}

int count_only(int count, std::uint64_t first) {
  std::vector<std::string> lines(static_cast<std::size_t>(count));
  parallel_for(count, [&](int i) {
    const FormCase c = make_form_case(first + static_cast<std::uint64_t>(i));
    lines[static_cast<std::size_t>(i)] = fmt::format(
        "{:>5} {:<22} {:<22} {:<17} form {:.1f} % reached {:.2f} %, shapes {:.1f} %, least MAC {:.2f}, severity {:.3f} after "
        "{} draws, sigma {:>6.1f}, {} "
        "conditions, {} rows | {}",
        c.seed, name_of(c.hidden.turn.category), c.hidden.turn.family, name_of(c.hidden.turn.kind), 100.0 * c.hidden.turn.level,
        100.0 * c.calibrated.reached, 100.0 * c.calibrated.shape, c.calibrated.least_mac, c.calibrated.form.severity,
        c.calibrated.draws, c.sigma, c.features.conditions.size(), c.features.rows.size(), c.hidden.words);
  });
  for (const std::string& line : lines) fmt::print("{}\n", line);
  return 0;
}

int run(int count, std::uint64_t first, const std::string& csv, const Holding& holding) {
  const char* budget = std::getenv("TWINDECK_BLIND_SECONDS");
  std::vector<FormScore> scores = run_all(count, first, {}, budget ? std::atof(budget) : 1e9);
  if (static_cast<int>(scores.size()) < count)
    fmt::print("{} of {} trials ran in the time given: the first ones in order, none left out\n", scores.size(), count);
  fmt::print("\nby family: trials, named or ambiguous, truth in the set, unknown\n");
  print_families(scores);
  fmt::print("\nscore, exact 95 % intervals; form errors of 0.5, 1 and 2 %\n");
  const bool held = print_form_lines(scores);
  double seconds = 0.0, slowest = 0.0, made = 0.0;
  for (const FormScore& s : scores) {
    seconds += s.seconds / static_cast<double>(scores.size());
    made += s.seconds_made / static_cast<double>(scores.size());
    slowest = std::max(slowest, s.seconds);
  }
  fmt::print("  CPU seconds a diagnosis: mean {:.2f}, largest {:.2f}; a truth takes {:.2f}\n", seconds, slowest, made);
  const bool judged = count >= kJudged && static_cast<int>(scores.size()) == count;
  std::vector<FormScore> all = scores;
  if (judged) {
    fmt::print("\nbeside them, form error {:.0f} %\n", 100.0 * kBeside);
    for (FormScore& s : run_all(count / 10, first + static_cast<std::uint64_t>(count), kBeside, 1e9))
      all.push_back(std::move(s));
  }
  fmt::print("\nby form error\n");
  print_by_level(all);
  if (!csv.empty()) write_form_csv(all, csv);
  std::vector<HeldNumber> numbers;
  for (const FormScore& s : scores) numbers.insert(numbers.end(), s.numbers.begin(), s.numbers.end());
  const bool held_numbers = holding.done(numbers), sound = few_are_sound(scores) && held_numbers;
  if (judged) fmt::print("{}\n", held ? "every line is held" : "a line is missed");
  return (judged ? held && sound : sound) ? 0 : 1;
}

}  // namespace

}  // namespace twindeck::blind::form

int main(int argc, char** argv) {
  using namespace twindeck::blind::form;
  const twindeck::blind::Holding holding = twindeck::blind::holding_of(argc, argv);
  if (argc > 2 && std::string(argv[1]) == "--explain") {
    for (int i = 2; i < argc; ++i) explain_form_case(static_cast<std::uint64_t>(std::atoll(argv[i])));
    return 0;
  }
  const bool counting = argc > 1 && std::string(argv[1]) == "--count";
  const int shift = counting ? 1 : 0;
  const int count = argc > 1 + shift ? std::atoi(argv[1 + shift]) : 20;
  const auto first = static_cast<std::uint64_t>(argc > 2 + shift ? std::atoll(argv[2 + shift]) : 1);
  if (count < 1) {
    fmt::print(stderr, "blind_form: '{}' is no number of trials, expected 1 or more\n", argv[1 + shift]);
    return 2;
  }
  if (counting) return count_only(count, first);
  return run(count, first, argc > 3 ? argv[3] : "", holding);
}
