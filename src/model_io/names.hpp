#pragma once

#include <string>
#include <vector>

#include "fe/model.hpp"

/// The words that model folders use for the enumerations of fe::Model, and the order of directions.
namespace twindeck::model_io {

/// "x", "y", "z", "rx", "ry", "rz": degree of freedom 0-5 of a node.
[[nodiscard]] const std::vector<std::string>& direction_names();
/// "beam", "bar", "stay", "shell", "solid" in the order of fe::ElementType.
[[nodiscard]] const std::vector<std::string>& element_type_names();
/// "youngs_modulus", "density", … "point_mass" in the order of fe::Target (those of a model folder, not of a matrix model).
[[nodiscard]] const std::vector<std::string>& target_names();
/// "none", "given", "shape_finding" in the order of fe::PullRule.
[[nodiscard]] const std::vector<std::string>& pull_rule_names();

/// Position of `name` in `names`, or -1.
[[nodiscard]] int position_of(const std::string& name, const std::vector<std::string>& names);
/// "a, b or c": the allowed words of a message.
[[nodiscard]] std::string one_of(const std::vector<std::string>& names);

[[nodiscard]] inline const std::string& name_of(fe::ElementType type) {
  return element_type_names()[static_cast<std::size_t>(type)];
}

}  // namespace twindeck::model_io
