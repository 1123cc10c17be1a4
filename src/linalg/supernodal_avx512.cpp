#include "linalg/supernodal_solve.hpp"

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2,fma")
namespace twindeck::linalg {
namespace avx512 {
namespace {
constexpr int kLanes = 8, kAtOnce = 24;
#include "linalg/supernodal_kernels.hpp"
}  // namespace
}  // namespace avx512
SupernodalSweeps avx512_sweeps() { return {avx512::sweep<4>, avx512::sweep<8>, avx512::sweep<16>}; }
}  // namespace twindeck::linalg
#pragma GCC pop_options
#else
namespace twindeck::linalg {
SupernodalSweeps avx512_sweeps() { return plain_sweeps(); }
}  // namespace twindeck::linalg
#endif
