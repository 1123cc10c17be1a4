#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#ifdef TWINDECK_STD_THREADS
#include <system_error>
#include <thread>
#include <vector>
#else
#include <omp.h>
#endif

// The one file with a parallel region. TWINDECK_STD_THREADS replaces OpenMP's threads, which ThreadSanitizer does not
// understand, by those of the standard library.
namespace twindeck {
namespace {

/// The exception of the lowest index that has thrown.
class FirstFailure {
 public:
  /// Whether work on i can still matter: nothing below it has thrown.
  [[nodiscard]] bool concerns(std::ptrdiff_t i) const { return i < lowest_.load(std::memory_order_relaxed); }
  void keep(std::ptrdiff_t i, std::exception_ptr thrown) {
    const std::scoped_lock lock(mutex_);
    if (!concerns(i)) return;
    lowest_.store(i, std::memory_order_relaxed);
    thrown_ = std::move(thrown);
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::mutex mutex_;
  std::atomic<std::ptrdiff_t> lowest_ = PTRDIFF_MAX;
  std::exception_ptr thrown_;
};

struct Loop {
  std::ptrdiff_t count, chunk;
  void (*work)(void*, int, std::ptrdiff_t);
  void* context;
  FirstFailure failure = {};
  std::atomic<std::ptrdiff_t> next = 0;

  /// What each thread does: it takes the next indices until none is left.
  void run(int thread) {
    for (std::ptrdiff_t from = next.fetch_add(chunk); from < count; from = next.fetch_add(chunk)) {
      const std::ptrdiff_t to = std::min(count, from + chunk);
      for (std::ptrdiff_t i = from; i < to && failure.concerns(i); ++i) {
        try {
          work(context, thread, i);
        } catch (...) {  // must not leave the thread
          failure.keep(i, std::current_exception());
        }
      }
    }
  }
};

#ifdef TWINDECK_STD_THREADS

std::atomic<int> g_threads = 0;
thread_local bool t_within = false;  ///< this thread works for a parallel_for

bool within() { return t_within; }

void run_team(Loop& loop, int threads) {
  const auto member = [&loop](int thread) {
    t_within = true;
    loop.run(thread);
    t_within = false;
  };
  std::vector<std::jthread> team;  // joined when it goes out of scope
  try {
    for (int thread = 1; thread < threads; ++thread) team.emplace_back(member, thread);
  } catch (const std::system_error&) {  // the system gives no more threads: those that there are do the work
  }
  member(0);
}

#else

bool within() { return omp_in_parallel() != 0; }

void run_team(Loop& loop, int threads) {
#pragma omp parallel num_threads(threads)
  loop.run(omp_get_thread_num());
}

#endif

}  // namespace

#ifdef TWINDECK_STD_THREADS

int processor_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }
void set_thread_count(int threads) { g_threads = std::max(1, threads); }
int thread_count() {
  const int set = g_threads;
  return set > 0 ? set : processor_count();
}

#else

int processor_count() { return omp_get_num_procs(); }
void set_thread_count(int threads) { omp_set_num_threads(std::max(1, threads)); }
int thread_count() { return omp_get_max_threads(); }

#endif

void parallel_detail::run(std::ptrdiff_t count, std::ptrdiff_t chunk, void (*work)(void*, int, std::ptrdiff_t), void* context) {
  const auto threads = static_cast<int>(std::min<std::ptrdiff_t>(thread_count(), (count + chunk - 1) / chunk));
  if (threads <= 1 || within()) {
    for (std::ptrdiff_t i = 0; i < count; ++i) work(context, 0, i);
    return;
  }
  Loop loop{count, chunk, work, context};
  run_team(loop, threads);
  loop.failure.rethrow();
}

}  // namespace twindeck
