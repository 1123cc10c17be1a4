// The three-node shell: each test names its oracle.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/shell_quad.hpp"
#include "fe/uneven_shells.hpp"
#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using namespace testing_mesh;

const ShellProperties kTriangleOfConcrete = {30e9, 0.2, 0.18, 0.7};
const ShellProperties kTrianglePatch = {1e6, 0.25, 0.001, 1.0};  // MacNeal and Harder (1985)

const Eigen::Matrix3d kSkewTurn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -0.5, 0.3).normalized()).toRotationMatrix();

/// A scalene triangle in the plane z = 0, turned and moved.
TriangleGeometry triangle_turned_by(const Eigen::Matrix3d& turn) {
  TriangleGeometry g;
  g.node_m = {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(1.3, 0.1, 0.0), Eigen::Vector3d(0.4, 0.9, 0.0)};
  for (Eigen::Vector3d& x : g.node_m) x = turn * x + Eigen::Vector3d(2.0, -1.0, 3.0);
  return g;
}

// Oracle: six rigid motions without energy, the turn in the plane included; ranks: membrane 9 - 3, bending 9 - 3, together 18 -
// 6, also near ν = ½, where the optimal β₀ vanishes (properties).
TEST(ShellTriangle, SixMotionsWithoutEnergy) {
  const TriangleGeometry g = triangle_turned_by(kSkewTurn);
  for (const double nu : {0.0, 0.2, 0.49}) {
    const ShellProperties s{30e9, nu, 0.18, 0.7};
    TriangleGeometry mixed = g;
    mixed.straight_sides = 0b101;
    EXPECT_EQ(testing_mesh::shell_rank(triangle_membrane_stiffness(mixed, s)), 6);
    for (int d = 0; d < 6; ++d)
      EXPECT_LT((triangle_membrane_stiffness(mixed, s) * testing_mesh::rigid_motion_of(g.node_m, d)).norm(),
                1e-12 * s.youngs_modulus_Pa);
    const Matrix18 membrane = triangle_membrane_stiffness(g, s), bending = triangle_bending_stiffness(g, s);
    for (int d = 0; d < 6; ++d) {
      EXPECT_NEAR((membrane * testing_mesh::rigid_motion_of(g.node_m, d)).norm() / membrane.norm(), 0.0, 1e-13)
          << "motion " << d;
      EXPECT_NEAR((bending * testing_mesh::rigid_motion_of(g.node_m, d)).norm() / bending.norm(), 0.0, 1e-13) << "motion " << d;
    }
    EXPECT_EQ(testing_mesh::shell_rank(membrane), 6);
    EXPECT_EQ(testing_mesh::shell_rank(bending), 6);
    EXPECT_EQ(testing_mesh::shell_rank(membrane + membrane.norm() / bending.norm() * bending), 12);
  }
}

// Oracle: a turned element has the turned matrices; the numbering may start at any corner (properties).
TEST(ShellTriangle, NeitherAxesNorNumberingMatter) {
  const TriangleGeometry flat = triangle_turned_by(Eigen::Matrix3d::Identity()), tilted = triangle_turned_by(kSkewTurn);
  const TriangleGeometry shifted{{tilted.node_m[1], tilted.node_m[2], tilted.node_m[0]}};
  Matrix18 turn = Matrix18::Zero();
  for (int block = 0; block < 18; block += 3) turn.block<3, 3>(block, block) = kSkewTurn;
  Eigen::PermutationMatrix<18> p;
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 6; ++d) p.indices()[6 * ((i + 1) % 3) + d] = 6 * i + d;
  const auto compare_all = [&](const auto& matrix) {
    const Matrix18 expected = matrix(tilted);
    EXPECT_NEAR((turn * matrix(flat) * turn.transpose() - expected).norm() / expected.norm(), 0.0, 1e-12);
    EXPECT_NEAR((matrix(shifted) - p * expected * p.transpose()).norm() / expected.norm(), 0.0, 1e-12);
  };
  compare_all([](const TriangleGeometry& g) { return triangle_membrane_stiffness(g, kTriangleOfConcrete); });
  compare_all([](const TriangleGeometry& g) { return triangle_bending_stiffness(g, kTriangleOfConcrete); });
  compare_all([](const TriangleGeometry& g) { return triangle_mass(g, 300.0, 1.0); });
}

// Oracle: linearity stated in the header: membrane in E t, bending in E t³ and its ratio, mass in both its densities.
TEST(ShellTriangle, ScalesAsStated) {
  const TriangleGeometry g = triangle_turned_by(kSkewTurn);
  ShellProperties more = kTriangleOfConcrete;
  more.youngs_modulus_Pa *= 2.0;
  more.thickness_m *= 3.0;
  more.bending_inertia_ratio *= 5.0;
  const auto near = [](const Matrix18& a, const Matrix18& b) { return (a - b).norm() / b.norm() < 1e-13; };
  EXPECT_TRUE(near(triangle_membrane_stiffness(g, more), 6.0 * triangle_membrane_stiffness(g, kTriangleOfConcrete)));
  EXPECT_TRUE(near(triangle_bending_stiffness(g, more), 270.0 * triangle_bending_stiffness(g, kTriangleOfConcrete)));
  EXPECT_TRUE(near(triangle_mass(g, 400.0, 3.0), 400.0 * triangle_mass(g, 1.0, 0.0) + 3.0 * triangle_mass(g, 0.0, 1.0)));
}

/// Displacements at all nodes with those of the four corners prescribed.
Eigen::VectorXd patch_solution(const Mesh& mesh, const Eigen::MatrixXd& k, const Eigen::VectorXd& exact,
                               const std::vector<int>& unused) {
  Freedom freedom(mesh);
  freedom.fix_everywhere(unused);
  for (int corner = 0; corner < 4; ++corner) freedom.fix(corner, {0, 1, 2, 3, 4, 5});
  return solve(k, Eigen::VectorXd::Zero(mesh.dofs()), freedom, exact);
}

/// The product's own search for the sides that triangles share with quadrilaterals, by element.
std::vector<std::uint8_t> straight_sides_of(const Mesh& mesh) {
  Model model;
  for (const std::vector<int>& nodes : mesh.element) test::add_element(model, ElementType::shell, "", 0, 0, nodes);
  return sides_beside_four_nodes(model);
}

// Oracle: the patch test of MacNeal and Harder (1985) on triangles alone and on triangles among quadrilaterals, whatever
// drilling rule those have: linear u, v at the inner nodes, drilling rotations ½ (dv/dx - du/dy), energy ½ σ:ε V.
TEST(ShellTriangle, ConstantMembraneStressInMixedMeshes) {
  const double exx = 1e-3, eyy = 0.8e-3, uy = 0.5e-3, vx = 1.1e-3;
  const double e = kTrianglePatch.youngs_modulus_Pa, nu = kTrianglePatch.poisson_ratio;
  const double energy =
      0.5 * 0.24 * 0.12 * kTrianglePatch.thickness_m *
      (e / (1 - nu * nu) * (exx * exx + eyy * eyy + 2 * nu * exx * eyy) + e / (2 * (1 + nu)) * (uy + vx) * (uy + vx));
  for (const std::size_t each : {1U, 2U}) {
    const std::vector<std::uint8_t> straight = straight_sides_of(cut(macneal_patch(), each));
    EXPECT_EQ(*std::max_element(straight.begin(), straight.end()) > 0, each > 1);
    for (const DrillingRule rule : {DrillingRule::penalty, DrillingRule::diagonal}) {
      const Mesh mesh = cut(macneal_patch(), each);
      const Eigen::VectorXd exact = testing_mesh::LinearMembrane{exx, eyy, uy, vx}.at(mesh.node_m);
      const Eigen::MatrixXd k = assemble(mesh, [&](const auto& el) -> Eigen::MatrixXd {
        if (el.size() == 3) {
          TriangleGeometry triangle = triangle_of(mesh, el);
          triangle.straight_sides = straight[static_cast<std::size_t>(&el - mesh.element.data())];
          return triangle_membrane_stiffness(triangle, kTrianglePatch);
        }
        const ShellGeometry quad = shell_of(mesh, el);
        if (rule == DrillingRule::penalty) return shell_membrane_stiffness(quad, kTrianglePatch, rule, 0.0);
        return shell_membrane_stiffness(quad, kTrianglePatch, rule, 0.0) + drilling_spread(quad, kTrianglePatch, 0.0);
      });
      EXPECT_NEAR((patch_solution(mesh, k, exact, {2, 3, 4}) - exact).norm() / exact.norm(), 0.0, 1e-12);
      EXPECT_NEAR(0.5 * exact.dot(k * exact) / energy, 1.0, 1e-12);
    }
  }
}

// Oracle: the bending patch test of MacNeal and Harder (1985), w = 1e-3 (x² + xy + y²)/2, energy ½ κᵀ D κ A; triangles alone
// and triangles among quadrilaterals.
TEST(ShellTriangle, ConstantCurvatureInMixedMeshes) {
  const double nu = kTrianglePatch.poisson_ratio;
  const double d = kTrianglePatch.youngs_modulus_Pa * std::pow(kTrianglePatch.thickness_m, 3) / 12.0 / (1 - nu * nu);
  const double energy = 0.5 * d * 0.24 * 0.12 * 1e-6 * (2.0 + 2.0 * nu + 0.5 * (1 - nu));
  for (const std::size_t each : {1U, 2U}) {
    const Mesh mesh = cut(macneal_patch(), each);
    Eigen::VectorXd exact = Eigen::VectorXd::Zero(mesh.dofs());
    for (std::size_t i = 0; i < mesh.node_m.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(6 * i);
      const double x = mesh.node_m[i].x(), y = mesh.node_m[i].y();
      exact[at + 2] = 0.5e-3 * (x * x + x * y + y * y);
      exact[at + 3] = 1e-3 * (0.5 * x + y);
      exact[at + 4] = -1e-3 * (x + 0.5 * y);
    }
    const Eigen::MatrixXd k = assemble(mesh, [&](const auto& el) -> Eigen::MatrixXd {
      if (el.size() == 3) return triangle_bending_stiffness(triangle_of(mesh, el), kTrianglePatch);
      return shell_bending_stiffness(shell_of(mesh, el), kTrianglePatch);
    });
    EXPECT_NEAR((patch_solution(mesh, k, exact, {0, 1, 5}) - exact).norm() / exact.norm(), 0.0, 1e-11);
    EXPECT_NEAR(0.5 * exact.dot(k * exact) / energy, 1.0, 1e-11);
  }
}

// Oracle: Felippa (2003): two optimal triangles that make a rectangle have the energy ½ E I κ² L of pure in-plane bending,
// whatever the sides' ratio and Poisson's ratio; mean of both diagonals. It fixes the ten coefficients of the formulation.
TEST(ShellTriangle, PureInPlaneBendingOfARectangleIsExact) {
  const double kappa = 1e-3;
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {1.0, 0.1}, {0.3, 1.2}}) {
    for (const double nu : {0.0, 0.3}) {
      const ShellProperties s{1e7, nu, 0.1, 1.0};
      const std::array<Eigen::Vector3d, 4> corner = {Eigen::Vector3d(-a, -b, 0), Eigen::Vector3d(a, -b, 0),
                                                     Eigen::Vector3d(a, b, 0), Eigen::Vector3d(-a, b, 0)};
      double twice_energy_of_both = 0.0;
      for (const auto& t : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}) {
        const TriangleGeometry g{{corner[t[0]], corner[t[1]], corner[t[2]]}};
        Eigen::Matrix<double, 18, 1> u = Eigen::Matrix<double, 18, 1>::Zero();
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d& x = g.node_m[static_cast<std::size_t>(i)];
          u[6 * i] = -kappa * x.x() * x.y();
          u[6 * i + 1] = 0.5 * kappa * (x.x() * x.x() + nu * x.y() * x.y());
          u[6 * i + 5] = kappa * x.x();
        }
        twice_energy_of_both += u.dot(triangle_membrane_stiffness(g, s) * u);
      }
      const double inertia = s.thickness_m * std::pow(2 * b, 3) / 12.0;
      EXPECT_NEAR(0.5 * twice_energy_of_both / (s.youngs_modulus_Pa * inertia * kappa * kappa * 2 * a), 1.0, 1e-10);
    }
  }
}

// Oracle: Newton: on the distorted patch of triangles, rigid motions give the mass ρ t a b and the inertias of the rectangle
// about its centre, m b²/12, m a²/12 (plus the rotary ρ t³/12 a b) and m (a² + b²)/12. Lumped: the same mass, a third of each
// triangle's at each corner.
TEST(ShellTriangle, MassAndInertiaOfRigidMotion) {
  Mesh mesh = cut(macneal_patch(), 1);
  for (Eigen::Vector3d& x : mesh.node_m) x -= Eigen::Vector3d(0.12, 0.06, 0.0);
  const double per_area = 450.0, rotary = 1.2, area = 0.24 * 0.12, mass = per_area * area;
  const auto energy = [&](const Eigen::MatrixXd& m, int d) {
    const Eigen::VectorXd u = testing_mesh::rigid_motion_of(mesh.node_m, d);
    return u.dot(m * u);
  };
  const Eigen::MatrixXd m =
      assemble(mesh, [&](const auto& e) { return triangle_mass(triangle_of(mesh, e), per_area, rotary); });
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(energy(m, d) / mass, 1.0, 1e-12);
  EXPECT_NEAR(energy(m, 3) / (mass * 0.12 * 0.12 / 12.0 + rotary * area), 1.0, 1e-12);
  EXPECT_NEAR(energy(m, 4) / (mass * 0.24 * 0.24 / 12.0 + rotary * area), 1.0, 1e-12);
  EXPECT_NEAR(energy(m, 5) / (mass * (0.24 * 0.24 + 0.12 * 0.12) / 12.0), 1.0, 1e-12);
  const TriangleGeometry g = triangle_turned_by(kSkewTurn);
  const double own_area = 0.5 * (1.3 * 0.9 - 0.4 * 0.1);
  const Matrix18 lumped = triangle_mass_lumped(g, per_area, rotary);
  for (int i = 0; i < 18; i += 6)
    EXPECT_NEAR((lumped.block<3, 3>(i, i) - per_area * own_area / 3.0 * Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-10);
  EXPECT_NEAR(lumped.trace(), 3.0 * per_area * own_area + 2.0 * rotary * own_area, 1e-9);
}

// Oracle: the contract on bad input: the corner's place, and in a model the element with its nodes.
TEST(ShellTriangle, RefusesATriangleWithoutArea) {
  TriangleGeometry g;
  g.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(3, 0, 0)};
  EXPECT_THROW((void)triangle_bending_stiffness(g, kTriangleOfConcrete), InputError);
  EXPECT_THROW((void)triangle_membrane_stiffness(g, kTriangleOfConcrete), InputError);
  EXPECT_THROW((void)triangle_mass(g, 1.0, 0.0), InputError);
  const auto says = [](const Model& model) {
    try {
      validate(model);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Model model = test::one_of_everything();
  Element& triangle = model.elements.back();
  ASSERT_EQ(triangle.nodes.size(), 3U);
  EXPECT_EQ(says(model), "");
  model.nodes[static_cast<std::size_t>(triangle.nodes[1])].x_m = {6.0, 1.0, 0.2};  // in line with its other two
  EXPECT_NE(says(model).find("element 9: the shell 5-9-6 has no area"), std::string::npos) << says(model);
  triangle.nodes.pop_back();
  EXPECT_NE(says(model).find("element 9: has 2 nodes, expected 3 or 4"), std::string::npos) << says(model);
}

// Oracle: the header of uneven_shells.hpp: thickness follows from x of the element's middle, so a triangle and a four-node
// shell of one deck with middles at one x are equally thick.
TEST(ShellTriangle, UnevennessFollowsTheMiddle) {
  Model model = test::one_of_everything();
  model.nodes.clear(), model.elements.clear();
  for (int i = 0; i < 40; ++i) {
    const double x = 5.0 * i;
    const int a = test::add_node(model, x - 1.0, 0.0, 0.0), b = test::add_node(model, x + 1.0, 0.0, 0.0),
              c = test::add_node(model, x + 1.0, 1.0, 0.0), d = test::add_node(model, x - 1.0, 1.0, 0.0),
              top = test::add_node(model, x, 2.0, 0.0);
    test::add_element(model, ElementType::shell, "slab", 1, 1, {a, b, c, d});
    test::add_element(model, ElementType::shell, "slab", 1, 1, {d, c, top});
  }
  const Model uneven = with_uneven_shells(model, 0.1, 60.0);
  EXPECT_GT(uneven.sections.size(), model.sections.size());
  for (std::size_t i = 0; i < uneven.elements.size(); i += 2)
    EXPECT_EQ(uneven.elements[i].section, uneven.elements[i + 1].section) << "x = " << 2.5 * static_cast<double>(i);
}

}  // namespace
}  // namespace twindeck::fe
