/// Corrections of channels.
#include "fuzz/target.hpp"
#include "records/corrections.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  fuzz::write_file("corrections.toml", data, size);
  return fuzz::read_input([] { static_cast<void>(records::read_corrections(fuzz::scratch() / "corrections.toml")); });
}
