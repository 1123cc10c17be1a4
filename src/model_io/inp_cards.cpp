#include "model_io/inp_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>

#include "core/error.hpp"

namespace twindeck::model_io {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  for (std::size_t comma = 0; comma != std::string::npos; start = comma + 1) {
    comma = text.find(',', start);
    fields.push_back(trimmed(text.substr(start, comma == std::string::npos ? comma : comma - start)));
  }
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();  // a comma at the end closes the last field
  return fields;
}

InpCard to_card(const std::string& text, long line) {
  InpCard card;
  card.line = line;
  const std::vector<std::string> fields = split(text.substr(1));
  // "*END  STEP" and "*End Step" are the same word.
  for (const char c : upper_case(fields.front())) {
    if (c != ' ' || (!card.keyword.empty() && card.keyword.back() != ' ')) card.keyword += c;
  }
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto equals = fields[i].find('=');
    std::string value = equals == std::string::npos ? "" : trimmed(fields[i].substr(equals + 1));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    card.parameters[upper_case(trimmed(fields[i].substr(0, equals)))] = value;
  }
  return card;
}

/// Whether a line goes on with the card above it, which ends with a comma: with a further parameter. CalculiX' users end cards
/// with a comma that means nothing; what follows is a card of its own or data then.
bool continues_a_card(const std::string& line) { return std::isalpha(static_cast<unsigned char>(line.front())) != 0; }

}  // namespace

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string InpCard::get(const std::string& name, const std::string& fallback) const {
  const auto found = parameters.find(name);
  return found == parameters.end() ? fallback : found->second;
}

InpFile InpFile::read(const std::filesystem::path& file) {
  InpFile result;
  result.file_ = file;
  std::ifstream stream(file);
  if (!stream) throw InputError({file.string(), 0, ""}, "cannot be opened", "give the path of an .inp file");
  std::string text, pending;
  long first = 0, number = 0;
  while (std::getline(stream, text)) {
    ++number;
    const std::string line = trimmed(text);
    if (line.empty() || line.starts_with("**")) continue;
    if (pending.starts_with('*') && !continues_a_card(line)) {
      result.cards_.push_back(to_card(pending, first));
      pending.clear();
    }
    if (pending.empty()) first = number;
    pending += line;
    if (pending.starts_with('*') && line.ends_with(',')) continue;  // the card goes on in the next line
    if (pending.starts_with('*')) {
      result.cards_.push_back(to_card(pending, first));
    } else if (result.cards_.empty()) {
      throw InputError({file.string(), number, ""}, "data stand before the first card", "begin the file with *HEADING");
    } else {
      const bool heading = result.cards_.back().keyword == "HEADING";
      result.cards_.back().data.push_back({first, heading ? std::vector<std::string>{line} : split(pending)});
    }
    pending.clear();
  }
  if (!pending.empty()) {
    throw InputError({file.string(), number, ""}, "the file ends within a line that a comma continues", "complete the line");
  }
  return result;
}

void InpFile::fail(const InpCard& card, long line, const std::string& problem, const std::string& mend) const {
  throw InputError({file_.string(), line, "*" + card.keyword}, problem, mend);
}

std::string InpFile::required(const InpCard& card, const std::string& parameter) const {
  const std::string value = card.get(parameter);
  if (value.empty()) fail(card, card.line, parameter + " is missing", fmt::format("write *{}, {}=…", card.keyword, parameter));
  return value;
}

void InpFile::allow(const InpCard& card, const std::vector<std::string>& known) const {
  for (const auto& [name, value] : card.parameters) {
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    fail(card, card.line, fmt::format("unsupported parameter {}{}", name, did_you_mean(name, known)),
         "it would change what the card means; write the model without it");
  }
}

double InpFile::number_or(const InpCard& card, const InpLine& line, std::size_t i, double fallback) const {
  if (i >= line.fields.size() || line.fields[i].empty()) return fallback;
  std::string text = line.fields[i];
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  if (text.starts_with('+')) text.erase(0, 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    fail(card, line.line, fmt::format("'{}' is no finite number (field {})", line.fields[i], i + 1), "check the data line");
  }
  return value;
}

double InpFile::number(const InpCard& card, const InpLine& line, std::size_t i) const {
  if (i >= line.fields.size() || line.fields[i].empty()) {
    fail(card, line.line, fmt::format("field {} is missing, expected a number", i + 1), "complete the data line");
  }
  return number_or(card, line, i, 0.0);
}

long InpFile::integer(const InpCard& card, const InpLine& line, std::size_t i) const {
  const double value = number(card, line, i);
  if (value != std::floor(value) || std::abs(value) > 1e15) {
    fail(card, line.line, fmt::format("'{}' is no whole number (field {})", line.fields[i], i + 1), "check the data line");
  }
  return static_cast<long>(value);
}

int InpFile::dof(const InpCard& card, const InpLine& line, std::size_t i) const {
  const long dof = integer(card, line, i);
  if (dof < 1 || dof > 6)
    fail(card, line.line, fmt::format("degree of freedom {} is not supported, expected 1 to 6", dof),
         "1-3 displacements, 4-6 rotations");
  return static_cast<int>(dof) - 1;
}

bool InpFile::is_integer(const std::string& field) {
  return !field.empty() && field.size() < 18 && field.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace twindeck::model_io
