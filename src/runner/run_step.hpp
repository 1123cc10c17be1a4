#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/reporter.hpp"
#include "io/config.hpp"
#include "io/text_lines.hpp"

/// Room runner: the program round every step. It takes the command line, the study's settings and what a step is (`Step`: its
/// keys, its options, how it reads, what it computes). It gives a run with one contract for all of them: options, exit codes,
/// manifest, results that appear as a whole or not at all, and what people see while it works.
namespace twindeck::runner {

/// Input of a step. Files are written into `out`, a temporary folder that replaces the earlier results only when the step has
/// finished.
class StepContext : public Reporter {
 public:
  std::filesystem::path study;    ///< workflows/<study>; empty when the step runs on a user's own data
  std::filesystem::path results;  ///< root that inputs of earlier steps are read from: results/<study>
  std::filesystem::path out;      ///< where to write (temporary); empty while the inputs are read
  std::optional<std::filesystem::path> model, campaign, modes, features;  ///< --model DIR …
  std::optional<std::string> flag(const std::string& name) const;         ///< step-specific options
  bool has_flag(const std::string& name) const;
  int threads = 1;
  std::uint64_t seed = 0;
  bool quiet = false;

  /// Registers a file, or every file of a folder, as an input for the manifest, checks it against its own step's manifest,
  /// returns it.
  /// @param most_bytes   of a deck, a table or a configuration, which are read whole
  /// @throws InputError  for a longer file, before any of it is read
  std::filesystem::path input(const std::filesystem::path& path, std::uintmax_t most_bytes = io::longest_text);
  /// The same for a record, which is read in parts and may have any length.
  std::filesystem::path record(const std::filesystem::path& path);
  /// The path that a configuration names: "{results}/…" lies below --results, other paths are relative to the current folder.
  [[nodiscard]] std::filesystem::path resolved(const std::string& path) const;
  /// A line for people on stderr, prefixed with the step's token; nothing with --quiet. What is said while the inputs are read
  /// is kept in the manifest too, whatever is quiet.
  void say(const std::string& line) const override;
  /// A doubtful input that the step uses unchanged: printed as "warning: …", except with --quiet, and kept in the manifest.
  void warn(const std::string& line) override;
  /// Progress with remaining time on anything over two seconds (terminal: one line rewritten; otherwise a line every ten
  /// seconds).
  void progress(const std::string& what, double done, double total) const override;

  std::map<std::string, std::string> input_hashes_;  ///< path as given -> SHA-256 when it was registered
  std::vector<std::string> warnings_;
  mutable std::vector<std::string> notes_;  ///< said while the inputs were read
  std::vector<std::string> corrections_;    ///< of --correct, in words
  std::vector<std::pair<std::string, std::string>> flags_;
  std::string token_;
};

/// What a step does once its inputs are read: it solves, and writes into StepContext::out.
using Computation = std::function<Status()>;

/// A step-specific option of the command line.
struct Flag {
  std::string name;
  bool takes_value = false;
  std::string meaning;
  /// If set: what the option prints on stdout instead of running the step (no --out is needed then).
  std::function<std::vector<std::string>(const std::string& value)> instead = {};
};

/// Description of a step, which its `main` passes to run_step.
struct Step {
  std::string token;                  ///< "s6_updating"
  std::string summary;                ///< one sentence
  std::vector<std::string> examples;  ///< at least two full command lines
  io::FieldTable fields;              ///< bound to the step's configuration struct
  /// Folders that the configuration may name too: "model", "campaign". The command line takes precedence.
  std::vector<std::string> configured_inputs;
  std::vector<Flag> flags;
  /// Reads and validates all inputs, and returns the computation on them. It solves and writes nothing: --check ends after it.
  std::function<Computation(StepContext&)> read;
};

/// The command line contract of every step: --study --out --results --threads --set --seed --quiet --model --campaign
/// --modes --features --accept-unconverged --check --help --version --print-config --describe [key]. Reads
/// <study>/<token>.toml if it exists, runs, writes manifest.json last and renames. Exit codes: 0 done, 1 not converged (written
/// to <out>.unconverged), 2 bad input, 3 our own mistake; each failure is one line on stderr.
int run_step(int argc, char** argv, Step step);

}  // namespace twindeck::runner
