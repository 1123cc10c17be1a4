#include "records/time_stamp.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "core/letters.hpp"

namespace twindeck::records {
namespace {

constexpr double kHour_s = 3600.0, kDay_s = 86400.0;  ///< [s]

bool is_digit(char c) { return c >= '0' && c <= '9'; }

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
    if (!is_at(characters)) return false;
    ++at_;
    return true;
  }
  /// Letters from here on, those beyond ASCII too.
  std::string_view word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && (std::isalpha(static_cast<unsigned char>(text_[at_])) != 0 || (text_[at_] & 0x80) != 0)) ++at_;
    return text_.substr(from, at_ - from);
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '"')) ++at_;
  }
  [[nodiscard]] bool is_at(std::string_view characters) const {
    return at_ < text_.size() && characters.find(text_[at_]) != std::string_view::npos;
  }
  [[nodiscard]] bool done() {
    skip_blanks();
    return at_ >= text_.size();
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// 1 to 12 by the first letters of a month's name in English, German, Italian, Spanish or French; 0 for another word.
long month_of(std::string_view word) {
  static constexpr std::string_view months =
      "01jan 01gen 01ene 02feb 02fev 02f\xC3\xA9v 03mar 03m\xC3\xA4r 03mrz 04apr 04abr 04avr 05may 05mai 05mag 06jun 06giu "
      "06juin 07jul 07lug 07juil 08aug 08ago 08ao\xC3\xBB 09sep 09set 10oct 10okt 10ott 11nov 12dec 12dez 12dic 12d\xC3\xA9"
      "c";
  const std::string name = lower_case(word);
  for (const std::size_t letters : {4, 3}) {
    const std::size_t at = name.size() < letters ? std::string::npos : months.find(name.substr(0, letters));
    if (at != std::string::npos && months[at - 1] <= '9') return 10 * (months[at - 2] - '0') + months[at - 1] - '0';
  }
  return 0;
}

struct DayTime {
  double seconds = 0.0;  ///< since midnight, by the clock that was read
  double ahead = 0.0;    ///< [s] of UTC
};

/// "Z", "UTC", "CEST", "+02:00", "-0530", or nothing: whether a time zone ends the text.
/// @param name  letters before the scanner's place @param ahead  [s] of UTC by an offset in numbers
bool ends_in_zone(Scanner& in, std::string_view name, double& ahead) {
  constexpr std::size_t longest = 5;  // letters
  const bool capitals = std::ranges::all_of(name, [](char c) { return c >= 'A' && c <= 'Z'; });
  if (name != "z" && (!capitals || name.size() > longest)) return false;
  const double sign = in.is_at("-") ? -1.0 : 1.0;
  if (!in.one_of("+-")) return in.done();
  long hours = 0, minutes = 0;
  int digits = 0;
  if (!in.number(hours, digits) || digits > 4 || (in.one_of(":") && !in.number(minutes, digits))) return false;
  ahead = sign * static_cast<double>(hours > 99 ? hours / 100 * 3600 + hours % 100 * 60 : hours * 3600 + minutes * 60);
  return in.done();
}

/// hh:mm[:ss[.fff]] [AM|PM] [zone]; hours above 24 since a start; mm:ss.fff, as Excel shows times; behind a date hhmmss[.fff]
/// too.
std::optional<DayTime> time_of_day(Scanner& in, bool behind_date) {
  long hour = 0, minute = 0, second = 0, part = 0;
  int digits = 0;
  bool second_is_there = false;
  if (!in.number(hour, digits)) return {};
  if (behind_date && (digits == 5 || digits == 6)) {  // 93000 is half past nine as a number
    second = hour % 100;
    minute = hour / 100 % 100;
    hour /= 10000;
  } else if (digits > (behind_date ? 2 : 3) || !in.one_of(":") || !in.number(minute, digits) || digits > 2) {
    return {};
  } else if (in.one_of(":")) {
    second_is_there = in.number(second, digits) && digits <= 2;
    if (!second_is_there) return {};
  } else if (in.is_at(".,")) {
    second = std::exchange(minute, std::exchange(hour, 0));
  }
  const double fraction =
      in.one_of(".,:") && in.number(part, digits) ? static_cast<double>(part) * std::pow(10.0, -digits) : 0.0;
  in.skip_blanks();
  std::string_view word = in.word();
  if (const std::string half = lower_case(word); half == "am" || half == "pm") {
    hour = hour % 12 + (half == "pm" ? 12 : 0);
    in.skip_blanks();
    word = in.word();
  }
  DayTime time{static_cast<double>(hour * 3600 + minute * 60 + second) + fraction, 0.0};
  const bool elapsed = !behind_date && second_is_there && word.empty() && in.done();  // 100:00:00 since a start
  if ((hour > 24 && !elapsed) || minute > 59 || second > 60 || !ends_in_zone(in, word, time.ahead)) return {};
  return time;
}

/// Days since 1970 that the date at the scanner's place may mean: numbers and perhaps a month's name, a weekday before them.
std::vector<double> days_at(Scanner& in) {
  std::array<long, 3> part{};
  int first_digits = 0, digits = 0, named = -1;
  bool loose = false;
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && !in.one_of("-./")) {
      if (first_digits == 8) break;  // 20240517
      loose = in.one_of(" ,");
      if (!loose) return {};
    }
    in.skip_blanks();
    long& value = part[static_cast<std::size_t>(k)];
    std::string_view word = in.word();
    value = month_of(word);
    if (k == 0 && !word.empty() && value == 0) {  // a weekday
      in.one_of(".,");
      in.skip_blanks();
      word = in.word();
      value = month_of(word);
    }
    if (value > 0) named = k;
    if (value > 0) continue;
    if (!word.empty() || !in.number(value, digits) || (digits > (k == 1 ? 2 : 4) && (k > 0 || digits != 8))) return {};
    if (k == 0) first_digits = digits;
  }
  if (named == 2 || (loose && named < 0)) return {};
  std::vector<double> days;
  const auto add = [&](long year, long month, long day) {
    if (month < 1 || month > 12 || day < 1 || day > 31) return;
    days.push_back(days_since_1970(static_cast<int>(year), static_cast<unsigned>(month), static_cast<int>(day)));
  };
  const auto [a, b, c] = part;
  if (first_digits == 8) {
    add(a / 10000, a / 100 % 100, a % 100);
  } else if (named == 0) {
    add(c, a, b);
  } else if (first_digits == 4) {
    add(a, b, c);
    if (b != c && named < 0) add(a, c, b);
  } else {
    add(c, b, a);
    if (a != b && named < 0) add(c, a, b);
  }
  return days;
}

/// mm:ss.fff, which begins anew each hour.
bool is_minutes(std::string_view text) {
  const std::size_t colon = text.find(':');
  return colon == text.rfind(':') && text.find_first_of(".,", colon) != std::string_view::npos && colon <= 2;
}

}  // namespace

double days_since_1970(int year, unsigned month, int day) {
  const std::chrono::year full(year + (year >= 100 ? 0 : year < 70 ? 2000 : 1900));
  return static_cast<double>(std::chrono::sys_days(full / std::chrono::month(month) / 1).time_since_epoch().count() + day - 1);
}

std::vector<double> time_stamp_meanings(std::string_view text) {
  if (text.find_first_of(":T_ ") == std::string_view::npos || text.find_first_of("0123456789") == std::string_view::npos)
    return {};
  {
    Scanner in(text);
    if (const auto time = time_of_day(in, false)) return {time->seconds};
  }
  Scanner in(text);
  std::vector<double> meanings = days_at(in);
  in.one_of("Tt_,:");
  in.skip_blanks();
  const auto time = meanings.empty() ? std::nullopt : time_of_day(in, true);
  if (!time) return {};
  for (double& meaning : meanings) meaning = kDay_s * meaning + time->seconds - time->ahead;
  return meanings;
}

bool is_date(std::string_view cell) {
  constexpr std::size_t longest = 30;  // letters
  return !cell.empty() && cell.size() <= longest && time_stamp_meanings(cell).empty() &&
         !time_stamp_meanings(std::string(cell) + " 0:00").empty();
}

std::optional<double> TimeStampReader::next(std::string_view text) {
  std::vector<double> meanings = time_stamp_meanings(text);
  if (meanings.empty()) return {};
  if (is_minutes(text)) {
    constexpr double least = 0.98;  // [h] least step back that is a full hour passed
    if (!last_.empty() && last_[0] - hours_ - meanings[0] > least * kHour_s) hours_ += kHour_s;
    meanings[0] += hours_;
  }
  std::size_t best = 0, before = taken_;
  const auto step = [&](std::size_t now, std::size_t then) { return std::abs(meanings[now] - last_[then]); };
  for (std::size_t now = 0; now < meanings.size(); ++now)
    for (std::size_t then = 0; then < last_.size(); ++then)
      if (step(now, then) < step(best, before) - 1.0) best = now, before = then;
  if (before != taken_) {  // the stamps so far had the other meaning: their clock goes on
    shift_ += last_[taken_] - last_[before];
    usual_ = before;
    exchanged_ = 0;
  }
  if (meanings.size() > 1 && best != usual_) ++exchanged_;
  taken_ = best;
  last_ = std::move(meanings);
  return last_[taken_] + shift_;
}

}  // namespace twindeck::records
