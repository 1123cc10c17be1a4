#include "model_io/inp_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/text_lines.hpp"

namespace twindeck::model_io {
namespace {

std::vector<std::string> split_line(const std::string& text) {
  std::vector<std::string> fields = split_at(text, ',');
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();  // a comma at the end closes the last field
  return fields;
}

/// What messages call a card: its letters and blanks. The rest of what need not be a deck is not shown.
std::string label_of(const std::string& keyword) {
  constexpr std::size_t longest = 32;  // letters: the longest name of a card has 27
  const std::size_t end = keyword.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ- ");
  return "*" + trimmed(keyword.substr(0, std::min(end, longest)));
}

InpCard to_card(const std::string& text, const std::filesystem::path& file, long line) {
  InpCard card;
  const std::vector<std::string> fields = split_line(text.substr(1));
  // "*END  STEP" and "*End Step" are the same word.
  for (const char c : upper_case(fields.front()))
    if (c != ' ' || (!card.keyword.empty() && card.keyword.back() != ' ')) card.keyword += c;
  static_cast<DeckPlace&>(card) = {&file, line, label_of(card.keyword)};
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

bool takes_no_data(const std::string& keyword) {
  return contains(std::array{"ASSEMBLY", "COUPLING", "END ASSEMBLY", "END INSTANCE", "END PART", "END STEP", "MATERIAL", "PART",
                             "RIGID BODY"},
                  keyword);
}

}  // namespace

std::string InpCard::get(const std::string& name, const std::string& fallback) const {
  const auto found = parameters.find(name);
  return found == parameters.end() ? fallback : found->second;
}

InpFile InpFile::read(const std::filesystem::path& file) {
  InpFile result;
  std::vector<std::filesystem::path> open;
  result.append(file, open);
  return result;
}

void InpFile::append(const std::filesystem::path& file, std::vector<std::filesystem::path>& open) {
  const std::filesystem::path& path = files_.emplace_back(file);
  open.push_back(std::filesystem::weakly_canonical(file));
  io::TextLines stream(file, io::longest_text);
  if (!stream.opened()) throw InputError({file.string(), 0, ""}, "cannot be opened", "give the path of an .inp file");
  std::string text, pending;
  long first = 0;
  const auto close_card = [&] {
    InpCard card = to_card(pending, path, first);
    pending.clear();
    if (card.keyword == "INCLUDE")
      append(included_file(card, path, card.required("INPUT"), open), open);
    else
      cards_.push_back(std::move(card));
  };
  while (stream.next(text)) {
    const long number = stream.number();
    const std::string line = trimmed(text);
    if (line.empty() || line.starts_with("**")) continue;
    if (pending.starts_with('*') && !continues_a_card(line)) close_card();
    if (pending.empty()) first = number;
    pending += line;
    if (pending.starts_with('*') && line.ends_with(',')) continue;  // the card goes on in the next line
    if (pending.starts_with('*')) {
      close_card();
    } else if (cards_.empty()) {
      throw InputError({file.string(), number, ""}, "data stand before the first card", "begin the file with *HEADING");
    } else {
      InpCard& card = cards_.back();
      if (takes_no_data(card.keyword))
        throw InputError({file.string(), first, card.label}, "a data line stands under this card, which takes none",
                         "take the line out, or write the card that it belongs to above it");
      card.data.push_back({{&path, first, card.label}, card.keyword == "HEADING" ? std::vector{line} : split_line(pending)});
    }
    pending.clear();
  }
  if (!pending.empty())
    throw InputError({file.string(), stream.number() - 1, ""}, "the file ends within a line that a comma continues",
                     "complete the line");
  open.pop_back();
}

std::string InpCard::required(const std::string& parameter) const {
  const std::string value = get(parameter);
  if (value.empty()) fail(parameter + " is missing", fmt::format("write {}, {}=…", label, parameter));
  return value;
}

void InpCard::allow(const std::vector<std::string>& known) const {
  for (const auto& [name, value] : parameters)
    if (!name.empty() && !contains(known, name))
      fail(fmt::format("unsupported parameter {}{}", name, did_you_mean(name, known)),
           "it would change what the card means; write the model without it");
}

const InpLine& InpCard::line_of(std::size_t i, const char* what) const {
  if (data.size() <= i) fail(fmt::format("data line {} is missing", i + 1), fmt::format("it gives {}", what));
  return data[i];
}

}  // namespace twindeck::model_io
