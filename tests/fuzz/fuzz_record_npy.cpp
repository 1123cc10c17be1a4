/// Records as NPY.
#include "fuzz/target.hpp"
#include "records/record.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("record.npy", data, size);
  return fuzz::read_input([&] { records::scan_npy(file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}); });
}
