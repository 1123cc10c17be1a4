#include "records/survives.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace twindeck::records {

namespace {

/// What the child does in place of the caller: no handlers of its own (a step's would clean up its results), no core file, an
/// end after a minute.
[[noreturn]] void do_and_end(const std::function<void()>& work) {
  constexpr unsigned most_s = 60;  // to look through a file takes milliseconds
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGALRM})
    std::signal(number, SIG_DFL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::alarm(most_s);
  try {
    work();
  } catch (...) {
  }
  ::_exit(0);
}

}  // namespace

bool survives(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) do_and_end(work);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return true;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace twindeck::records
