#include "runner/clean_interrupt.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "io/atomic.hpp"

namespace twindeck::runner {
namespace {

// A handler may do next to nothing, so it writes the signal's number into a pipe; a thread that may do anything reads it.
std::array<int, 2> g_pipe{-1, -1};
std::thread g_watcher;

void on_signal(int number) {
  const auto byte = static_cast<unsigned char>(number);
  [[maybe_unused]] const ssize_t written = ::write(g_pipe[1], &byte, 1);
}

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    ::sigaction(number, nullptr, &present);
    if (present.sa_handler == SIG_IGN) continue;  // nohup and background jobs stay as they were started
    ::sigaction(number, &action, nullptr);
  }
}

void end_by(int number, const std::filesystem::path& partial) {
  const auto nothing_is_published = io::abandon_partial(partial);
  ::signal(number, SIG_DFL);
  ::kill(::getpid(), number);
  ::pause();  // until the signal ends the program
}

}  // namespace

CleanInterrupt::CleanInterrupt(std::filesystem::path partial) {
  if (::pipe2(g_pipe.data(), O_CLOEXEC) != 0) return;
  g_watcher = std::thread([partial = std::move(partial)] {
    unsigned char byte = 0;
    while (::read(g_pipe[0], &byte, 1) < 0) {
    }
    if (byte != 0) end_by(byte, partial);
  });
  install(&on_signal);
}

CleanInterrupt::~CleanInterrupt() {
  if (!g_watcher.joinable()) return;
  install(SIG_DFL);
  on_signal(0);  // lets the watcher end
  g_watcher.join();
  for (int& end : g_pipe) {
    ::close(end);
    end = -1;
  }
}

}  // namespace twindeck::runner
