/// Time stamps of loggers: each line of the input is one.
#include <string_view>

#include "fuzz/target.hpp"
#include "records/time_stamp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  return fuzz::read_input([&] {
    records::TimeStampReader reader;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      static_cast<void>(reader.next(line));
    }
  });
}
