#include "records/universal_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "io/regular_file.hpp"

namespace twindeck::records {

UniversalLines::UniversalLines(const std::filesystem::path& file)
    : file_(file), bytes_(io::require_regular_file(file)), in_(file, std::ios::binary) {
  if (!in_) throw InputError({file.string(), 0, ""}, "cannot be read", "check its name and your permissions");
}

bool UniversalLines::next(std::string& line) {
  if (has_back_) {
    line = back_;
    has_back_ = false;
    ++number_;
    return true;
  }
  if (!std::getline(in_, line)) return false;
  without_end_ = in_.eof();
  ++number_;
  while (!line.empty() && line.back() == '\r') line.pop_back();
  if (line.size() > 100000) fail("has a line of over a hundred thousand characters", "is a binary set without the letter b?");
  return true;
}

std::string UniversalLines::need(const std::string& what) {
  std::string line;
  if (!next(line)) fail("breaks off in " + what, "the file was cut off; copy it again");
  return line;
}

void UniversalLines::back(const std::string& line) {
  back_ = line;
  has_back_ = true;
  --number_;
}

std::string UniversalLines::bytes(std::size_t n) {
  std::string data(n, '\0');
  in_.read(data.data(), static_cast<std::streamsize>(n));
  data.resize(static_cast<std::size_t>(in_.gcount()));
  return data;
}

std::string UniversalLines::take(std::size_t n) {
  std::string data = bytes(n);
  without_end_ = false;
  number_ += std::ranges::count(data, '\n');
  return data;
}

std::string UniversalLines::peek(std::size_t offset, std::size_t n) {
  const std::streampos here = in_.tellg();
  in_.seekg(static_cast<std::streamoff>(offset), std::ios::cur);
  const std::string data = bytes(n);
  in_.clear();
  in_.seekg(here);
  return data;
}

void UniversalLines::fail(const std::string& problem, const std::string& mend) const {
  throw InputError({file_.string(), number_, ""}, problem, mend);
}

std::string need_inside(UniversalLines& in, const std::string& what) {
  const std::string line = in.need(what);
  if (is_delimiter(line)) in.fail(what + " ends too early", "write the set again");
  return line;
}

long label_of(UniversalLines& in, double number) {
  constexpr long most = 1L << 53U;  // whole numbers that a double tells apart
  const auto size = count_in(std::abs(number), most);
  if (!size) in.fail(fmt::format("holds {:.6g}, expected a whole number", number), "write the set again");
  return number < 0.0 ? -*size : *size;
}

bool is_delimiter(const std::string& line) { return without_blanks(line, " \t") == "-1"; }

std::string field(const std::string& line, std::size_t from, std::size_t width) {
  return from < line.size() ? std::string(without_blanks(std::string_view(line).substr(from, width), " \t")) : "";
}

bool is_blank(const std::string& line) { return line.find_first_not_of(" \t\x1a") == std::string::npos; }

std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> numbers;
  std::size_t at = 0;
  const auto is_digit = [&](std::size_t i) { return i < line.size() && line[i] >= '0' && line[i] <= '9'; };
  while (at < line.size()) {
    std::size_t i = at;
    std::string text;
    if (line[i] == '-' || line[i] == '+') text += line[i++] == '-' ? "-" : "";
    const std::size_t digits = i;
    while (is_digit(i)) text += line[i++];
    if (i < line.size() && line[i] == '.') {
      text += line[i++];
      while (is_digit(i)) text += line[i++];
    }
    if (i == digits || (i == digits + 1 && line[digits] == '.')) {
      ++at;
      continue;
    }
    if (i < line.size() && std::string("EeDd").find(line[i]) != std::string::npos) {
      std::size_t k = i + 1;
      std::string exponent = "e";
      if (k < line.size() && (line[k] == '-' || line[k] == '+')) exponent += line[k++];
      if (is_digit(k)) {
        while (is_digit(k)) exponent += line[k++];
        if (exponent[1] == '+') exponent.erase(1, 1);
        text += exponent;
        i = k;
      }
    } else if (i + 1 < line.size() && (line[i] == '-' || line[i] == '+') && is_digit(i + 1) &&
               text.find('.') != std::string::npos && i + 4 >= line.size() &&
               line.find_first_of(" \t", i) == std::string::npos) {
      // "1.0-100": a three-digit exponent without its letter
      text += "e" + line.substr(line[i] == '+' ? i + 1 : i);
      i = line.size();
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // For numbers out of range strtod gives infinity or the nearest number to zero, from_chars nothing.
    numbers.push_back(error == std::errc::result_out_of_range ? std::strtod(text.c_str(), nullptr) : value);
    at = i;
  }
  return numbers;
}

std::optional<long> count_in(double number, long most) {
  if (!(number >= 0.0) || number > static_cast<double>(most) || number != std::floor(number)) return {};
  return static_cast<long>(number);
}

long integer_or(const std::string& text, long fallback) {
  long value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  return error == std::errc() && end != begin ? value : fallback;
}

}  // namespace twindeck::records
