#include "linalg/supernodal_solve.hpp"

namespace twindeck::linalg {
namespace plain {
namespace {
#include "linalg/supernodal_kernels.hpp"
}  // namespace
}  // namespace plain
SupernodalSweeps plain_sweeps() { return {plain::sweep<4>, plain::sweep<8>}; }
}  // namespace twindeck::linalg
