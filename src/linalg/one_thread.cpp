#include "linalg/one_thread.hpp"

#include <dlfcn.h>

namespace twindeck::linalg {

void use_one_thread() {
  // Looked up at run time: which BLAS serves CHOLMOD is the system's choice, and only OpenBLAS has this function. Once, since
  // OpenBLAS keeps the number in a variable that all threads share.
  [[maybe_unused]] static const bool limited = [] {
    void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
    if (symbol != nullptr) reinterpret_cast<void (*)(int)>(symbol)(1);
    return symbol != nullptr;
  }();
}

namespace {

// Looked up at run time, too: CHOLMOD brings the OpenMP runtime that it was built with, and our own loops may use none.
int max_active_levels() {
  static const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
  return get != nullptr ? get() : 1;
}

void set_max_active_levels(int levels) {
  static const auto set = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  if (set != nullptr) set(levels);
}

}  // namespace

SerialScope::SerialScope() : levels_(max_active_levels()) { set_max_active_levels(0); }
SerialScope::~SerialScope() { set_max_active_levels(levels_); }

}  // namespace twindeck::linalg
