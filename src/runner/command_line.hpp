#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/run_step.hpp"

namespace twindeck::runner {

/// The parsed command line. Private to run_step.
struct CommandLine {
  enum class Action { run, print, help, version, print_config, describe };
  Action action = Action::run;
  std::string text;  ///< of help and version: what to print; of describe: the key, "" for all
  std::filesystem::path study, out, results;
  std::optional<std::filesystem::path> model, campaign, modes, features;
  std::optional<std::uint64_t> seed;
  int threads = 0;  ///< 0: one per processor
  bool quiet = false;
  bool accept_unconverged = false;
  bool check = false;
  std::vector<std::string> sets;                           ///< key=value, in order
  std::vector<std::pair<std::string, std::string>> flags;  ///< step-specific options: name without dashes, value
};

/// @throws InputError  for anything that is wrong on the command line; place is the option
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const Step& step);

/// Folders that a step reads, as named in its configuration; --model and --campaign take precedence. A study then names the
/// inputs of its steps once, and a step run by hand gives the same result as through make. Private to run_step.
class ConfiguredInputs {
 public:
  /// Binds the keys that `step.configured_inputs` lists to its configuration. Must outlive the step's fields.
  explicit ConfiguredInputs(Step& step);
  ConfiguredInputs(const ConfiguredInputs&) = delete;
  ConfiguredInputs& operator=(const ConfiguredInputs&) = delete;

  /// Sets the context's folders that the command line has left open.
  /// @throws InputError  with file and key, for a missing folder
  void apply(const Step& step, StepContext& context) const;

 private:
  std::string model_, campaign_;
};

}  // namespace twindeck::runner
