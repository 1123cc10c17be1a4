#pragma once

#include <filesystem>

namespace twindeck::steps {

/// While it lives, Ctrl-C or a termination removes the partial folder and ends the program by that signal, so that earlier
/// results stay whole, nothing half-written is left, and Make or the shell sees what happened. Private to run_step.
class CleanInterrupt {
 public:
  explicit CleanInterrupt(std::filesystem::path partial);
  ~CleanInterrupt();
  CleanInterrupt(const CleanInterrupt&) = delete;
  CleanInterrupt& operator=(const CleanInterrupt&) = delete;
};

}  // namespace twindeck::steps
