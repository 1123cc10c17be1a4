/// Records as HDF5.
#include "fuzz/target.hpp"
#include "records/record.hpp"
#include "records/scan_hdf5.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("record.h5", data, size);
  return fuzz::read_input([&] { records::scan_hdf5(file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}); });
}
