#include "linalg/one_thread.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <algorithm>
#include <vector>

namespace twindeck::linalg {

void use_one_thread() {
  // The function is looked up at run time, because only OpenBLAS has it and the system chooses the BLAS of CHOLMOD. It is
  // called once: OpenBLAS keeps the number of threads in a variable that all threads share.
  [[maybe_unused]] static const bool limited = [] {
    void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
    if (symbol != nullptr) reinterpret_cast<void (*)(int)>(symbol)(1);
    return symbol != nullptr;
  }();
}

bool reserve_blas_memory(int threads) {
  static const auto take = reinterpret_cast<void* (*)(int)>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  static const auto give_back = reinterpret_cast<void (*)(void*)>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (take == nullptr || give_back == nullptr) return true;
  constexpr std::size_t most = 64;                      // OpenBLAS of Debian has places for twice as many threads
  constexpr std::size_t rest = std::size_t{16} << 20U;  // [bytes] for the other memory that OpenBLAS needs to begin
  const std::size_t count = std::min(static_cast<std::size_t>(threads), most), bytes = count * blas_memory_bytes + rest;
  void* const trial = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (trial == MAP_FAILED) return false;
  ::munmap(trial, bytes);
  std::vector<void*> taken(count);
  for (void*& one : taken) one = take(0);
  for (void* const one : taken) give_back(one);
  return true;
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
