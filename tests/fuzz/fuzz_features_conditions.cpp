/// A features folder whose conditions.toml is the input, as step 9 reads it and as steps 4 and 6 do.
#include "fuzz/features.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return twindeck::fuzz::read_features("conditions.toml", data, size);
}
