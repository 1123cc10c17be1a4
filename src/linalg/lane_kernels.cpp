#include "linalg/lane_kernels.hpp"

namespace twindeck::linalg {

const LaneKernels& lane_kernels() {
  static const LaneKernels best = [] {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      return avx512_kernels();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2_kernels();
#endif
    return plain_kernels();
  }();
  return best;
}

}  // namespace twindeck::linalg
