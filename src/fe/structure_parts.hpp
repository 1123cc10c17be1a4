#pragma once

#include <vector>

#include "fe/dof_map.hpp"
#include "fe/structure.hpp"

namespace twindeck::fe {

/// Data of a Structure.
struct Structure::Parts {
  Model model;
  DofMap map;
  linalg::SparseMatrix pattern;  ///< zeros
  std::vector<Term> stiffness;   ///< elastic, without stays
  std::vector<Term> mass;
};

/// State without cable forces; only tensioned bars carry force.
[[nodiscard]] PrestressState unstressed(const Model& model);
/// Geometric stiffness of bars that are under tension in the geometry of nodes.csv; empty if there are none (prestress.cpp).
[[nodiscard]] Term initial_tension_stiffness(const Model& model, const linalg::SparseMatrix& pattern, const DofMap& map);

/// The prestress of a structure with given elastic stiffness without stays (prestress.cpp).
/// @param lower  lower triangle of that stiffness at `theta` (n × n)
[[nodiscard]] PrestressState prestress_of(const Model& base, const DofMap& map, const linalg::SparseMatrix& lower,
                                          const Eigen::VectorXd& theta);

/// Geometric stiffness of members and the string stiffness T/L of stays, one term without parameters (assembly.cpp).
[[nodiscard]] Term geometric_stiffness(const Model& model, const PrestressState& state, const linalg::SparseMatrix& pattern,
                                       const DofMap& map);

}  // namespace twindeck::fe
