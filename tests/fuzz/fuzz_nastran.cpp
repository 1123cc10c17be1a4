/// Nastran decks, read and made into a structure.
#include "dynamics/loaded_model.hpp"
#include "fuzz/target.hpp"
#include "model_io/nastran.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  static const std::string units = "[units]\nlength = \"in\"\nforce = \"lbf\"\n";
  static const auto beside = fuzz::write_file("deck.toml", reinterpret_cast<const std::uint8_t*>(units.data()), units.size());
  const auto file = fuzz::write_file("deck.bdf", data, size);
  return fuzz::read_input([&] { static_cast<void>(dynamics::from_model(model_io::read_nastran(file).model)); });
}
