#include "fe/swinging_stays.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fe/cable.hpp"

namespace twindeck::fe {

std::string stay_name(const Element& stay) { return stay.name.empty() ? std::to_string(stay.id) : stay.name; }

Model with_swinging_stays(Model model, const std::vector<SwingingStay>& stays, int pieces) {
  constexpr long million = 1000000;
  long id = 0;
  for (const Node& node : model.nodes) id = std::max(id, node.id);
  id = (id / million + 1) * million;
  for (const SwingingStay& swinging : stays) {
    TWINDECK_ASSERT(swinging.element >= 0 && swinging.element < std::ssize(model.elements));
    const Element stay = model.elements[static_cast<std::size_t>(swinging.element)];
    const Cable cable = cable_beyond_bar(model, stay, swinging.force_N, pieces);
    MatrixElement element;
    element.name = "cable_" + stay_name(stay);
    element.group = "cables";
    std::vector<int> nodes = stay.nodes;
    for (const Eigen::Vector3d& x : cable.inner_x_m) {
      nodes.push_back(static_cast<int>(model.nodes.size()));
      model.nodes.push_back({id++, x});
    }
    for (const int node : nodes)
      for (int d = 0; d < 3; ++d) element.dofs.push_back({node, d});
    element.stiffness = cable.stiffness;
    element.mass = cable.mass;
    model.matrix_elements.push_back(std::move(element));
  }
  return model;
}

}  // namespace twindeck::fe
