#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>

#include "core/printable.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {
namespace {

using Clock = std::chrono::steady_clock;

struct Activity {
  Clock::time_point start = Clock::now();
  Clock::time_point shown = start;
  bool on_screen = false;
};

/// One lock for all that goes to stderr: `run` may report from several threads.
std::mutex& screen() {
  static std::mutex mutex;
  return mutex;
}

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

}  // namespace

void StepContext::say(const std::string& line) const {
  if (quiet) return;
  const std::lock_guard lock(screen());
  const char* clear = ::isatty(STDERR_FILENO) ? "\r\033[K" : "";  // a progress line may stand there
  std::fputs(fmt::format("{}{}: {}\n", clear, token_, printable(line)).c_str(), stderr);
}

void StepContext::warn(const std::string& line) {
  warnings_.push_back(line);
  say("warning: " + line);
}

void StepContext::progress(const std::string& what, double done, double total) const {
  if (quiet || !(total > 0.0)) return;
  static std::map<std::string, Activity> activities;
  const std::lock_guard lock(screen());
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  Activity& activity = activities[what];
  const double elapsed = seconds_since(activity.start);
  if (done >= total) {
    if (activity.on_screen && terminal) std::fputs("\r\033[K", stderr);
    activities.erase(what);
    return;
  }
  if (elapsed < 2.0 || seconds_since(activity.shown) < (terminal ? 0.2 : 10.0)) return;
  const double left = done > 0.0 ? elapsed * (total - done) / done : 0.0;
  const std::string text = fmt::format("{}: {} {:.0f} %{}", token_, what, 100.0 * done / total,
                                       done > 0.0 ? fmt::format(", about {:.0f} s left", left) : "");
  std::fputs((terminal ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  activity.shown = Clock::now();
  activity.on_screen = true;
}

}  // namespace twindeck::steps
