/// Records as text: CSV of any dialect, headers, clocks.
#include "fuzz/target.hpp"
#include "records/record.hpp"
#include "records/scan_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("record.csv", data, size);
  return fuzz::read_input([&] { records::scan_text(file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}); });
}
