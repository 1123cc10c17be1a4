#include "linalg/one_thread.hpp"

#include <dlfcn.h>
#include <omp.h>

#include <Eigen/Core>

namespace twindeck::linalg {

void use_one_thread() {
  // Looked up at run time: which BLAS serves CHOLMOD is the system's choice, and only OpenBLAS has this function.
  using SetThreads = void (*)(int);
  static const auto set_threads = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set_threads != nullptr) set_threads(1);
  Eigen::setNbThreads(1);
}

SerialScope::SerialScope() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
SerialScope::~SerialScope() { omp_set_max_active_levels(levels_); }

}  // namespace twindeck::linalg
