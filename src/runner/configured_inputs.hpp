#pragma once

#include <string>

#include "runner/run_step.hpp"

namespace twindeck::runner {

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
