#include "fe/mixed_sides.hpp"

#include <algorithm>
#include <set>

#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

std::vector<std::uint8_t> sides_beside_four_nodes(const Model& model) {
  std::vector<std::uint8_t> straight(model.elements.size(), 0);
  if (std::none_of(model.elements.begin(), model.elements.end(), is_triangle)) return straight;
  const auto side = [](const Element& e, std::size_t i) {
    return std::minmax({e.nodes[i], e.nodes[(i + 1) % e.nodes.size()]});
  };
  std::set<std::pair<int, int>> of_four;
  for (const Element& e : model.elements)
    for (std::size_t i = 0; e.type == ElementType::shell && e.nodes.size() == 4 && i < 4; ++i) of_four.insert(side(e, i));
  for (std::size_t k = 0; k < straight.size(); ++k) {
    const Element& e = model.elements[k];
    for (std::size_t i = 0; is_triangle(e) && i < 3; ++i)
      if (of_four.contains(side(e, i))) straight[k] = static_cast<std::uint8_t>(straight[k] | (1U << i));
  }
  return straight;
}

}  // namespace twindeck::fe
