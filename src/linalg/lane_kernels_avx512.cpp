#include "linalg/lane_kernels.hpp"

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2,fma")
namespace twindeck::linalg {
namespace avx512 {
namespace {
constexpr int kLanes = 8, kAtOnce = 24;
#include "linalg/supernodal_kernels.hpp"
#include "linalg/symmetric_kernels.hpp"
#include "linalg/tall_kernels.hpp"
}  // namespace
}  // namespace avx512
LaneKernels avx512_kernels() {
  return {avx512::sweep<4>,    avx512::sweep<8>, avx512::sweep<16>, avx512::multiply<4>,
          avx512::multiply<8>, avx512::inner<8>, avx512::combine<8>};
}
}  // namespace twindeck::linalg
#pragma GCC pop_options
#else
namespace twindeck::linalg {
LaneKernels avx512_kernels() { return plain_kernels(); }
}  // namespace twindeck::linalg
#endif
