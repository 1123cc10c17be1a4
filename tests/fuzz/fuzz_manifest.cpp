/// A step's manifest.json, and the check of a file against it.
#include <filesystem>

#include "fuzz/target.hpp"
#include "io/manifest.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto folder = fuzz::scratch() / "s1_model";
  std::filesystem::create_directories(folder);
  fuzz::write_file("s1_model/manifest.json", data, size);
  const std::uint8_t byte = '1';
  const auto file = fuzz::write_file("s1_model/modes.csv", &byte, 1);
  fuzz::read_input([&] { static_cast<void>(io::read_manifest(folder)); });
  return fuzz::read_input([&] { io::check_against_manifest(file); });
}
