#include "records/time_stamp.hpp"

#include <cmath>

namespace twindeck::records {
namespace {

/// Days since 1970-01-01 of the proleptic Gregorian calendar. Reference: Hinnant, "chrono-compatible low-level date
/// algorithms".
long days_of(long year, long month, long day) {
  year -= month <= 2 ? 1 : 0;
  const long era = (year >= 0 ? year : year - 399) / 400;
  const long of_era = year - era * 400, of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads numbers and the characters between them.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) { skip_blanks(); }
  bool number(long& value, int& digits) {
    value = 0;
    digits = 0;
    while (at_ < text_.size() && is_digit(text_[at_]) && digits < 9) {
      value = value * 10 + (text_[at_++] - '0');
      ++digits;
    }
    return digits > 0;
  }
  bool one_of(std::string_view characters) {
    if (at_ >= text_.size() || characters.find(text_[at_]) == std::string_view::npos) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '"')) ++at_;
  }
  [[nodiscard]] std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }
  [[nodiscard]] bool done() {
    skip_blanks();
    return at_ >= text_.size();
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// hh:mm[:ss[.fff]] [AM|PM|Z]
std::optional<double> time_of_day(Scanner& in) {
  long hour = 0, minute = 0, second = 0;
  int digits = 0;
  if (!in.number(hour, digits) || digits > 2 || !in.one_of(":") || !in.number(minute, digits) || digits > 2) return {};
  double fraction = 0.0;
  if (in.one_of(":")) {
    if (!in.number(second, digits) || digits > 2) return {};
    if (in.one_of(".,:")) {
      long value = 0;
      if (in.number(value, digits)) fraction = static_cast<double>(value) * std::pow(10.0, -digits);
    }
  }
  in.skip_blanks();
  const bool pm = in.one_of("pP"), am = !pm && in.one_of("aA");
  if (pm || am) {
    if (!in.one_of("mM")) return {};
    hour = hour % 12 + (pm ? 12 : 0);
  } else {
    in.one_of("zZ");
  }
  if (hour > 24 || minute > 59 || second > 60 || !in.done()) return {};
  return static_cast<double>(hour * 3600 + minute * 60 + second) + fraction;
}

}  // namespace

std::vector<double> time_stamp_meanings(std::string_view text) {
  if (text.find(':') == std::string_view::npos) return {};
  {
    Scanner in(text);
    if (const auto time = time_of_day(in)) return {*time};
  }
  Scanner in(text);
  long a = 0, b = 0, c = 0;
  int a_digits = 0, digits = 0, c_digits = 0;
  if (!in.number(a, a_digits) || !in.one_of("-./") || !in.number(b, digits) || !in.one_of("-./") || !in.number(c, c_digits))
    return {};
  in.one_of("Tt_");
  in.skip_blanks();
  const auto time = time_of_day(in);
  if (!time) return {};
  std::vector<double> meanings;
  const auto add = [&](long year, long month, long day) {
    if (year < 100) year += year < 70 ? 2000 : 1900;
    if (month >= 1 && month <= 12 && day >= 1 && day <= 31)
      meanings.push_back(86400.0 * static_cast<double>(days_of(year, month, day)) + *time);
  };
  if (a_digits == 4) {
    add(a, b, c);
    if (b != c) add(a, c, b);
  } else {
    add(c, b, a);
    if (a != b) add(c, a, b);
  }
  return meanings;
}

std::optional<double> TimeStampReader::next(std::string_view text) {
  const std::vector<double> meanings = time_stamp_meanings(text);
  if (meanings.empty()) return {};
  std::size_t best = month_first_ && meanings.size() > 1 ? 1 : 0;
  if (last_) {
    for (std::size_t i = 0; i < meanings.size(); ++i) {
      const double step = meanings[i] - *last_, best_step = meanings[best] - *last_;
      if ((step >= 0.0 && best_step < 0.0) || (step >= 0.0 && step < best_step)) best = i;
    }
  }
  if (meanings.size() > 1 && best == 1) ++exchanged_;
  last_ = meanings[best];
  return meanings[best];
}

}  // namespace twindeck::records
