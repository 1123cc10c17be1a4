#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "runner/run_step.hpp"

namespace twindeck::runner {

/// Says that a step works on while it reports nothing else: "s9_diagnosis: working, 12 s so far", on a terminal from two
/// seconds of silence on, in one line that is rewritten; otherwise a line every half minute of silence. Nothing with --quiet.
/// Lives as long as the computation.
class Heartbeat {
 public:
  explicit Heartbeat(const StepContext& context);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void beat(const std::string& token);

  std::mutex mutex_;
  std::condition_variable over_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace twindeck::runner
