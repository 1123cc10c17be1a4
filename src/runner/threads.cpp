#include "runner/threads.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <latch>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "linalg/one_thread.hpp"

namespace twindeck::runner {
namespace {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

constexpr std::string_view kOneThread = "OPENBLAS_NUM_THREADS=1",
                           kChoice = "OPENBLAS_CORETYPE=", kKernels = "OPENBLAS_CORETYPE=Haswell";

bool sets_threads_of_libraries(std::string_view entry) {
  return entry.starts_with("OPENBLAS_NUM_THREADS=") || entry.starts_with("OMP_STACKSIZE=") ||
         entry.starts_with("GOMP_STACKSIZE=");
}

/// Whether the processor has the instructions of kKernels.
bool has_kernels() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// Replaces this process by the same program in an environment where OpenBLAS starts no threads, takes the same kernels on
/// every processor that has them, and OpenMP's threads have the stacks that the system gives. OpenBLAS does both when it is
/// loaded, before main. Its threads are never used, and at the end of a process whose memory is limited they wait for memory
/// without end. Its own choice of kernels moves last digits, and on a processor that is newer than it those of 2004 are taken.
/// Called before any library is initialised; costs some milliseconds, and the number of the process stays. Where the program
/// cannot be started again, it goes on as it is.
void start_with_blas_set(int, char** arguments, char** environment) {
  bool is_set = false, others = false, has_choice = !has_kernels();
  std::vector<char*> wanted;
  for (char** entry = environment; *entry != nullptr; ++entry) {
    const bool dropped = sets_threads_of_libraries(*entry);
    (std::string_view(*entry) == kOneThread ? is_set : others) |= dropped;
    has_choice |= std::string_view(*entry).starts_with(kChoice);
    if (!dropped) wanted.push_back(*entry);
  }
  if (is_set && !others && has_choice) return;
  wanted.push_back(const_cast<char*>(kOneThread.data()));
  if (!has_choice) wanted.push_back(const_cast<char*>(kKernels.data()));
  wanted.push_back(nullptr);
  std::array<char, 4096> program{};  // its own name, under which the system lists the process
  if (::readlink("/proc/self/exe", program.data(), program.size() - 1) > 0) ::execve(program.data(), arguments, wanted.data());
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const g_before_libraries)(int, char**, char**) = &start_with_blas_set;

#endif

/// @return [bytes] 0 where there is no limit
rlim_t limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : 0;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& mend) {
  throw InputError({"command line", 0, "--threads"}, problem, mend);
}

constexpr rlim_t kilobyte = 1024;           ///< [bytes]
constexpr rlim_t kStack = 1024 * kilobyte;  ///< [bytes] the least; products of small matrices take up to 128 kB at a time

/// Lets the system map the main thread's stack now: where memory is limited, a stack that grows later ends the program.
[[gnu::noinline]] void take_stack() {
  std::array<volatile char, kStack / 2> block;
  constexpr std::size_t page = 4096;  // [bytes]
  for (std::size_t at = 0; at < block.size(); at += page) block[at] = 0;
}

void check_stack() {
  const rlim_t stack = limit_of(RLIMIT_STACK);
  if (stack == 0 || stack >= kStack) return take_stack();
  refuse(fmt::format("the stack is limited to {} kB, expected at least {} kB", stack / kilobyte, kStack / kilobyte),
         "run it where 'ulimit -s' says 8192, which systems start with");
}

/// A step that finds too few open files while it writes could not remove what it has begun either.
void check_open_files() {
  constexpr std::size_t needed = 16;  // at once: a table, a record and what it includes, and the folders of a removal
  std::vector<int> opened;
  for (int file = 0; opened.size() < needed && (file = ::open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0;) opened.push_back(file);
  const bool too_few = opened.size() < needed && errno == EMFILE;
  for (const int file : opened) ::close(file);
  if (too_few)
    throw InputError({"command line", 0, ""},
                     fmt::format("this shell allows {} more open files, expected at least {}", opened.size(), needed),
                     "raise the limit: ulimit -n 256");
}

/// The system may allow fewer threads than asked for. OpenMP would end the program when it finds that out.
void check_threads(int threads) {
  std::latch all_asked(1);
  std::vector<std::jthread> team;
  try {
    for (int k = 1; k < threads; ++k) team.emplace_back([&all_asked] { all_asked.wait(); });
  } catch (const std::system_error& error) {
    all_asked.count_down();
    refuse(fmt::format("the system allows {} threads, {} are asked for ({})", team.size() + 1, threads, error.code().message()),
           "give --threads 1, or raise the limit (ulimit -u, ulimit -v)");
  }
  all_asked.count_down();
}

}  // namespace

int set_threads(int asked) {
  int threads = asked > 0 ? asked : processor_count();
  if (const rlim_t memory = limit_of(RLIMIT_AS); asked <= 0 && memory > 0) {  // half of it is for the data
    threads = std::clamp(static_cast<int>(std::min<rlim_t>(memory / 2 / linalg::blas_memory_bytes, 1024)), 1, threads);
  }
  check_open_files();
  check_stack();
  check_threads(threads);
  linalg::use_one_thread();
  if (!linalg::reserve_blas_memory(threads)) {
    constexpr std::size_t megabyte = 1000000;
    const std::size_t needed = static_cast<std::size_t>(threads) * linalg::blas_memory_bytes / megabyte;
    refuse(fmt::format("needs {} MB of memory for {} thread{} of BLAS, which this process may not use", needed, threads,
                       threads == 1 ? "" : "s"),
           threads == 1 ? "raise the limit (ulimit -v)" : "give --threads 1, or raise the limit (ulimit -v)");
  }
  set_thread_count(threads);
  return threads;
}

}  // namespace twindeck::runner
