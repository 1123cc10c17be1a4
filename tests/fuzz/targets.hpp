#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// A fuzz target by name: fuzz_NAME.cpp.
struct Target {
  const char* name;
  int (*run)(const std::uint8_t* data, std::size_t size);
};

/// All of them; CMake lists the sources fuzz_*.cpp.
[[nodiscard]] const std::vector<Target>& targets();
