#pragma once

#include <string>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::dynamics {

/// What of a mesh may be meant but seldom is: two nodes at one place that nothing joins (no link, equation, spring or matrix,
/// no element that touches an element of either), so that the structure is cut there, and an element that is listed twice
/// (type, nodes, material and section), which stiffens and weighs twice. Nodes that no element holds do not count. Shells too
/// thick for thin-plate theory are named too. @return one line each, with the names; empty for none
[[nodiscard]] std::vector<std::string> doubtful_mesh(const fe::Model& model);

}  // namespace twindeck::dynamics
