/// Polars and flutter derivatives.
#include "aero/files/aero_data.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("aero.csv", data, size);
  fuzz::read_input([&] { static_cast<void>(aero::read_polar(file)); });
  return fuzz::read_input([&] { static_cast<void>(aero::read_flutter_derivatives(file)); });
}
