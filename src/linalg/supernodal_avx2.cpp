#include "linalg/supernodal_solve.hpp"

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace twindeck::linalg {
namespace avx2 {
namespace {
constexpr int kLanes = 4, kAtOnce = 8;
#include "linalg/supernodal_kernels.hpp"
}  // namespace
}  // namespace avx2
SupernodalSweeps avx2_sweeps() { return {avx2::sweep<4>, avx2::sweep<8>, avx2::sweep<16>}; }
}  // namespace twindeck::linalg
#pragma GCC pop_options
#else
namespace twindeck::linalg {
SupernodalSweeps avx2_sweeps() { return plain_sweeps(); }
}  // namespace twindeck::linalg
#endif
