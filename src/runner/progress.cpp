#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>

#include "core/printable.hpp"
#include "runner/heartbeat.hpp"
#include "runner/run_step.hpp"

namespace twindeck::runner {
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

/// When something was last written to stderr; behind screen().
Clock::time_point& last_written() {
  static Clock::time_point at = Clock::now();
  return at;
}

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

}  // namespace

void StepContext::say(const std::string& line) const {
  const std::lock_guard lock(screen());
  if (out.empty() && (warnings_.empty() || line != "warning: " + warnings_.back())) notes_.push_back(line);
  if (quiet) return;
  const char* clear = ::isatty(STDERR_FILENO) ? "\r\033[K" : "";  // a progress line may stand there
  std::fputs(fmt::format("{}{}: {}\n", clear, token_, printable(line)).c_str(), stderr);
  last_written() = Clock::now();
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
  const std::string text = fmt::format("{}: {}, {:.0f} of {:.0f}{}", token_, what, done, total,
                                       done > 0.0 ? fmt::format(", about {:.0f} s left", left) : "");
  std::fputs((terminal ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  activity.shown = last_written() = Clock::now();
  activity.on_screen = true;
}

Heartbeat::Heartbeat(const StepContext& context) {
  if (context.quiet) return;
  // Signals are for the thread that computes.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this, token = context.token_] { beat(token); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  over_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Heartbeat::beat(const std::string& token) {
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  const double silence_s = terminal ? 2.0 : 30.0;
  constexpr auto look = std::chrono::milliseconds(500);
  const Clock::time_point start = Clock::now();
  bool on_screen = false;
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, look, [this] { return ended_; })) {
    const std::lock_guard writing(screen());
    // The line of its own is rewritten at every look.
    if (seconds_since(last_written()) < silence_s) {
      on_screen = false;
      continue;
    }
    const std::string text = fmt::format("{}: working, {:.0f} s so far", token, seconds_since(start));
    std::fputs((terminal ? "\r\033[K" + text : text + "\n").c_str(), stderr);
    std::fflush(stderr);
    if (!terminal) last_written() = Clock::now();
    on_screen = terminal;
  }
  if (on_screen) std::fputs("\r\033[K", stderr);
}

}  // namespace twindeck::runner
