#pragma once

#include <string>

#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// Folders that a step reads, as its configuration names them: what --model and --campaign say goes before them. So a study says once
/// what its steps work on, and a step run by hand gives the same as through make. Private to run_step.
class ConfiguredInputs {
 public:
  /// Binds the keys that `step.configured_inputs` lists to its configuration. Must outlive the step's fields.
  explicit ConfiguredInputs(Step& step);
  ConfiguredInputs(const ConfiguredInputs&) = delete;
  ConfiguredInputs& operator=(const ConfiguredInputs&) = delete;

  /// Sets the context's folders that the command line has left open.
  /// @throws InputError  naming file and key, for a folder that is not there
  void apply(const Step& step, StepContext& context) const;

 private:
  std::string model_, campaign_;
};

}  // namespace twindeck::steps
