#include "core/error.hpp"

#include <algorithm>

#include "core/printable.hpp"

namespace twindeck {
namespace {

/// [bytes] Longest part of an input that a message repeats. A line of a terminal holds some hundred letters, a list of known
/// names holds more.
constexpr std::size_t kLongestName = 300, kLongestPart = 1500;

std::string compose(const Place& place, const std::string& problem, const std::string& mend) {
  std::string text;
  if (!place.file.empty()) {
    text += printable(place.file, kLongestPart);
    if (place.line > 0) text += ":" + std::to_string(place.line);
    text += ": ";
  }
  if (!place.key.empty()) text += printable(place.key, kLongestName) + ": ";
  text += printable(problem, kLongestPart);
  if (!mend.empty()) text += "; " + printable(mend, kLongestPart);
  return text;
}

/// Cost of a wrong letter, and of a letter in the wrong case. The second is smaller, so that among the columns x_m, y_m and z_m
/// the last is the nearest to "Z_m".
constexpr std::size_t kSlip = 2, kSlipOfCase = 1;

char lower(char letter) { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; }

std::size_t substitution_cost(char a, char b) { return a == b ? 0 : lower(a) == lower(b) ? kSlipOfCase : kSlip; }

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours (the commonest slip).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j * kSlip;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i * kSlip;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + substitution_cost(a[i - 1], b[j - 1]);
      now[j] = std::min({substitution, last[j] + kSlip, now[j - 1] + kSlip});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + kSlip);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

InputError::InputError(Place place, const std::string& problem, const std::string& mend)
    : std::runtime_error(compose(place, problem, mend)), place_(std::move(place)) {}

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
  std::string nearest;
  std::size_t smallest = std::string::npos;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    // Of the longer name, so that "Es" is near "E_s"; a single letter of the wrong case is near too.
    const std::size_t near = std::max(kSlipOfCase, kSlip * (std::max(name.size(), candidate.size()) / 3));
    const bool same_letters = std::ranges::equal(name, candidate, {}, lower, lower);
    if ((distance <= near || same_letters) && distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

void assertion_failed(const char* condition, const char* file, int line) {
  const std::string_view path = file;
  const std::size_t sources = path.rfind("src/");
  throw InternalError(std::string(sources == std::string_view::npos ? path : path.substr(sources)) + ":" +
                      std::to_string(line) + ": assertion failed: " + condition);
}

}  // namespace twindeck
