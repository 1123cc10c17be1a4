/// Configurations: a table with a key of each kind, from a file, from --set, and printed and read again.
#include <deque>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fuzz/target.hpp"
#include "io/config.hpp"

namespace {

using namespace twindeck;

struct Part {
  std::string name;
  double length_m = 1.0;
};

struct Everything {
  double mass_kg = 1.0;
  long modes = 4;
  bool dampers = true;
  std::string title, rule = "none";
  std::vector<double> masses;
  std::vector<std::string> names;
  std::deque<Part> parts;

  io::FieldTable fields() {
    io::FieldTable table;
    table.number("mass", mass_kg, "kg", io::non_negative(), "a mass")
        .integer("solver.modes", modes, {1.0, 200.0}, "a number of modes")
        .boolean("dampers", dampers, "whether")
        .text("title", title, "a title", true)
        .choice("rule", rule, {"none", "given"}, "one of two")
        .numbers("masses", masses, "kg", {}, "masses")
        .texts("names", names, "names")
        .tables(
            "part",
            [this] {
              Part& part = parts.emplace_back();
              io::FieldTable entry;
              entry.text("name", part.name, "its name", true)
                  .number("length", part.length_m, "m", io::positive(), "its length");
              return entry;
            },
            "parts");
    return table;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write_file("step.toml", data, size);
  fuzz::read_input([&] { Everything().fields().set(std::string(reinterpret_cast<const char*>(data), size)); });
  return fuzz::read_input([&] {
    Everything read;
    io::FieldTable fields = read.fields();
    fields.load(file);
    // What was read and printed must be read again: a configuration in a manifest is one.
    const std::string printed = fields.print();
    const auto again = fuzz::write_file("again.toml", reinterpret_cast<const std::uint8_t*>(printed.data()), printed.size());
    Everything second;
    try {
      second.fields().load(again);
    } catch (const InputError& error) {
      throw InternalError("what was printed is refused: " + std::string(error.what()));
    }
  });
}
