/// Records as MAT files.
#include "fuzz/target.hpp"
#include "records/record.hpp"
#include "records/scan_mat.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("record.mat", data, size);
  return fuzz::read_input([&] { records::scan_mat(file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}); });
}
