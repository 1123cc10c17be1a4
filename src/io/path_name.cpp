#include "io/path_name.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace twindeck::io {

void check_path_name(const std::string& name, const std::string& what, const Place& place) {
  constexpr std::size_t longest = 100;  // [bytes] a name of a file may have 255, and a name of ours is made of two of them
  const auto forbidden = [](char letter) {
    return letter == '/' || letter == '\\' || static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
  };
  std::string problem;
  if (name.empty()) problem = "is empty";
  if (name.size() > longest) problem = "has " + std::to_string(name.size()) + " bytes, at most " + std::to_string(longest) + " are allowed";
  if (name.starts_with('.')) problem = "is '" + name + "', which begins with a point";
  if (std::any_of(name.begin(), name.end(), forbidden)) problem = "is '" + name + "', which holds a slash or a control character";
  if (problem.empty()) return;
  throw InputError(place, problem, "files are written under this name: choose another " + what + " name, such as low_with_dampers");
}

}  // namespace twindeck::io
