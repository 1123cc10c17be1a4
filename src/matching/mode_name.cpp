#include "matching/mode_name.hpp"

#include <fmt/format.h>

#include <charconv>
#include <set>
#include <string_view>

namespace twindeck::matching {

namespace {

constexpr std::size_t kMostDigits = 6;  ///< of a computed mode's number: no solver computes a million modes

/// "<measured mode>-<number>N"; nothing for any other text.
std::optional<NamedPair> parse(const std::string& entry) {
  const std::size_t dash = entry.find('-');
  if (dash == 0 || dash == std::string::npos || entry.find(' ') < dash) return std::nullopt;
  const std::optional<Eigen::Index> numerical = numerical_position(entry.substr(dash + 1));
  if (!numerical) return std::nullopt;
  return NamedPair{entry.substr(0, dash), *numerical};
}

}  // namespace

bool is_mode_name(const std::string& text) {
  std::string_view number = text;
  if (number.ends_with('X')) number.remove_suffix(1);
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::invalid_argument || end != number.data() + number.size()) return true;  // no number at all
  return !text.starts_with('0') && text.find_first_not_of("0123456789") >= text.size() - (text.ends_with('X') ? 1 : 0);
}

std::string experimental_label(const std::string& mode) { return mode.ends_with('X') ? mode : mode + "X"; }

std::string numerical_label(Eigen::Index position) { return fmt::format("{}N", position + 1); }

std::optional<Eigen::Index> numerical_position(const std::string& label) {
  const std::size_t digits = label.find_first_not_of("0123456789");
  if (digits == 0 || digits > kMostDigits || label.starts_with('0') || label.substr(digits) != "N") return std::nullopt;
  return std::stol(label) - 1;
}

std::vector<NamedPair> read_pairs(const std::vector<std::string>& entries, Eigen::Index n_numerical, const Place& place,
                                  const std::string& more_modes) {
  std::vector<NamedPair> pairs;
  std::set<std::string> seen;
  for (const std::string& entry : entries) {
    const std::optional<NamedPair> pair = parse(entry);
    if (!pair)
      throw InputError(place, fmt::format("'{}' is no pair, expected for example \"7X-8N\"", entry),
                       "name the measured mode, a dash, and the numerical mode");
    if (!seen.insert(pair->experimental).second || !seen.insert(numerical_label(pair->numerical)).second)
      throw InputError(place, fmt::format("pair '{}' names a mode that another pair names too", entry), "pair each mode once");
    if (pair->numerical >= n_numerical)
      throw InputError(place,
                       fmt::format("pair '{}' asks for numerical mode {} of {}", entry, pair->numerical + 1, n_numerical),
                       more_modes);
    pairs.push_back(*pair);
  }
  return pairs;
}

}  // namespace twindeck::matching
