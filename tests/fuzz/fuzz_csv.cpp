/// Tables as our own CSV: every cell is read as text, number and whole number.
#include "core/error.hpp"
#include "fuzz/target.hpp"
#include "io/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  const auto file = fuzz::write_file("table.csv", data, size);
  return fuzz::read_input([&] {
    const auto table = io::CsvTable::read(file, {}, {"node", "x_m"}, true);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      for (const std::string& column : table.columns()) {
        static_cast<void>(table.text(row, column));
        fuzz::read_input([&] { static_cast<void>(table.number_if(row, column)); });
        fuzz::read_input([&] { static_cast<void>(table.integer_if(row, column)); });
      }
    }
  });
}
