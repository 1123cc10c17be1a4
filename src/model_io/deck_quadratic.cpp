#include "model_io/deck_quadratic.hpp"

#include <algorithm>
#include <array>

namespace twindeck::model_io {
namespace {

const Eigen::Vector3d& corner_place(const fe::Model& model, int node) {
  return model.nodes[static_cast<std::size_t>(node)].x_m;
}

/// Centre of a quadrilateral of eight nodes by its shape functions.
Eigen::Vector3d centre_of(const fe::Model& model, const std::array<int, 4>& corners, const std::array<int, 4>& middles) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (const int node : corners) x -= 0.25 * corner_place(model, node);
  for (const int node : middles) x += 0.5 * corner_place(model, node);
  return x;
}

std::vector<std::vector<int>> pieces_of_shell(fe::Model& model, const std::vector<int>& n, const Splitting& splitting) {
  if (n.size() == 6) return {{n[0], n[3], n[5]}, {n[3], n[1], n[4]}, {n[5], n[4], n[2]}, {n[3], n[4], n[5]}};
  const int c = splitting.new_node(centre_of(model, {n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7]}));
  return {{n[0], n[4], c, n[7]}, {n[4], n[1], n[5], c}, {c, n[5], n[2], n[6]}, {n[7], c, n[6], n[3]}};
}

/// Nodes of a hexahedron on a grid of 3 × 3 × 3, corners at 0 and 2.
using Grid = std::array<std::array<std::array<int, 3>, 3>, 3>;

constexpr std::array<std::array<int, 3>, 20> place_on_grid = {
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
     {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};

int& node_on(Grid& grid, const std::array<int, 3>& at) {
  return grid[static_cast<std::size_t>(at[0])][static_cast<std::size_t>(at[1])][static_cast<std::size_t>(at[2])];
}

/// The node in the centre of the face where coordinate `axis` is `side`, made when the first of two elements asks for it.
int face_centre(fe::Model& model, Grid& grid, std::size_t axis, int side, const Splitting& splitting) {
  const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
  const auto at = [&](int i, int j) {
    std::array<int, 3> place{};
    place[axis] = side, place[first] = i, place[second] = j;
    return node_on(grid, place);
  };
  const std::array<int, 4> corners = {at(0, 0), at(2, 0), at(2, 2), at(0, 2)},
                           middles = {at(1, 0), at(2, 1), at(1, 2), at(0, 1)};
  std::vector<int> key(corners.begin(), corners.end());
  std::sort(key.begin(), key.end());
  const auto known = splitting.centres.find(key);
  if (known != splitting.centres.end()) return known->second;
  return splitting.centres[key] = splitting.new_node(centre_of(model, corners, middles));
}

std::vector<std::vector<int>> pieces_of_solid(fe::Model& model, const std::vector<int>& nodes, const Splitting& splitting) {
  Grid grid{};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 20; ++i) {
    node_on(grid, place_on_grid[i]) = nodes[i];
    centre += (i < 8 ? -0.25 : 0.25) * corner_place(model, nodes[i]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, 2}) {
      std::array<int, 3> middle = {1, 1, 1};
      middle[axis] = side;
      const int node = face_centre(model, grid, axis, side, splitting);
      node_on(grid, middle) = node;
    }
  node_on(grid, {1, 1, 1}) = splitting.new_node(centre);
  std::vector<std::vector<int>> pieces;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        std::vector<int> piece;
        for (std::size_t corner = 0; corner < 8; ++corner) {
          const auto& c = place_on_grid[corner];
          piece.push_back(node_on(grid, {i + c[0] / 2, j + c[1] / 2, k + c[2] / 2}));
        }
        pieces.push_back(std::move(piece));
      }
  return pieces;
}

}  // namespace

std::size_t add_in_pieces(fe::Model& model, const fe::Element& whole, const Splitting& splitting) {
  const std::size_t count = whole.nodes.size();
  const bool shell = whole.type == fe::ElementType::shell && (count == 6 || count == 8);
  if (!shell && !(whole.type == fe::ElementType::solid && count == 20)) {
    model.elements.push_back(whole);
    return 1;
  }
  const auto pieces = shell ? pieces_of_shell(model, whole.nodes, splitting) : pieces_of_solid(model, whole.nodes, splitting);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    fe::Element piece = whole;
    piece.nodes = pieces[i];
    if (i > 0) piece.id = splitting.new_element();
    model.elements.push_back(std::move(piece));
  }
  return pieces.size();
}

}  // namespace twindeck::model_io
