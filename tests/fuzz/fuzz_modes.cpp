/// A folder of measured modes with one file replaced: the first byte says which, the rest is the file.
#include <array>

#include "fuzz/target.hpp"
#include "steps/measured/measured_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  static constexpr std::array names = {"modes.csv", "shapes.csv", "channels.csv"};
  if (size == 0) return 0;
  return fuzz::read_folder("features/modes", names[data[0] % names.size()], data + 1, size - 1,
                           [](const auto& folder) { static_cast<void>(steps::read_measured_modes(folder, {})); });
}
