#pragma once

#include <vector>

#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::fe {

/// Free degrees of freedom of a model after supports, rigid links and constraints have been eliminated.
///
/// Displacements of all nodes follow from the free ones by u = E q. A slave moves with the end of its chain of links as a rigid
/// body, u_s = u_m + theta_m × (x_s - x_m), theta_s = theta_m; a supported degree of freedom has an empty row; a dependent one
/// (Constraint) has the sum of the rows of its terms. Degrees of freedom without an element or spring (rotations of a node
/// where only bars meet) are left out, because K would be singular there.
struct DofMap {
  linalg::SparseMatrix expansion;  ///< E (6 n_nodes × n)
  std::vector<DofLabel> dofs;      ///< (n) in the order of nodes, then x y z rx ry rz
  std::vector<int> node_of;        ///< (n) position of the node of each of them
  std::vector<int> root;           ///< (n_nodes) the node that carries a node's motion: itself or the end of its chain of links

  /// Row of E: the free degrees of freedom that move the full degree of freedom 6·node + direction, with their factors.
  struct Entry {
    int dof;
    double factor;
  };
  std::vector<std::vector<Entry>> rows;  ///< (6 n_nodes)
};

/// @throws InputError  for links or constraints that form a circle, a node that is slave twice, a displacement that depends
///         twice, a support on a slave or on a dependent displacement
[[nodiscard]] DofMap make_dof_map(const Model& model);

}  // namespace twindeck::fe
