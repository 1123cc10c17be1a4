#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace twindeck::fuzz {

/// Reads the sound features folder with the bytes in the place of the file `name`. @return 0, as libFuzzer wants it
int read_features(const std::string& name, const std::uint8_t* data, std::size_t size);

}  // namespace twindeck::fuzz
