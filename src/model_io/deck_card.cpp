#include "model_io/deck_card.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/units.hpp"

namespace twindeck::model_io {
namespace {

constexpr DeckDialect counted_from_one;

/// "3.0+7" and "3.0D7" as "3.0e7"; a leading plus goes.
std::optional<double> fortran_number(const std::string& field) {
  std::string written;
  bool exponent = false;
  for (std::size_t i = 0; i < field.size(); ++i) {
    char c = field[i];
    if (c == 'd' || c == 'D' || c == 'e' || c == 'E') {
      c = 'e';
      exponent = true;
    } else if ((c == '+' || c == '-') && i > 0 && !exponent) {
      written += 'e';
      exponent = true;
    }
    if (c != '+') written += c;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), value);
  if (error != std::errc() || end != written.data() + written.size()) return std::nullopt;
  return value;
}

/// Recursive descent over one expression; `failed` is set by whatever is not understood.
class Parser {
 public:
  Parser(const std::string& text, const Parameters& parameters) : text_(text), parameters_(parameters) {}

  std::optional<double> value() {
    const double result = sum();
    skip_blanks();
    if (failed_ || at_ != text_.size() || !std::isfinite(result)) return std::nullopt;
    return result;
  }

 private:
  static constexpr int deepest = 40;  ///< brackets and signs within one another: more is no expression of a person

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  [[nodiscard]] char peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(const std::string& sign) {
    skip_blanks();
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    return true;
  }

  double sum() {
    double result = product();
    while (!failed_) {
      if (take("+"))
        result += product();
      else if (take("-"))
        result -= product();
      else
        break;
    }
    return result;
  }

  double product() {
    double result = power();
    while (!failed_ && (peek() == '*' || peek() == '/')) {
      if (take("/"))
        result /= power();
      else if (take("*"))
        result *= power();
    }
    return result;
  }

  double power() {
    double base = factor();
    while (!failed_ && take("**")) base = std::pow(base, factor());
    return base;
  }

  double factor() {
    if (++depth_ > deepest) failed_ = true;
    double result = 0.0;
    if (failed_) {
      // nothing more is read
    } else if (take("-")) {
      result = -factor();
    } else if (take("+")) {
      result = factor();
    } else if (take("(")) {
      result = sum();
      failed_ = failed_ || !take(")");
    } else if (const char c = peek(); std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
      result = parameter();
    } else {
      result = number();
    }
    --depth_;
    return result;
  }

  double parameter() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) ++at_;
    const auto found = parameters_.find(upper_case(text_.substr(start, at_ - start)));
    if (found == parameters_.end() || peek() == '(') {
      failed_ = true;
      return 0.0;
    }
    return found->second;
  }

  double number() {
    std::string digits;
    std::size_t end = at_;
    for (; end < text_.size(); ++end) {
      const char c = text_[end];
      const bool exponent = c == 'e' || c == 'E' || c == 'd' || c == 'D';
      const bool sign_of_exponent = (c == '+' || c == '-') && !digits.empty() && digits.back() == 'e';
      if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.' && !exponent && !sign_of_exponent) break;
      digits += exponent ? 'e' : c;
    }
    double result = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result);
    if (error != std::errc() || stop != digits.data() + digits.size()) failed_ = true;
    at_ = end;
    return result;
  }

  const std::string& text_;
  const Parameters& parameters_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

std::string trimmed(const std::string& text) { return std::string(without_blanks(text, " \t\r")); }

bool is_whole_number(const std::string& field) {
  const std::size_t sign = !field.empty() && (field[0] == '-' || field[0] == '+') ? 1 : 0;
  return field.size() > sign && field.size() < 18 && field.find_first_not_of("0123456789", sign) == std::string::npos;
}

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
    end = text.find(separator, start);
    parts.push_back(trimmed(text.substr(start, end == std::string::npos ? end : end - start)));
  }
  return parts;
}

std::filesystem::path included_file(const DeckPlace& at, const std::filesystem::path& from, const std::string& name,
                                    const std::vector<std::filesystem::path>& open) {
  constexpr std::size_t deepest = 20;  // files within files; real decks have two or three levels
  std::string slashed = name;
  std::ranges::replace(slashed, '\\', '/');
  const auto folder = open.front().parent_path();
  std::filesystem::path path = from.parent_path() / slashed;
  if (!std::filesystem::is_regular_file(path)) path = folder / slashed;
  if (name.empty() || !std::filesystem::is_regular_file(path))
    at.fail(fmt::format("the file '{}' is not there", name), "put it beside the deck, or mend its path");
  const auto canonical = std::filesystem::weakly_canonical(path);
  if (std::mismatch(folder.begin(), folder.end(), canonical.begin(), canonical.end()).first != folder.end())
    at.fail("the file does not lie below the folder of the deck", "copy it there, and include the copy");
  if (open.size() >= deepest || contains(open, canonical))
    at.fail(fmt::format("the file '{}' includes itself", name), "take one of the INCLUDE lines out");
  return path;
}

void DeckPlace::fail(const std::string& problem, const std::string& mend) const {
  throw InputError({file == nullptr ? "" : file->string(), line, label}, problem, mend);
}

std::size_t DeckFields::size() const {
  const auto last = std::find_if(fields.rbegin(), fields.rend(), [](const std::string& f) { return !f.empty(); });
  return static_cast<std::size_t>(fields.rend() - last);
}

std::string DeckFields::place_of_field(std::size_t i) const {
  const DeckDialect& counts = dialect == nullptr ? counted_from_one : *dialect;
  i += static_cast<std::size_t>(taken);
  if (counts.fields_a_line == 0 || i < counts.fields_a_line) return fmt::format("field {}", i + counts.first_field);
  return fmt::format("field {} of its line {}", i % counts.fields_a_line + counts.first_field, i / counts.fields_a_line + 1);
}

double DeckFields::number_or(std::size_t i, double fallback) const {
  if (blank(i)) return fallback;
  const auto value = parameters == nullptr ? fortran_number(fields[i]) : evaluate(fields[i], *parameters);
  if (!value || !(parameters != nullptr || std::abs(*value) <= largest_number))
    fail(fmt::format("{} is '{}', expected a number", place_of_field(i), fields[i]),
         (dialect == nullptr ? counted_from_one : *dialect).mend);
  return *value;
}

double DeckFields::number(std::size_t i) const {
  if (blank(i)) fail(place_of_field(i) + " is missing, expected a number", "complete the card");
  return number_or(i, 0.0);
}

long DeckFields::integer_or(std::size_t i, long fallback) const {
  constexpr double largest_whole = 1e15;  // beyond, a double skips whole numbers
  if (blank(i)) return fallback;
  const bool digits = is_whole_number(fields[i]);
  const double value = digits || !(dialect != nullptr && dialect->reals_have_points) ? number_or(i, 0.0) : 0.5;
  if (value != std::floor(value) || std::abs(value) > largest_whole)
    fail(fmt::format("{} is '{}', expected a whole number", place_of_field(i), fields[i]),
         (dialect == nullptr ? counted_from_one : *dialect).mend);
  return digits ? std::stol(fields[i]) : static_cast<long>(value);
}

long DeckFields::integer(std::size_t i) const {
  if (blank(i)) fail(place_of_field(i) + " is missing, expected a whole number", "complete the card");
  return integer_or(i, 0);
}

Eigen::Vector3d DeckFields::vector(std::size_t i) const {
  return {number_or(i, 0.0), number_or(i + 1, 0.0), number_or(i + 2, 0.0)};
}

int DeckFields::component(std::size_t i) const {
  const long component = integer(i);
  if (component < 1 || component > 6)
    fail(fmt::format("component {} is none of 1 to 6", component), "1-3 displacements, 4-6 rotations");
  return static_cast<int>(component) - 1;
}

std::optional<double> evaluate(const std::string& text, const Parameters& parameters) {
  if (text.empty()) return std::nullopt;
  return Parser(text, parameters).value();
}

}  // namespace twindeck::model_io
