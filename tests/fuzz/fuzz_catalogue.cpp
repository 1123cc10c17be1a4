/// A hypothesis of the catalogue.
#include <filesystem>

#include "diagnosis/files/catalogue_files.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto folder = fuzz::scratch() / "catalogue";
  std::filesystem::create_directories(folder);
  fuzz::write_file("catalogue/mass.toml", data, size);
  return fuzz::read_input([&] { static_cast<void>(diagnosis::read_catalogue(folder)); });
}
