#pragma once

#include <functional>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::model_io {

/// Calls f on every number by which an element, spring, link, constraint or mass names a node; -1 is no node and left out.
/// Supports are not among them: a support alone joins a node to nothing.
void for_each_joined_node(fe::Model& model, const std::function<void(int&)>& f);

/// Gives the nodes another order, or leaves some out.
/// @param now  new position of each node (n_nodes); -1: left out, with its supports. No element, spring, link, constraint or
///             mass may name a node that is left out.
void renumber_nodes(fe::Model& model, const std::vector<int>& now);

}  // namespace twindeck::model_io
