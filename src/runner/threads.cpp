#include "runner/threads.hpp"

#include "core/parallel.hpp"
#include "linalg/one_thread.hpp"

namespace twindeck::runner {

int set_threads(int asked) {
  const int threads = asked > 0 ? asked : processor_count();
  set_thread_count(threads);
  linalg::use_one_thread();
  return threads;
}

}  // namespace twindeck::runner
