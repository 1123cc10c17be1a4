/// Decks of ANSYS, read and made into a structure.
#include "dynamics/loaded_model.hpp"
#include "fuzz/target.hpp"
#include "model_io/ansys.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("frame.cdb", data, size);
  return fuzz::read_input([&] { static_cast<void>(dynamics::from_model(model_io::read_ansys(file).model)); });
}
