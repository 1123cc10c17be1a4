/// Records as universal files, text and binary sets.
#include "fuzz/target.hpp"
#include "records/record.hpp"
#include "records/scan_universal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("record.uff", data, size);
  return fuzz::read_input([&] { records::scan_universal(file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}); });
}
