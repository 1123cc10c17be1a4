#include "model_io/sap2000_tables.hpp"

#include "io/text_lines.hpp"

namespace twindeck::model_io {
namespace {

/// Adds the cells `Key=value` and `Key="a value"` of a line to a row.
void add_cells(const std::string& line, SapRow& row) {
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t start = line.find_first_not_of(" \t", at), equals = line.find('=', start);
    if (start == std::string::npos || equals == std::string::npos) return;
    const bool quoted = equals + 1 < line.size() && line[equals + 1] == '"';
    const std::size_t first = equals + (quoted ? 2 : 1);
    const std::size_t end = std::min(line.find_first_of(quoted ? "\"" : " \t", first), line.size());
    row.keys.push_back(upper_case(trimmed(line.substr(start, equals - start))));
    row.fields.push_back(trimmed(line.substr(first, end - first)));
    at = end + (quoted ? 1 : 0);
  }
}

}  // namespace

bool SapRow::is_neutral() const {
  const bool factors = label.ends_with(" MODIFIERS"),
             offsets = label.starts_with("FRAME INSERTION") || label.starts_with("FRAME OFFSET");
  if (!factors && !offsets) return false;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const bool is_number = fields[i].find_first_of("+-.0123456789") == 0,
               centroid = fields[i].starts_with("10 ") || fields[i].starts_with("11 ");
    if (keys[i] == "CARDINALPT" ? !centroid : is_number && number(i) != (factors ? 1.0 : 0.0)) return false;
  }
  return true;
}

SapTables::SapTables(const std::filesystem::path& file) {
  files_.push_back(file);
  io::TextLines stream(file, io::longest_text);
  if (!stream.opened()) whole("").fail("cannot be opened", "give the path of an .s2k file");
  std::vector<SapRow>* open = nullptr;
  std::string text, label;
  bool goes_on = false;
  for (long number = 1; stream.next(text); ++number) {
    std::string line = trimmed(text);
    if (line.starts_with("TABLE:")) {
      const std::size_t quote = line.find('"'), end = line.find('"', quote + 1);
      if (end == std::string::npos) DeckPlace{&files_.front(), number, "TABLE"}.fail("has no name", "write TABLE:  \"NAME\"");
      label = upper_case(line.substr(quote + 1, end - quote - 1));
      open = &tables_[label];
      continue;
    }
    if (line.empty() || line.starts_with("END TABLE") || line.starts_with("File ")) continue;
    if (open == nullptr)
      DeckPlace{&files_.front(), number, ""}.fail("a row stands before the first table", "begin with TABLE:");
    if (!goes_on) static_cast<DeckPlace&>(open->emplace_back()) = {&files_.front(), number, label};
    goes_on = line.ends_with(" _");
    if (goes_on) line.pop_back();
    add_cells(line, open->back());
  }
}

}  // namespace twindeck::model_io
