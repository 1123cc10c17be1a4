/// Matrix Market files, as sparse symmetric matrices and as small square ones.
#include "fuzz/target.hpp"
#include "matrix_io/matrix_market.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("K.mtx", data, size);
  fuzz::read_input([&] { static_cast<void>(matrix_io::read_square_matrix(file)); });
  return fuzz::read_input([&] { static_cast<void>(matrix_io::read_matrix_market(file)); });
}
