#include "linalg/lane_kernels.hpp"

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace twindeck::linalg {
namespace avx2 {
namespace {
constexpr int kLanes = 4, kAtOnce = 8;
#include "linalg/supernodal_kernels.hpp"
#include "linalg/symmetric_kernels.hpp"
#include "linalg/tall_kernels.hpp"
}  // namespace
}  // namespace avx2
LaneKernels avx2_kernels() {
  return {avx2::sweep<4>,    avx2::sweep<8>, avx2::sweep<16>, avx2::multiply<4>,
          avx2::multiply<8>, avx2::inner<8>, avx2::combine<8>};
}
}  // namespace twindeck::linalg
#pragma GCC pop_options
#else
namespace twindeck::linalg {
LaneKernels avx2_kernels() { return plain_kernels(); }
}  // namespace twindeck::linalg
#endif
