#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>

#include "../unit/fe/assembly_models.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "linalg/cholesky.hpp"
#include "verification_table.hpp"

/// Models of published problems through the product's own assembly and solvers.
namespace twindeck::fe::verification {

using test::add_element;
using test::add_node;
using twindeck::verification::check;
using twindeck::verification::record;
inline constexpr double kPi = std::numbers::pi;

[[nodiscard]] inline Model with_material(double youngs_modulus_Pa, double poisson_ratio, double density_kg_m3) {
  Model model;
  model.source = "published problem";
  model.materials.push_back(
      {"m", youngs_modulus_Pa, youngs_modulus_Pa / (2.0 * (1.0 + poisson_ratio)), poisson_ratio, density_kg_m3});
  return model;
}

inline void fix(Model& model, int node, const std::vector<int>& directions) {
  Support s{"", node, {}};
  for (const int d : directions) s.fixed[static_cast<std::size_t>(d)] = true;
  model.supports.push_back(s);
}

inline void fix_everywhere(Model& model, const std::vector<int>& directions) {
  for (int i = 0; i < std::ssize(model.nodes); ++i) fix(model, i, directions);
}

/// Fixes the nodes for which `where` holds.
inline void fix_where(Model& model, const std::vector<int>& directions,
                      const std::function<bool(const Eigen::Vector3d&)>& where) {
  for (int i = 0; i < std::ssize(model.nodes); ++i)
    if (where(model.nodes[static_cast<std::size_t>(i)].x_m)) fix(model, i, directions);
}

/// nx × ny shells over the unit square carried to space; node (i, j) has number j (nx + 1) + i.
inline void add_shells(Model& model, int nx, int ny, double thickness_m,
                       const std::function<Eigen::Vector3d(double, double)>& map) {
  Section s;
  s.name = "shell";
  s.thickness_m = thickness_m;
  model.sections.push_back(s);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const Eigen::Vector3d x = map(static_cast<double>(i) / nx, static_cast<double>(j) / ny);
      add_node(model, x.x(), x.y(), x.z());
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      add_element(model, ElementType::shell, "shell", 0, 0, {a, a + 1, a + nx + 2, a + nx + 1});
    }
}

/// Cuts every `each`-th four-node shell of the model into two triangles, along one diagonal and the other in turn.
inline void cut_shells(Model& model, std::size_t each) {
  const std::vector<Element> whole = std::move(model.elements);
  model.elements.clear();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const std::vector<int>& q = whole[i].nodes;
    if (q.size() != 4 || i % each != 0) {
      add_element(model, whole[i].type, whole[i].group, whole[i].material, whole[i].section, q);
      continue;
    }
    const bool turned = i / each % 2 == 1;
    const std::vector<int> first = turned ? std::vector<int>{q[1], q[2], q[3]} : std::vector<int>{q[0], q[1], q[2]},
                           second = turned ? std::vector<int>{q[1], q[3], q[0]} : std::vector<int>{q[0], q[2], q[3]};
    for (const std::vector<int>& nodes : {first, second})
      add_element(model, ElementType::shell, whole[i].group, whole[i].material, whole[i].section, nodes);
  }
}

/// nx × ny × nz solids over the unit cube carried to space; node (i, j, k) has number (k (ny + 1) + j) (nx + 1) + i.
inline void add_solids(Model& model, int nx, int ny, int nz,
                       const std::function<Eigen::Vector3d(double, double, double)>& map) {
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const Eigen::Vector3d x = map(static_cast<double>(i) / nx, static_cast<double>(j) / ny, static_cast<double>(k) / nz);
        add_node(model, x.x(), x.y(), x.z());
      }
  const int row = nx + 1, layer = (nx + 1) * (ny + 1);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = k * layer + j * row + i, b = a + layer;
        add_element(model, ElementType::solid, "solid", 0, -1,
                    {a, a + 1, a + row + 1, a + row, b, b + 1, b + row + 1, b + row});
      }
}

inline Section beam_section(double area, double iy, double iz, double torsion, double shear_area) {
  Section s;
  s.name = "beam";
  s.area_m2 = area;
  s.inertia_y_m4 = iy;
  s.inertia_z_m4 = iz;
  s.torsion_m4 = torsion;
  s.shear_area_y_m2 = s.shear_area_z_m2 = shear_area;
  return s;
}

/// n beams from node to node (the second is added); returns the last node.
inline int add_beams(Model& model, int from, const Eigen::Vector3d& to_m, int n) {
  const Eigen::Vector3d start = model.nodes[static_cast<std::size_t>(from)].x_m;
  for (int i = 1; i <= n; ++i) {
    const Eigen::Vector3d x = start + (to_m - start) * i / n;
    const int next = add_node(model, x.x(), x.y(), x.z());
    add_element(model, ElementType::beam, "beam", 0, 0, {from, next});
    from = next;
  }
  return from;
}

[[nodiscard]] inline Eigen::VectorXd no_load(const Model& model) { return Eigen::VectorXd::Zero(6 * std::ssize(model.nodes)); }

/// Displacements of all nodes (6 n_nodes) under a load.
[[nodiscard]] inline Eigen::VectorXd displacements(const Model& model, const Eigen::VectorXd& load) {
  const ParametricSystem system = assemble(model, {});
  linalg::Cholesky factor;
  EXPECT_TRUE(factor.factorize(system.stiffness({})).converged);
  return system.expand(factor.solve(system.expansion.transpose() * load));
}

[[nodiscard]] inline Eigen::VectorXd frequencies_Hz(const Model& model, int n_modes, const PrestressState& state = {}) {
  const ParametricSystem system = assemble(model, state);
  dynamics::ModalSolver solver(system);
  const dynamics::EigenModes modes = solver.solve({}, n_modes);
  EXPECT_TRUE(modes.status.converged) << modes.status.message;
  return modes.frequency_Hz;
}

/// Consistent enough load of a total force over nodes: equal parts, half at both ends of a line.
inline void spread(Eigen::VectorXd& load, const std::vector<int>& line, int direction, double total) {
  const double part = total / static_cast<double>(line.size() - 1);
  for (std::size_t i = 0; i < line.size(); ++i)
    load[6 * line[i] + direction] += i == 0 || i + 1 == line.size() ? 0.5 * part : part;
}

}  // namespace twindeck::fe::verification
