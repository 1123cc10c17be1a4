#include "fuzz/targets.hpp"

// fuzz_targets.inc, written by CMake, holds TARGET(name) for each source fuzz_name.cpp, whose entry is called fuzz_name in this
// build.
#define TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef TARGET

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
#define TARGET(name) {#name, fuzz_##name},
#undef TARGET
  };
  return all;
}
