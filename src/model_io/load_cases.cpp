#include "model_io/load_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

constexpr const char* kFile = "loads.csv";

void check_one_of(const io::CsvTable& table, std::size_t row, const std::string& column,
                  const std::vector<std::string>& known) {
  const std::string text = table.text(row, column);
  if (std::find(known.begin(), known.end(), text) == known.end())
    table.fail(row, column, fmt::format("is '{}'{}", text, did_you_mean(text, known)),
               fmt::format("use {}", fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::string> load_case_names(const std::filesystem::path& folder) {
  static const std::vector<std::string> units = {"N", "N m", "m"};
  if (!std::filesystem::exists(folder / kFile)) return {};
  const auto table = io::CsvTable::read(folder / kFile, {"load", "node", "direction", "value", "unit"});
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "load");
    if (name.empty())
      table.fail(row, "load", "is empty, expected the name of a load case", "name it so that a condition can refer to it");
    if (table.text(row, "node").empty()) table.fail(row, "node", "is empty, expected a node", "name the node that is loaded");
    check_one_of(table, row, "direction", direction_names());
    static_cast<void>(table.number(row, "value"));
    check_one_of(table, row, "unit", units);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

void carry_load_cases(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (from.empty() || !std::filesystem::is_regular_file(from / kFile)) return;
  std::filesystem::copy_file(from / kFile, to / kFile, std::filesystem::copy_options::overwrite_existing);
}

}  // namespace twindeck::model_io
