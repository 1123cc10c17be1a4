#include "core/error.hpp"

#include <algorithm>
#include <numeric>

#include "core/printable.hpp"

namespace twindeck {
namespace {

/// What of an input is echoed at most [bytes]: a line of a terminal holds some hundred letters, a list of known names some
/// more.
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

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours (the commonest slip).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({substitution, last[j] + 1, now[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
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
    const std::size_t near = std::max(name.size(), candidate.size()) / 3;  // letters of the longer name: "Es" is near "E_s"
    if (distance <= near && distance < smallest) {
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
