#include "fe/stay_chains.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

/// Nodes of one chain, ends included; adds those between.
std::vector<int> hang(Model& model, const Element& stay, double pull_N, int pieces, long& next_id) {
  const auto ends = end_nodes(model, stay);
  const double length = (ends[1] - ends[0]).norm();
  const double mass_per_length = material_of(model, stay).density_kg_m3 * section_of(model, stay).area_m2;
  const double sag = mass_per_length * model.gravity_m_s2 * length * length / (8.0 * pull_N);
  std::vector<int> nodes = {stay.nodes[0]};
  for (int k = 1; k < pieces; ++k) {
    const double xi = static_cast<double>(k) / pieces;
    Eigen::Vector3d x = ends[0] + xi * (ends[1] - ends[0]);
    x.z() -= 4.0 * sag * xi * (1.0 - xi);
    nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back({next_id++, x});
  }
  nodes.push_back(stay.nodes[1]);
  return nodes;
}

}  // namespace

StayChains with_stay_chains(const Model& model, const PrestressState& state, int pieces,
                            const std::vector<std::string>& names) {
  TWINDECK_ASSERT(pieces >= 2 && state.stay_pull_N.size() == std::ssize(model.elements));
  StayChains out{model, state, {}};
  long node_id = 0, element_id = 0;
  for (const Node& node : model.nodes) node_id = std::max(node_id, node.id + 1);
  for (const Element& element : model.elements) element_id = std::max(element_id, element.id + 1);
  std::vector<Element> added;
  std::vector<double> pull_of_added;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& stay = model.elements[i];
    if (stay.type != ElementType::stay || std::find(names.begin(), names.end(), stay.name) == names.end()) continue;
    const double pull = state.stay_pull_N[static_cast<Eigen::Index>(i)];
    if (pull <= 0.0)
      throw InputError({model.source, 0, stay.name}, "has no pull, a chain of it would not hang", "give the model a prestress");
    const std::vector<int> nodes = hang(out.model, stay, pull, pieces, node_id);
    out.nodes[stay.name] = nodes;
    out.model.elements[i].nodes = {nodes[0], nodes[1]};
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      Element piece = stay;
      piece.id = element_id++;
      piece.name = stay.name + "." + std::to_string(k + 1);
      piece.nodes = {nodes[k], nodes[k + 1]};
      added.push_back(piece);
      pull_of_added.push_back(pull);
    }
  }
  for (const std::string& name : names) {
    if (!out.nodes.contains(name))
      throw InputError({model.source, 0, "stays"}, "'" + name + "' is no stay of the model", "name stays such as NE8");
  }
  const Eigen::Index n_before = state.stay_pull_N.size(), n_added = std::ssize(added);
  out.model.elements.insert(out.model.elements.end(), added.begin(), added.end());
  out.state.stay_pull_N.conservativeResize(n_before + n_added);
  out.state.axial_force_N.conservativeResize(n_before + n_added);
  for (Eigen::Index k = 0; k < n_added; ++k) {
    out.state.stay_pull_N[n_before + k] = pull_of_added[static_cast<std::size_t>(k)];
    out.state.axial_force_N[n_before + k] = 0.0;
  }
  return out;
}

}  // namespace twindeck::fe
