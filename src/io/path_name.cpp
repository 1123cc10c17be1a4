#include "io/path_name.hpp"

#include <algorithm>
#include <string_view>

#include "core/error.hpp"

namespace twindeck::io {
namespace {

bool is_control(char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; }

}  // namespace

void check_path_name(const std::string& name, const std::string& what, const Place& place) {
  constexpr std::size_t longest = 100;  // [bytes] a name of a file may have 255, and a name of ours is made of two of them
  const auto forbidden = [](char letter) { return letter == '/' || letter == '\\' || is_control(letter); };
  std::string problem;
  if (name.empty()) problem = "is empty";
  if (name.size() > longest)
    problem = "has " + std::to_string(name.size()) + " bytes, at most " + std::to_string(longest) + " are allowed";
  if (name.starts_with('.')) problem = "is '" + name + "', which begins with a point";
  if (std::ranges::any_of(name, forbidden)) problem = "is '" + name + "', which holds a slash or a control character";
  if (problem.empty()) return;
  throw InputError(place, problem,
                   "files are written under this name: choose another " + what + " name, such as low_with_dampers");
}

void check_inner_name(const std::string& name, const std::string& what, const Place& place) {
  constexpr std::string_view slashes = "/\\";
  std::string problem;
  if (name.empty()) problem = "is empty";
  if (std::ranges::any_of(name, is_control)) problem = "is '" + name + "', which holds a control character";
  if (!name.empty() && slashes.find(name.front()) != std::string_view::npos)
    problem = "is '" + name + "', which begins with a slash";
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find_first_of(slashes, at), name.size());
    const std::string part = name.substr(at, end - at);
    if (part == "." || part == "..") problem = "is '" + name + "', which leads out of a folder";
    at = end + 1;
  }
  if (!problem.empty()) throw InputError(place, problem, "choose another " + what + " name, such as A_x");
}

}  // namespace twindeck::io
