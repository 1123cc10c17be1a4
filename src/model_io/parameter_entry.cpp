#include "model_io/parameter_entry.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/toml_value.hpp"
#include "model_io/folder_parts.hpp"

namespace twindeck::model_io {

void ParameterEntry::add_to(io::FieldTable& table) {
  const io::Range range{-1e30, 1e30};  // beyond, what a parameter scales leaves the range of doubles
  table.text("name", name, "name of the parameter", true)
      .text("unit", unit, "unit of the values: SI, or - for a factor")
      .number("initial", initial, "", range, "value as the model stands", true)
      .number("lower", lower, "", range, "lower bound", true)
      .number("upper", upper, "", range, "upper bound", true)
      .number("nominal", nominal, "", range,
              "value before `initial` was fitted to measurements, which step 6 writes; not used where the bounds exclude it");
}

fe::Parameter ParameterEntry::parameter(const std::filesystem::path& file) const {
  if (!(lower <= initial && initial <= upper))
    throw parameter_error(file, name,
                          fmt::format("lower, initial, upper are {}, {}, {}, expected lower <= initial <= upper",
                                      io::format_number(lower), io::format_number(initial), io::format_number(upper)),
                          "put the bounds around the initial value");
  fe::Parameter p;
  p.name = name;
  p.unit = unit;
  p.initial = initial;
  p.lower = lower;
  p.upper = upper;
  if (lower <= nominal && nominal <= upper) p.nominal = nominal;
  return p;
}

std::string parameter_lines(const fe::Parameter& p, std::string (*number)(double)) {
  std::string text = fmt::format("unit = {}\ninitial = {}\nlower = {}\nupper = {}\n", io::toml_text(p.unit), number(p.initial),
                                 number(p.lower), number(p.upper));
  if (p.nominal) text += fmt::format("nominal = {}\n", number(*p.nominal));
  return text;
}

InputError parameter_error(const std::filesystem::path& file, const std::string& name, const std::string& problem,
                           const std::string& mend) {
  return InputError({file.string(), line_of(file, "\"" + name + "\""), "parameter " + name}, problem, mend);
}

}  // namespace twindeck::model_io
