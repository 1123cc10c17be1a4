#include <gtest/gtest.h>

#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using namespace testing_mesh;

const ShellProperties kPatch = {1e6, 0.25, 0.001, 1.0};  // MacNeal and Harder (1985)

/// Solves the patch with `exact` prescribed at its four corners (unused directions fixed everywhere) and returns K and u.
struct Solved {
  Eigen::MatrixXd k;
  Eigen::VectorXd exact, u;
};
Solved solve_patch(const Mesh& mesh, const Eigen::MatrixXd& k, const Eigen::VectorXd& exact, const std::vector<int>& unused) {
  Freedom freedom(mesh);
  freedom.fix_everywhere(unused);
  for (int corner = 0; corner < 4; ++corner) freedom.fix(corner, {0, 1, 2, 3, 4, 5});
  return {k, exact, solve(k, Eigen::VectorXd::Zero(mesh.dofs()), freedom, exact)};
}

// Oracle: the patch test of MacNeal and Harder (1985): linear u, v (constant stress, constant rotation) are reproduced at the
// inner nodes of the distorted patch, drilling rotations equal ½ (dv/dx - du/dy), and the energy is ½ σ:ε V.
TEST(ShellPatch, ConstantMembraneStress) {
  const Mesh mesh = macneal_patch();
  const double exx = 1e-3, eyy = 0.8e-3, uy = 0.5e-3, vx = 1.1e-3;
  Eigen::VectorXd exact = testing_mesh::LinearMembrane{exx, eyy, uy, vx}.at(mesh.node_m);
  const double e = kPatch.youngs_modulus_Pa, nu = kPatch.poisson_ratio;
  const double energy =
      0.5 * 0.24 * 0.12 * kPatch.thickness_m *
      (e / (1 - nu * nu) * (exx * exx + eyy * eyy + 2 * nu * exx * eyy) + e / (2 * (1 + nu)) * (uy + vx) * (uy + vx));
  for (const DrillingRule rule : {DrillingRule::penalty, DrillingRule::diagonal}) {
    if (rule == DrillingRule::diagonal)
      for (Eigen::Index i = 5; i < exact.size(); i += 6) exact[i] = 0.0;  // uncoupled from u and v
    const Eigen::MatrixXd k =
        assemble(mesh, [&](const auto& el) { return shell_membrane_stiffness(shell_of(mesh, el), kPatch, rule, 0.0); });
    const Solved patch = solve_patch(mesh, k, exact, {2, 3, 4});
    EXPECT_NEAR((patch.u - exact).norm() / exact.norm(), 0.0, 1e-12);
    EXPECT_NEAR(0.5 * exact.dot(k * exact) / energy, 1.0, 1e-12);
  }
}

// Oracle: the bending patch test of MacNeal and Harder (1985): w = 1e-3 (x² + xy + y²)/2, constant curvature, energy ½ κᵀ D κ
// A.
TEST(ShellPatch, ConstantCurvature) {
  const Mesh mesh = macneal_patch();
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(mesh.dofs());
  for (std::size_t i = 0; i < mesh.node_m.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    const double x = mesh.node_m[i].x(), y = mesh.node_m[i].y();
    exact[at + 2] = 0.5e-3 * (x * x + x * y + y * y);
    exact[at + 3] = 1e-3 * (0.5 * x + y);   // rx = dw/dy
    exact[at + 4] = -1e-3 * (x + 0.5 * y);  // ry = -dw/dx
  }
  const Eigen::MatrixXd k = assemble(mesh, [&](const auto& e) { return shell_bending_stiffness(shell_of(mesh, e), kPatch); });
  const Solved patch = solve_patch(mesh, k, exact, {0, 1, 5});
  EXPECT_NEAR((patch.u - exact).norm() / exact.norm(), 0.0, 1e-11);
  const double nu = kPatch.poisson_ratio;
  const double d = kPatch.youngs_modulus_Pa * std::pow(kPatch.thickness_m, 3) / 12.0 / (1 - nu * nu);
  const double energy = 0.5 * d * 0.24 * 0.12 * 1e-6 * (2.0 + 2.0 * nu + 0.5 * (1 - nu));  // κ = (1, 1, 2·½)·1e-3
  EXPECT_NEAR(0.5 * exact.dot(k * exact) / energy, 1.0, 1e-11);
}

// Oracle: Euler-Bernoulli: a rectangle under pure in-plane bending has the energy ½ E I κ² L (ν = 0) and the true rotation κ x
// at its corners: the incompatible modes remove the parasitic shear, and the penalty does not bring it back.
TEST(ShellPatch, PureInPlaneBendingOfARectangle) {
  const ShellProperties s{1e7, 0.0, 0.1, 1.0};
  const double a = 1.0, b = 0.2, kappa = 1e-3;
  ShellGeometry g;
  g.node_m = {Eigen::Vector3d(-a, -b, 0), Eigen::Vector3d(a, -b, 0), Eigen::Vector3d(a, b, 0), Eigen::Vector3d(-a, b, 0)};
  Eigen::Matrix<double, 24, 1> u = Eigen::Matrix<double, 24, 1>::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d& x = g.node_m[static_cast<std::size_t>(i)];
    u[6 * i] = -kappa * x.x() * x.y();
    u[6 * i + 1] = 0.5 * kappa * x.x() * x.x();
    u[6 * i + 5] = kappa * x.x();
  }
  const Matrix24 k = shell_membrane_stiffness(g, s, DrillingRule::penalty, 0.0);
  const double inertia = s.thickness_m * std::pow(2 * b, 3) / 12.0;
  EXPECT_NEAR(u.dot(k * u) / (s.youngs_modulus_Pa * inertia * kappa * kappa * 2 * a), 1.0, 1e-12);
}

}  // namespace
}  // namespace twindeck::fe
