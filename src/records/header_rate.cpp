#include "records/header_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>

#include "records/text_cells.hpp"

namespace twindeck::records {
namespace {

bool small_letter(char c) { return c >= 'a' && c <= 'z'; }
bool decimal_digit(char c) { return c >= '0' && c <= '9'; }
bool word_letter(char c) { return small_letter(c) || decimal_digit(c) || c == '_'; }

/// Reads a lower-case line from some place on. Each part is taken or, where it is not there, left.
class LineScanner {
 public:
  LineScanner(std::string_view text, std::size_t at) : text_(text), at_(std::min(at, text.size())) {}
  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  bool take_one_of(std::span<const std::string_view> words) {
    return std::any_of(words.begin(), words.end(), [this](std::string_view word) { return take(word); });
  }
  std::size_t take_any(std::string_view letters) {
    const std::size_t from = at_;
    while (at_ < text_.size() && letters.find(text_[at_]) != std::string_view::npos) ++at_;
    return at_ - from;
  }
  std::string_view take_word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && word_letter(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }
  /// What was taken since the place `from`.
  [[nodiscard]] std::string_view taken_since(std::size_t from) const { return text_.substr(from, at_ - from); }
  [[nodiscard]] bool ends_word() const { return at_ == text_.size() || !word_letter(text_[at_]); }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_;
};

using Words = std::span<const std::string_view>;

/// "sampling rate", "sample_frequency", "sampling": a word that begins with "sampl", and one of `endings` in it or after it.
/// @param needed  whether there must be an ending
bool take_sampling(LineScanner& in, Words endings, bool needed, bool& counts) {
  if (!in.take("sampl")) return false;
  const std::string_view word = in.take_word();
  counts = word == "e" || word == "es";  // "Samples: 12000" is their number
  if (std::any_of(endings.begin(), endings.end(), [&](std::string_view e) { return word.find(e) != std::string_view::npos; }))
    return true;
  LineScanner joined = in;
  joined.take_any(" _-");
  if (!joined.take_one_of(endings)) return !needed;
  joined.take_word();  // "uency" of "frequency"
  in = joined;
  counts = false;
  return true;
}

constexpr std::array<std::string_view, 2> kRateEndings = {"rate", "freq"};
constexpr std::array<std::string_view, 3> kIntervalEndings = {"interval", "period", "time"};

/// @param counts  set where the word may also count samples: then the number needs the unit of a rate
bool take_rate_word(LineScanner& in, bool word_begins, bool& counts) {
  if (take_sampling(in, kRateEndings, false, counts)) return true;
  LineScanner scan = in;
  if (scan.take("scan")) {
    scan.take_any(" _-");
    if (scan.take("rate")) {
      in = scan;
      return true;
    }
  }
  static constexpr std::array<std::string_view, 3> whole = {"abtastrate", "frequenza di campionamento",
                                                            "frequenza_di_campionamento"};
  if (in.take_one_of(whole)) return true;
  static constexpr std::array<std::string_view, 2> brief = {"fs", "sps"};
  LineScanner word = in;
  if (!word_begins || !word.take_one_of(brief) || !word.ends_word()) return false;
  in = word;
  return true;
}

bool take_interval_word(LineScanner& in, bool word_begins) {
  LineScanner sampling = in;
  bool counts = false;
  if (take_sampling(sampling, kIntervalEndings, true, counts)) {
    in = sampling;
    return true;
  }
  static constexpr std::array<std::string_view, 7> whole = {"delta t",   "delta_t",  "deltat",  "time step",
                                                            "time_step", "timestep", "interval"};
  if (in.take_one_of(whole)) return true;
  LineScanner word = in;
  if (!word_begins || !word.take("dt") || !word.ends_word()) return false;
  in = word;
  return true;
}

struct Statement {
  double number = 0.0;
  std::string_view unit;
};

/// What follows the keyword: a unit in brackets or none, a separator, a number, its unit or none.
std::optional<Statement> statement(LineScanner in, Words units) {
  Statement stated;
  bool parted = in.take_any(" \t\"") > 0;
  if (in.take_any("[(") > 0) {
    const std::size_t from = in.at();
    if (in.take_one_of(units)) stated.unit = in.taken_since(from);
    in.take_any("])");
  }
  parted = in.take_any(" \t\"") > 0 || parted;
  parted = in.take_any(":=;,") > 0 || parted;
  in.take_any(" \t\"");
  std::string number;
  for (const char c : in.rest().substr(0, 40)) {
    if (!decimal_digit(c) && c != '.' && c != ',' && c != 'e' && c != '-' && c != '+') break;
    number += c == ',' ? '.' : c;
  }
  if (!parted || number.empty() || !decimal_digit(number.front())) return {};
  char* end = nullptr;
  stated.number = std::strtod(number.c_str(), &end);
  LineScanner after(in.rest(), static_cast<std::size_t>(end - number.c_str()));
  after.take_any(" \t\"");
  const std::size_t from = after.at();
  if (after.take_one_of(units)) stated.unit = after.taken_since(from);
  return stated.number > 0.0 && std::isfinite(stated.number) ? std::optional(stated) : std::nullopt;
}

}  // namespace

std::optional<double> rate_in_header_line(std::string_view text) {
  const std::string line = lower(text);
  static constexpr std::array<std::string_view, 4> times = {"ms", "us", "sec", "s"}, rates = {"khz", "hz", "s/s", "sps"};
  for (const bool interval : {true, false}) {
    for (std::size_t at = 0; at < line.size(); ++at) {
      LineScanner in(line, at);
      const bool word_begins = at == 0 || !word_letter(line[at - 1]);
      bool counts = false;
      if (!(interval ? take_interval_word(in, word_begins) : take_rate_word(in, word_begins, counts))) continue;
      const auto stated = statement(in, interval ? Words(times) : Words(rates));
      if (!stated || (counts && stated->unit.empty())) continue;
      if (!interval) return stated->number * (stated->unit == "khz" ? 1000.0 : 1.0);
      return 1.0 / (stated->number * (stated->unit == "ms" ? 1e-3 : stated->unit == "us" ? 1e-6 : 1.0));
    }
  }
  return {};
}

bool is_time_name(std::string_view text) {
  const std::string name = lower(text);
  if (name.find("timestamp") != std::string::npos) return true;  // "sensorTimestamp_since1970"
  static constexpr std::array<std::string_view, 19> words = {
      "time stamp", "time_stamp", "time",    "zeit", "zeitstempel", "uhrzeit", "tempo", "tiempo", "datum", "date",
      "datetime",   "data/ora",   "elapsed", "sec",  "seconds",     "epoch",   "utc",   "millis", "t"};
  const auto ends = [&](std::size_t at) { return at >= name.size() || !small_letter(name[at]); };
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (at > 0 && small_letter(name[at - 1])) continue;
    for (const std::string_view word : words) {
      if (!std::string_view(name).substr(at).starts_with(word)) continue;
      std::size_t end = at + word.size();
      if (ends(end)) return true;
      if (name[end] == ' ' || name[end] == '_') ++end;  // "time_s", "tms"
      if (name.compare(end, 2, "ms") == 0 && ends(end + 2)) return true;
      if (name.compare(end, 1, "s") == 0 && ends(end + 1)) return true;
    }
  }
  return false;
}

}  // namespace twindeck::records
