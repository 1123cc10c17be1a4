#include "linalg/lane_kernels.hpp"

namespace twindeck::linalg {
namespace plain {
namespace {
constexpr int kLanes = 2, kAtOnce = 8;
#include "linalg/supernodal_kernels.hpp"
#include "linalg/symmetric_kernels.hpp"
#include "linalg/tall_kernels.hpp"
}  // namespace
}  // namespace plain
LaneKernels plain_kernels() {
  return {plain::sweep<4>,    plain::sweep<8>, plain::sweep<16>, plain::multiply<4>,
          plain::multiply<8>, plain::inner<8>, plain::combine<8>};
}
}  // namespace twindeck::linalg
