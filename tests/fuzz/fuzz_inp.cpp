/// Decks of CalculiX and Abaqus, read and made into a structure.
#include "dynamics/loaded_model.hpp"
#include "fuzz/target.hpp"
#include "model_io/inp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("frame.inp", data, size);
  return fuzz::read_input([&] { static_cast<void>(dynamics::from_model(model_io::read_inp(file).model)); });
}
