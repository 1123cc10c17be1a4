#include "steps/shared/run_step_threads.hpp"

#include <dlfcn.h>

#include <Eigen/Core>

#include "core/parallel.hpp"

namespace twindeck::steps {

int set_threads(int asked) {
  const int threads = asked > 0 ? asked : processor_count();
  set_thread_count(threads);
  Eigen::setNbThreads(1);
  // OpenBLAS comes in through the system's BLAS alternative; another BLAS has no such function and no threads.
  if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"); symbol != nullptr) {
    reinterpret_cast<void (*)(int)>(symbol)(1);
  }
  return threads;
}

}  // namespace twindeck::steps
