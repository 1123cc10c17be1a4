/// A features folder whose covariance.npy is the input, as step 9 reads it and as steps 4 and 6 do.
#include "fuzz/features.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return twindeck::fuzz::read_features("covariance.npy", data, size);
}
