#include "model_io/load_cases.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "io/spreadsheet.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io {
namespace {

constexpr const char* kFile = "loads.csv";

void check_one_of(const io::CsvTable& table, std::size_t row, const std::string& column,
                  const std::vector<std::string>& known) {
  if (const std::string text = table.text(row, column); !contains(known, text))
    table.fail(row, column, fmt::format("is '{}'{}", text, did_you_mean(text, known)),
               fmt::format("use {}", fmt::join(known, ", ")));
}

/// Two rows of one load would add up, which is more often a row that was copied twice than meant.
void refuse_repeated(const io::CsvTable& table, std::size_t row, const LoadEntry& entry, const std::vector<LoadEntry>& before) {
  for (const LoadEntry& other : before)
    if (other.load == entry.load && other.node == entry.node && other.direction == entry.direction && other.kind == entry.kind)
      table.fail(row, "node",
                 fmt::format("is loaded by '{}' in direction {} in line {} already", entry.load, table.text(row, "direction"),
                             other.line),
                 "delete one of the two rows, or write their sum into one");
}

}  // namespace

std::vector<LoadEntry> read_load_cases(const std::filesystem::path& folder) {
  static const std::vector<std::string> units = {"N", "N m", "m"};  // in the order of LoadEntry::Kind
  if (!io::has_table(folder / kFile)) return {};
  const auto table = io::CsvTable::read(folder / kFile, {"load", "node", "direction", "value", "unit"});
  std::vector<LoadEntry> entries;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    LoadEntry entry;
    entry.line = table.line(row);
    entry.load = table.text(row, "load");
    if (entry.load.empty())
      table.fail(row, "load", "is empty, expected the name of a load case", "name it so that a condition can refer to it");
    entry.node = table.text(row, "node");
    if (entry.node.empty()) table.fail(row, "node", "is empty, expected a node", "name the node that is loaded");
    check_one_of(table, row, "direction", direction_names());
    entry.direction = position_of(table.text(row, "direction"), direction_names());
    entry.value = table.number(row, "value");
    check_one_of(table, row, "unit", units);
    entry.kind = static_cast<LoadEntry::Kind>(position_of(table.text(row, "unit"), units));
    constexpr int translations = 3;
    if ((entry.direction >= translations) != (entry.kind == LoadEntry::Kind::moment))
      table.fail(row, "unit", fmt::format("is '{}' in direction {}", table.text(row, "unit"), table.text(row, "direction")),
                 "N and m go with x, y, z; N m goes with rx, ry, rz");
    refuse_repeated(table, row, entry, entries);
    entries.push_back(entry);
  }
  return entries;
}

std::vector<std::string> load_case_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const LoadEntry& entry : read_load_cases(folder))
    if (!contains(names, entry.load)) names.push_back(entry.load);
  return names;
}

void carry_load_cases(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (from.empty() || !std::filesystem::is_regular_file(from / kFile)) return;
  std::filesystem::copy_file(from / kFile, to / kFile, std::filesystem::copy_options::overwrite_existing);
}

}  // namespace twindeck::model_io
