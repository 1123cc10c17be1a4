#include "fe/dead_load.hpp"

#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

/// Adds M_e e, where e moves every node by the acceleration of gravity.
void add_weight(const ElementMatrix& mass, const Eigen::Vector3d& gravity_m_s2, Eigen::VectorXd& load) {
  for (std::size_t j = 0; j < mass.dofs.size(); ++j) {
    const int direction = mass.dofs[j] % 6;
    if (direction > 2 || gravity_m_s2[direction] == 0.0) continue;
    for (std::size_t i = 0; i < mass.dofs.size(); ++i)
      load[mass.dofs[i]] += gravity_m_s2[direction] * mass.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
}

}  // namespace

Eigen::VectorXd dead_load(const Model& model) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()));
  const Eigen::Vector3d gravity_m_s2 = model.gravity_m_s2 * model.gravity_direction;
  if (gravity_m_s2.isZero(0.0)) return load;
  for (const Element& element : model.elements) add_weight(element_mass(model, element), gravity_m_s2, load);
  for (const PointMass& mass : model.masses) add_weight(point_mass(mass), gravity_m_s2, load);
  return load;
}

}  // namespace twindeck::fe
