#include "linalg/supernodal_solve.hpp"

namespace twindeck::linalg {

const SupernodalSweeps& supernodal_sweeps() {
  static const SupernodalSweeps best = [] {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      return avx512_sweeps();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2_sweeps();
#endif
    return plain_sweeps();
  }();
  return best;
}

}  // namespace twindeck::linalg
