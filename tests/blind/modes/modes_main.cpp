/// blind_modes N [first seed [file]]: identifies the records of N random structures by the automatic rule, scores the modes
/// against the truth, prints rates with exact 95 % intervals and writes one row a record. Exit code 1 when an interval lies
/// wholly on the wrong side of its target. blind_modes --explain SEED …: every mode of single records.
/// blind_modes --poles SEED HZ: the poles of all orders near a frequency.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>

#include "blind/modes/mode_score.hpp"
#include "core/parallel.hpp"
#include "io/csv.hpp"

namespace {

using namespace twindeck;
using namespace twindeck::blind::modes;

struct Scored {
  RandomRecords truth;  ///< without its records
  ModeScore score;
  std::size_t found = 0;
  double seconds = 0.0;
};

Scored scored(std::uint64_t seed) {
  const auto begin = std::chrono::steady_clock::now();
  Scored result;
  result.truth = random_records(seed);
  const IdentifiedRecords found = identify_records(result.truth);
  result.score = score(result.truth, found);
  result.found = found.modes.size();
  for (TrueSetup& setup : result.truth.setups) setup.record.resize(0, 0);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::string line_of(const Scored& s) {
  const RandomRecords& t = s.truth;
  return fmt::format(
      "{:>6} {:>2} modes, closest {:>4.1f} %  {:>2} channels, {} setup{}  {:>4.1f} min  {:>2.0f} dB  {:<5} {} | settled {:>2}, "
      "found "
      "{:>2}, spurious {}, lines {}/{}  {:.1f} s",
      t.seed, t.modes.size(), t.closest_pct, t.n_channels, t.setups.size(), t.setups.size() == 1 ? " " : "s", t.minutes,
      t.noise_dB, t.excitation, t.moving > 0.0 ? "moving" : "      ", s.score.settled, s.score.recalled,
      s.score.spurious.size(), s.score.flagged, t.machine_Hz.size(), s.seconds);
}

void write_csv(const std::vector<Scored>& all, const std::filesystem::path& file) {
  io::CsvWriter csv({"seed", "modes", "closest_pair_pct", "channels", "setups", "duration_min", "noise_dB", "excitation",
                     "moving_share", "machine_lines", "settled", "recalled", "alike", "found", "spurious", "lines_marked",
                     "frequency_error_squared", "damping_error_squared", "time_s"});
  const auto squares = [](const std::vector<double>& errors) {
    double sum = 0.0;
    for (const double e : errors) sum += e * e;
    return sum;
  };
  for (const Scored& s : all) {
    const RandomRecords& t = s.truth;
    csv.row({std::to_string(t.seed), t.modes.size(), t.closest_pct, static_cast<std::size_t>(t.n_channels), t.setups.size(),
             t.minutes, t.noise_dB, t.excitation, t.moving, t.machine_Hz.size(), s.score.settled, s.score.recalled,
             s.score.alike, s.found, s.score.spurious.size(), s.score.flagged, squares(s.score.frequency_error),
             squares(s.score.damping_error), s.seconds});
  }
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  csv.save(file);
}

void explain(std::uint64_t seed) {
  const RandomRecords truth = random_records(seed);
  const IdentifiedRecords found = identify_records(truth);
  const ModeScore s = score(truth, found);
  const auto describe = [&](std::size_t m) {
    const identification::MergedMode& mode = found.modes[m];
    std::string text = fmt::format("{:.4f} Hz +- {:.4f}  {:.2f} % +- {:.2f}", mode.frequency_Hz, mode.deviation.frequency_Hz,
                                   100.0 * mode.damping_ratio, 100.0 * mode.deviation.damping_ratio);
    for (const auto& [setup, at] : mode.members) {
      const identification::Identification& one = found.setups[setup];
      const auto& members = one.modes[at].members;
      text += fmt::format("  S{}: {:.4f} {} orders {}-{}", setup + 1, one.modes[at].frequency_Hz, members.size(),
                          one.diagram[members.front()].pole.order, one.diagram[members.back()].pole.order);
      if (found.setups.size() == 1) continue;
      // The shape of this setup alone beside the true ones that are near.
      for (const TrueMode& near : truth.modes) {
        if (std::abs(near.frequency_Hz / mode.frequency_Hz - 1.0) < 0.02)
          text += fmt::format(" ({:.4f} {:.2f})", near.frequency_Hz,
                              known_mac(near.shape(truth.setups[setup].channels), one.modes[at].shape));
      }
    }
    return text;
  };
  fmt::print("{}\n", line_of({truth, s, found.modes.size(), 0.0}));
  for (std::size_t r = 0; r < truth.modes.size(); ++r) {
    const ModeOutcome& outcome = s.modes[r];
    fmt::print("  {:.4f} Hz {:.2f} %  {} {:.4f}  MAC {:.3f}  {}{}\n", truth.modes[r].frequency_Hz,
               100.0 * truth.modes[r].damping_ratio, outcome.settled ? "settled" : "open   ",
               outcome.settled ? outcome.oracle_std_Hz : 0.0, outcome.mac,
               outcome.found >= 0 ? describe(static_cast<std::size_t>(outcome.found)) : "-",
               outcome.settled && !outcome.recalled() ? "  MISSED" : "");
  }
  for (const int m : s.spurious) {
    fmt::print("  spurious: {}", describe(static_cast<std::size_t>(m)));
    for (const TrueMode& mode : truth.modes) {
      const identification::MergedMode& one = found.modes[static_cast<std::size_t>(m)];
      if (std::abs(mode.frequency_Hz / one.frequency_Hz - 1.0) < 0.08)
        fmt::print("  [{:.3f} Hz MAC {:.2f}]", mode.frequency_Hz, known_mac(mode.shape, one.shape));
    }
    fmt::print("\n");
  }
  for (const double f : truth.machine_Hz) fmt::print("  line {:.4f} Hz{}\n", f, truth.machine_wanders ? " wanders" : "");
  for (const identification::Identification& setup : found.setups) {
    for (const identification::PeriodicLine& line : setup.periodic)
      fmt::print("  marked {:.4f} Hz {:.3f} % kurtosis {:.2f} multiple {}\n", line.frequency_Hz, 100.0 * line.damping_ratio,
                 line.kurtosis, line.multiple);
  }
}

// Every pole near a frequency, order by order, with the true mode that its shape is nearest to.
void print_poles(std::uint64_t seed, double f_Hz) {
  const RandomRecords truth = random_records(seed);
  const IdentifiedRecords found = identify_records(truth);
  constexpr double kReach = 0.08;  // of the frequency
  for (std::size_t s = 0; s < found.setups.size(); ++s) {
    const auto& channels = truth.setups[s].channels;
    fmt::print("setup S{}\n order       f_Hz  std_Hz  damping_pct  mode  MAC to the true modes near\n", s + 1);
    for (const identification::DiagramPole& p : found.setups[s].diagram) {
      if (std::abs(p.pole.frequency_Hz / f_Hz - 1.0) > kReach) continue;
      fmt::print("{:>6} {:>10.4f} {:>7.4f} {:>12.2f} {:>5} ", p.pole.order, p.pole.frequency_Hz, p.frequency_std_Hz,
                 100.0 * p.pole.damping_ratio, p.mode);
      for (const TrueMode& mode : truth.modes) {
        if (std::abs(mode.frequency_Hz / f_Hz - 1.0) > kReach) continue;
        const Eigen::VectorXd shape = mode.shape(channels).cwiseQuotient(found.scale[s]);
        fmt::print(" {:.4f}: {:.2f}", mode.frequency_Hz, known_mac(shape, p.pole.shape));
      }
      fmt::print("\n");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string(argv[1]) == "--explain") {
    for (int i = 2; i < argc; ++i) explain(std::strtoull(argv[i], nullptr, 10));
    return 0;
  }
  if (argc == 4 && std::string(argv[1]) == "--poles") {
    print_poles(std::strtoull(argv[2], nullptr, 10), std::strtod(argv[3], nullptr));
    return 0;
  }
  const int count = argc > 1 ? std::atoi(argv[1]) : 20;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  // Results in the order of the seeds, whatever thread is done first.
  std::vector<std::optional<Scored>> done(static_cast<std::size_t>(std::max(count, 0)));
  std::mutex printing;
  std::size_t printed = 0;
  parallel_for(count, [&](int i) {
    Scored one = scored(first + static_cast<std::uint64_t>(i));
    const std::scoped_lock lock(printing);
    done[static_cast<std::size_t>(i)] = std::move(one);
    for (; printed < done.size() && done[printed]; ++printed) fmt::print("{}\n", line_of(*done[printed]));
    std::fflush(stdout);
  });
  std::vector<Scored> all;
  ModeTotals totals;
  for (auto& one : done) {
    totals.add(one->truth, one->score);
    all.push_back(std::move(*one));
  }
  if (argc > 3) write_csv(all, argv[3]);
  fmt::print("\n{} records, seeds {} to {}; exact 95 % intervals\n", totals.records, first, first + all.size() - 1);
  const bool held = print_totals(totals);
  fmt::print("{}\n", held ? "no target is missed beyond chance" : "a target is missed");
  return held ? 0 : 1;
}
