#include "fe/dead_load.hpp"

#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

/// Adds -g M_e e_z, where e_z moves every node by one metre upwards.
void add_weight(const ElementMatrix& mass, double gravity, Eigen::VectorXd& load) {
  for (std::size_t j = 0; j < mass.dofs.size(); ++j) {
    if (mass.dofs[j] % 6 != 2) continue;
    for (std::size_t i = 0; i < mass.dofs.size(); ++i)
      load[mass.dofs[i]] -= gravity * mass.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
}

}  // namespace

Eigen::VectorXd dead_load(const Model& model) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()));
  for (const Element& element : model.elements) add_weight(element_mass(model, element), model.gravity_m_s2, load);
  for (const PointMass& mass : model.masses) add_weight(point_mass(mass), model.gravity_m_s2, load);
  return load;
}

}  // namespace twindeck::fe
