#include "linalg/supernodal_solve.hpp"

namespace twindeck::linalg {
namespace plain {
namespace {
constexpr int kLanes = 2, kAtOnce = 8;
#include "linalg/supernodal_kernels.hpp"
}  // namespace
}  // namespace plain
SupernodalSweeps plain_sweeps() { return {plain::sweep<4>, plain::sweep<8>, plain::sweep<16>}; }
}  // namespace twindeck::linalg
