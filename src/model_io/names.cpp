#include "model_io/names.hpp"

#include <algorithm>

namespace twindeck::model_io {

const std::vector<std::string>& direction_names() {
  static const std::vector<std::string> names = {"x", "y", "z", "rx", "ry", "rz"};
  return names;
}

const std::vector<std::string>& element_type_names() {
  static const std::vector<std::string> names = {"beam", "bar", "stay", "shell", "solid"};
  return names;
}

const std::vector<std::string>& target_names() {
  static const std::vector<std::string> names = {"youngs_modulus", "density",          "thickness", "bending_inertia_ratio",
                                                 "area",           "spring_stiffness", "point_mass"};
  return names;
}

const std::vector<std::string>& pull_rule_names() {
  static const std::vector<std::string> names = {"none", "given", "shape_finding"};
  return names;
}

int position_of(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace twindeck::model_io
