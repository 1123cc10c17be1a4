#pragma once

#include <sys/resource.h>

#include <ctime>
#include <functional>

/// What a benchmark's process costs.
namespace twindeck::bench {

/// Processor time of all threads of this process so far [s]: what else runs on the machine hardly matters.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Processor time of some work [s].
inline double seconds(const std::function<void()>& work) {
  const double begin = cpu_seconds();
  work();
  return cpu_seconds() - begin;
}

/// Largest memory that the process has had so far [MB].
inline double peak_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace twindeck::bench
