#include "fe/mass_properties.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fe/assembly_elements.hpp"
#include "fe/beam_frame.hpp"
#include "fe/matrix_element.hpp"

namespace twindeck::fe {

namespace {

using RigidMass = Eigen::Matrix<double, 6, 6>;

/// Mean of the nodes: sums about it lose fewer digits than about a far origin.
Eigen::Vector3d middle_of(const Model& model) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Node& node : model.nodes) sum += node.x_m;
  return model.nodes.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(model.nodes.size()));
}

/// Adds Rᵀ M R: a shift along each axis and a turn about each axis through `about`.
void add(const Model& model, const ElementMatrix& mass, const Eigen::Vector3d& about, RigidMass& sum) {
  const auto n = static_cast<Eigen::Index>(mass.dofs.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> r(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int full = mass.dofs[static_cast<std::size_t>(i)], direction = full % 6;
    const Eigen::Vector3d arm = model.nodes[slot(full / 6)].x_m - about;
    r.row(i).setZero();
    r(i, direction) = 1.0;
    // theta × arm = -arm × theta
    if (direction < 3) r.block<1, 3>(i, 3) = -beam::cross_matrix(arm).row(direction);
  }
  sum += r.transpose() * mass.matrix * r;
}

/// What lies below this part of the largest number beside it is rounding, and is shown as 0.
constexpr double shown = 1e-9;

std::string rounded(double value, double largest) {
  return fmt::format("{:.6g}", std::abs(value) > shown * largest ? value : 0.0);
}

}  // namespace

MassProperties mass_properties(const Model& model) {
  const Eigen::Vector3d about = middle_of(model);
  RigidMass m = RigidMass::Zero();
  for (const Element& element : model.elements) add(model, element_mass(model, element), about, m);
  for (const PointMass& mass : model.masses) add(model, point_mass(mass), about, m);
  for (const MatrixElement& element : model.matrix_elements)
    if (element.mass.size() > 0) add(model, conservative_part(element).mass, about, m);

  MassProperties p;
  p.mass_kg = m.diagonal().head<3>();
  const double mass = p.mass_kg.mean();
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  // The upper right block is -mass [arm]×, of which the skew part is taken.
  const Eigen::Matrix3d s = 0.5 * (m.topRightCorner<3, 3>().transpose() - m.topRightCorner<3, 3>());
  if (mass > 0.0) arm = Eigen::Vector3d(s(2, 1), s(0, 2), s(1, 0)) / mass;
  p.centre_m = mass > 0.0 ? Eigen::Vector3d(about + arm) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d cross = beam::cross_matrix(arm);
  p.inertia_kg_m2 = m.bottomRightCorner<3, 3>() + mass * cross * cross;
  return p;
}

std::string mass_words(const MassProperties& p) {
  const double mass = p.mass_kg.maxCoeff();
  if (!(mass > 0.0)) return "the model has no mass";
  std::string words = fmt::format("mass {:.6g} kg", mass);
  if (mass - p.mass_kg.minCoeff() > shown * mass)
    words =
        fmt::format("mass {:.6g} kg along x, {:.6g} kg along y, {:.6g} kg along z", p.mass_kg[0], p.mass_kg[1], p.mass_kg[2]);
  const double reach = p.centre_m.cwiseAbs().maxCoeff() + std::sqrt(p.inertia_kg_m2.cwiseAbs().maxCoeff() / mass);
  words += fmt::format(", centre of mass at ({}, {}, {}) m; inertia about it, axes x y z:", rounded(p.centre_m[0], reach),
                       rounded(p.centre_m[1], reach), rounded(p.centre_m[2], reach));
  constexpr std::array<const char*, 6> names = {"xx", "yy", "zz", "xy", "xz", "yz"};
  constexpr std::array<std::array<Eigen::Index, 2>, 6> places = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const double largest = p.inertia_kg_m2.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < names.size(); ++i)
    words +=
        fmt::format("{} {} {}", i == 0 ? "" : ",", names[i], rounded(p.inertia_kg_m2(places[i][0], places[i][1]), largest));
  return words + " kg m2";
}

}  // namespace twindeck::fe
