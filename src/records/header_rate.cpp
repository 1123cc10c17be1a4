#include "records/header_rate.hpp"

#include <charconv>
#include <regex>
#include <string>

#include "core/letters.hpp"

namespace twindeck::records {
namespace {

/// A quantity that a header may state: its keywords, and what follows them, a unit in brackets (2) or none, a separator, a
/// number (5), its unit (6) or none. A separator is blanks before (1) or behind (3) the brackets or a sign (4).
struct Stated {
  std::regex keyword, value;
};

std::regex value_with(const std::string& units) {
  return std::regex(R"re(([ \t"]*)(?:[[(]+()re" + units +
                    R"re()?[\])]*([ \t"]*))?([:=;,]*)[ \t"]*)re"
                    R"re(((?:\d+(?:[.,]\d*)?|\.\d+)(?:e[+-]?\d+)?)(?:[ \t"]*()re" +
                    units + "))?");
}

/// "sampling rate", "sample_frequency", "sampling": the ending stands in the word that begins with "sampl" or behind it.
/// "samples" (1) may also count them: then the number needs the unit of a rate.
const Stated& stated_rate() {
  static const Stated rate{
      std::regex(R"(sampl\w*(?:rate|freq)\w*\b|sampl\w*\b[ _-]*(?:rate|freq)\w*|sampl(es?\b)|sampl\w*)"
                 "|scan[ _-]*rate|abtastrate|messrate|frequenza di campionamento|frequenza_di_campionamento"
                 R"(|\bfs\b|\bsps\b)"),
      value_with("khz|hz|s/s|sps")};
  return rate;
}

const Stated& stated_interval() {
  static const Stated interval{std::regex(R"(sampl\w*(?:interval|period|time)\w*\b|sampl\w*\b[ _-]*(?:interval|period|time)\w*)"
                                          R"(|delta[ _]?t|time[ _]?step|interval|\bdt(?:_[mu]?s)?\b)"),
                               value_with("ms|us|sec|s")};
  return interval;
}

}  // namespace

std::optional<double> rate_in_header_line(std::string_view text) {
  constexpr std::ptrdiff_t longest = 300;  // letters of a statement; a regular expression needs memory for each
  const std::string line = lower_case(text);
  for (const bool interval : {true, false}) {
    const Stated& stated = interval ? stated_interval() : stated_rate();
    for (auto at = line.begin(); at != line.end(); ++at) {
      const auto end = line.end() - at > longest ? at + longest : line.end();
      const auto before = at == line.begin() ? std::regex_constants::match_default : std::regex_constants::match_prev_avail;
      std::smatch keyword, value;
      if (!std::regex_search(at, end, keyword, stated.keyword, before | std::regex_constants::match_continuous) ||
          !std::regex_search(keyword[0].second, end, value, stated.value, std::regex_constants::match_continuous))
        continue;
      const bool parted = value.length(1) + value.length(3) + value.length(4) > 0, counts = keyword[1].matched;
      const std::string word = keyword[0];  // "sampling_period_us"
      const std::string unit = value[6].matched   ? value[6]
                               : value[2].matched ? value[2].str()
                                                  : word.substr(word.rfind('_') + 1);
      std::string digits = value[5];
      if (const std::size_t comma = digits.find(','); comma != std::string::npos) digits[comma] = '.';
      double number = 0.0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (!parted || number <= 0.0 || (counts && !value[6].matched && !value[2].matched)) continue;
      if (!interval) return number * (unit == "khz" ? 1000.0 : 1.0);
      return 1.0 / (number * (unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : 1.0));
    }
  }
  return {};
}

bool is_time_name(std::string_view text) {
  static const std::regex time(
      "timestamp"  // "sensorTimestamp_since1970"
      "|(?:^|[^a-z])(?:time|zeit|zeitstempel|uhrzeit|tempo|tiempo|datum|date|datetime|data/ora|elapsed|sec|seconds|epoch|utc"
      "|millis|t(?!\\d))(?:m?s)?(?![a-z])");  // "time_s", "tms"; T09y is a sensor
  return std::regex_search(lower_case(text), time);
}

std::optional<long> samples_in_header_line(std::string_view text) {
  static const std::regex stated(
      R"(\bnpts\b\W{0,9}(\d{2,9})\b|\b(\d{2,9}) samples\b|number of (?:points|samples)\W{0,9}(\d{2,9})\b)");
  const std::string line = lower_case(text.substr(0, 300));  // a regular expression needs memory for each letter
  std::smatch found;
  if (!std::regex_search(line, found, stated)) return std::nullopt;
  return std::stol(found[1].matched ? found[1] : found[2].matched ? found[2] : found[3]);
}

}  // namespace twindeck::records
