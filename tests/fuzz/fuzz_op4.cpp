/// OUTPUT4 files of Nastran.
#include "fuzz/target.hpp"
#include "matrix_io/op4.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("K.op4", data, size);
  return fuzz::read_input([&] { static_cast<void>(matrix_io::read_op4(file)); });
}
