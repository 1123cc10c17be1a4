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
  ::signal(SIGPIPE, handler == SIG_DFL ? SIG_IGN : handler);
}

void end_by(int number, const std::filesystem::path& partial) {
  const auto nothing_is_published = io::abandon_partial(partial);
  constexpr int failed_write = 2;
  if (number == SIGPIPE) ::_exit(failed_write);  // whoever read what is printed has gone, and a line cannot be read either
  ::signal(number, SIG_DFL);
  ::kill(::getpid(), number);
  ::pause();  // until the signal ends the program
}

}  // namespace

CleanInterrupt::CleanInterrupt(std::filesystem::path partial) {
  if (::pipe2(g_pipe.data(), O_CLOEXEC) != 0) return;
  g_watcher = std::thread([partial = std::move(partial)] {
    unsigned char byte = 0;
    std::error_code ignored;
    // Without results that are being written, a progress line that nobody reads ends nothing.
    while (::read(g_pipe[0], &byte, 1) < 0 || (byte == SIGPIPE && !std::filesystem::exists(partial, ignored))) {
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
