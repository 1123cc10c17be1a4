#include "model_io/node_references.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace twindeck::model_io {

void for_each_joined_node(fe::Model& model, const std::function<void(int&)>& f) {
  const auto named = [&](int& node) {
    if (node >= 0) f(node);
  };
  for (fe::Element& e : model.elements) std::for_each(e.nodes.begin(), e.nodes.end(), named);
  for (fe::Spring& s : model.springs) named(s.node), named(s.node2);
  for (fe::MatrixElement& e : model.matrix_elements) {
    for (fe::MatrixElement::Dof& dof : e.dofs) named(dof.node);
  }
  for (fe::RigidLink& link : model.links) named(link.master), named(link.slave);
  for (fe::Constraint& c : model.constraints) {
    named(c.node);
    for (fe::Constraint::Term& term : c.terms) named(term.node);
  }
  for (fe::PointMass& mass : model.masses) named(mass.node);
}

void renumber_nodes(fe::Model& model, const std::vector<int>& now) {
  TWINDECK_ASSERT(now.size() == model.nodes.size());
  std::vector<fe::Node> nodes(static_cast<std::size_t>(std::count_if(now.begin(), now.end(), [](int to) { return to >= 0; })));
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] >= 0) nodes[static_cast<std::size_t>(now[i])] = std::move(model.nodes[i]);
  }
  model.nodes = std::move(nodes);
  for_each_joined_node(model, [&](int& node) { node = now[static_cast<std::size_t>(node)]; });
  for (fe::Support& support : model.supports) support.node = now[static_cast<std::size_t>(support.node)];
  std::erase_if(model.supports, [](const fe::Support& support) { return support.node < 0; });
}

}  // namespace twindeck::model_io
