#include "records/write_universal.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/atomic.hpp"

namespace twindeck::records {

namespace {

constexpr const char* kDelimiter = "    -1\n";

std::string text_line(const std::string& text) { return fmt::format("{:<80}\n", text.substr(0, 80)); }

/// Fields in lines of `a_line` each.
template <typename Value>
std::string field_lines(const std::vector<Value>& values, fmt::format_string<const Value&> field, std::size_t a_line) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format(field, values[i]);
    if (i % a_line == a_line - 1 || i + 1 == values.size()) text += '\n';
  }
  return text;
}

std::string value_lines(const std::vector<double>& values) { return field_lines(values, "{:>13.5E}", 6); }

std::string header_text(const std::string& title) {
  std::string text = kDelimiter;
  text += "   151\n" + text_line(title) + text_line("") + text_line("twindeck");
  for (int i = 0; i < 4; ++i) text += text_line("");
  text += kDelimiter;
  text += kDelimiter;
  text += fmt::format("   164\n{:>10}{:<20}{:>10}\n", 1, "SI: Meter (newton)", 2);
  text += fmt::format("{:>25.17E}{:>25.17E}{:>25.17E}\n{:>25.17E}\n", 1.0, 1.0, 1.0, 273.15);
  return text + kDelimiter;
}

std::string node_text(const UniversalData& data) {
  if (data.nodes.empty()) return "";
  std::string text = kDelimiter;
  text += "  2411\n";
  for (const auto& [label, position] : data.nodes)
    text += fmt::format("{:>10}{:>10}{:>10}{:>10}\n{:>25.16E}{:>25.16E}{:>25.16E}\n", label, 1, 1, 11, position[0], position[1],
                        position[2]);
  return text + kDelimiter;
}

std::string label_lines(const std::vector<long>& labels) { return field_lines(labels, "{:>10}", 8); }

std::string element_text(const UniversalData& data) {
  if (data.elements.empty()) return "";
  std::string text = kDelimiter;
  text += "  2412\n";
  for (const UniversalElement& element : data.elements) {
    text +=
        fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", element.label, element.descriptor, 1, 1, 7, element.nodes.size());
    if (is_beam(element.descriptor)) text += fmt::format("{:>10}{:>10}{:>10}\n", 0, 1, 1);
    text += label_lines(element.nodes);
  }
  return text + kDelimiter;
}

std::string line_text(std::size_t number, const std::vector<long>& line) {
  std::string text = kDelimiter;
  text += fmt::format("    82\n{:>10}{:>10}{:>10}\n{}", number, line.size(), 1, text_line("NONE")) + label_lines(line);
  return text + kDelimiter;
}

std::string result_text(const NodalResult& result) {
  TWINDECK_ASSERT(!result.values.empty());
  const Eigen::Index n = result.values.begin()->second.size();
  std::string text = kDelimiter;
  text += "    55\n" + text_line(result.title);
  for (int i = 0; i < 4; ++i) text += text_line("NONE");
  // Codes of a structural result in displacements: the kind of mode, its directions, real or complex, and the values that each
  // node has.
  text +=
      fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", 1, result.analysis, n == 6 ? 3 : 2, 8, result.complex ? 5 : 2, n);
  if (result.is_complex_mode()) {
    text += fmt::format("{:>10}{:>10}{:>10}{:>10}\n", 2, 6, 1, result.mode);
    text += value_lines({result.eigenvalue.real(), result.eigenvalue.imag(), 1.0, 0.0, 0.0, 0.0});
  } else {
    text += fmt::format("{:>10}{:>10}{:>10}{:>10}\n", 2, 4, 1, result.mode);
    text += value_lines({result.frequency_Hz, 1.0, result.damping_ratio, 0.0});
  }
  for (const auto& [node, values] : result.values) {
    text += fmt::format("{:>10}\n", node);
    std::vector<double> list;
    for (const std::complex<double>& value : values) {
      list.push_back(value.real());
      if (result.complex) list.push_back(value.imag());
    }
    text += value_lines(list);
  }
  return text + kDelimiter;
}

}  // namespace

void write_universal(const UniversalData& data, const std::filesystem::path& file) {
  std::string text = header_text(data.title) + node_text(data) + element_text(data);
  for (std::size_t i = 0; i < data.lines.size(); ++i) text += line_text(i + 1, data.lines[i]);
  for (const NodalResult& result : data.results) text += result_text(result);
  io::write_file_atomically(file, text);
}

}  // namespace twindeck::records
