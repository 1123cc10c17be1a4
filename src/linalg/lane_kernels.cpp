#include "linalg/lane_kernels.hpp"

#include <cstdlib>
#include <string>

namespace twindeck::linalg {

const LaneKernels& lane_kernels() {
  // TWINDECK_INSTRUCTIONS=plain, avx2 or avx512 asks for what a lesser machine would take: `make processors` compares them.
  static const LaneKernels best = [] {
    const char* asked = std::getenv("TWINDECK_INSTRUCTIONS");
    const std::string most = asked == nullptr ? "avx512" : asked;
    if (most == "plain") return plain_kernels();
#if defined(__x86_64__)
    if (most != "avx2" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      return avx512_kernels();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2_kernels();
#endif
    return plain_kernels();
  }();
  return best;
}

}  // namespace twindeck::linalg
