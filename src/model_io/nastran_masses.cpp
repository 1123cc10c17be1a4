#include "model_io/nastran_masses.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fe/beam_frame.hpp"
#include "model_io/nastran_properties.hpp"
#include "model_io/nastran_springs.hpp"

namespace twindeck::model_io::nastran {
namespace {

using MassMatrix = Eigen::Matrix<double, 6, 6>;

/// Axes of the system that a mass is given in: only a rectangular one has the same directions everywhere.
Eigen::Matrix3d mass_axes(Parts& parts, const Card& card) {
  const long id = card.integer_or(2, 0);
  if (id <= 0) return Eigen::Matrix3d::Identity();
  const System& system = parts.system(card, id);
  if (system.type != 'R') card.fail("is given in a system that is not rectangular, which is not read", "use CORD2R");
  return system.axes;
}

/// A point mass where the matrix is one, else the matrix.
void add_mass(Parts& parts, const std::string& name, int node, const MassMatrix& m) {
  const double small = 1e-12 * m.cwiseAbs().maxCoeff();
  const MassMatrix rest = m - MassMatrix(m.diagonal().asDiagonal());
  const bool one_mass = std::abs(m(0, 0) - m(1, 1)) <= small && std::abs(m(0, 0) - m(2, 2)) <= small;
  if (!one_mass || rest.cwiseAbs().maxCoeff() > small) return add_matrix(parts, name, {node}, {}, m);
  fe::PointMass mass;
  mass.group = name;
  mass.node = node;
  mass.mass_kg = m(0, 0);
  mass.inertia_kg_m2 = m.diagonal().tail<3>();
  parts.model.masses.push_back(mass);
}

/// The lower half of a symmetric matrix, row by row from field `first` on.
template <int n>
Eigen::Matrix<double, n, n> symmetric(const Card& card, std::size_t first) {
  Eigen::Matrix<double, n, n> m;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column <= row; ++column) m(row, column) = m(column, row) = card.number_or(first++, 0.0);
  }
  return m;
}

/// CONM2: a mass off its grid, with inertia about its own centre.
MassMatrix offset_mass(Parts& parts, const Card& card) {
  const double mass = card.number_or(3, 0.0);
  Eigen::Vector3d arm = card.vector(4);
  Eigen::Matrix3d inertia = symmetric<3>(card, 8);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inertia(i, j) *= i == j ? 1.0 : -1.0;  // the card has the products as integrals, without sign
  }
  const Eigen::Matrix3d axes = mass_axes(parts, card);
  inertia = (axes.transpose() * inertia * axes).eval();
  arm = (axes.transpose() * arm).eval();
  // CID -1: the centre itself, in basic coordinates.
  if (card.integer_or(2, 0) < 0) arm -= parts.grid_place(card, card.integer(1));
  if (mass < 0.0 || inertia.diagonal().minCoeff() < 0.0) card.fail("a mass or an inertia is negative", "check the sign");
  MassMatrix m = MassMatrix::Zero();
  const Eigen::Matrix3d s = fe::beam::cross_matrix(arm);
  m.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  m.topRightCorner<3, 3>() = -mass * s;
  m.bottomLeftCorner<3, 3>() = mass * s;
  m.bottomRightCorner<3, 3>() = inertia - mass * s * s;
  return m;
}

}  // namespace

void read_mass(Parts& parts, const Card& card) {
  const long grid = card.integer(1);
  MassMatrix m;
  if (card.name == "CONM1") {
    const Eigen::Matrix3d axes = mass_axes(parts, card);
    MassMatrix turn = MassMatrix::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = axes;
    m = turn.transpose() * symmetric<6>(card, 3) * turn;
  } else {
    m = offset_mass(parts, card);
  }
  add_mass(parts, fmt::format("{}_{}", card.name == "CONM1" ? "conm1" : "conm2", card.text(0)), parts.node(card, grid), m);
}

void read_scalar_mass(Parts& parts, const Card& card) {
  const double mass = card.name == "CMASS1" ? parts.constant(card, parts.scalar_masses, "PMASS").second : card.number(1);
  if (mass < 0.0) card.fail("the mass is negative", "check the sign");
  if (!card.blank(4) && card.text(4) != "0")
    card.fail("is a mass between two grids, which is not read", "give a mass to ground at one grid");
  const long grid = card.integer(2);
  const int component = card.component(3);
  const Eigen::Matrix3d axes = parts.displacement_axes(card, grid);
  MassMatrix& m = parts.added_mass.try_emplace(parts.node(card, grid), MassMatrix::Zero()).first->second;
  const Eigen::Vector3d direction = axes.row(component % 3).transpose();
  const Eigen::Index at = component > 2 ? 3 : 0;
  m.block<3, 3>(at, at) += mass * direction * direction.transpose();
}

void finish_masses(Parts& parts) {
  for (const auto& [node, m] : parts.added_mass)
    add_mass(parts, fmt::format("cmass_grid_{}", parts.model.nodes[static_cast<std::size_t>(node)].id), node, m);
}

}  // namespace twindeck::model_io::nastran
