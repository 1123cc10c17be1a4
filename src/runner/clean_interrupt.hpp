#pragma once

#include <filesystem>

namespace twindeck::runner {

/// During its lifetime, Ctrl-C or a termination removes the partial folder and ends the program by that signal. Earlier results
/// stay unchanged, no partial files remain, and Make or the shell sees the signal. Private to run_step.
class CleanInterrupt {
 public:
  explicit CleanInterrupt(std::filesystem::path partial);
  ~CleanInterrupt();
  CleanInterrupt(const CleanInterrupt&) = delete;
  CleanInterrupt& operator=(const CleanInterrupt&) = delete;
};

}  // namespace twindeck::runner
