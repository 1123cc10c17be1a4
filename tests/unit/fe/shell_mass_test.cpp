#include <gtest/gtest.h>

#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using namespace testing_mesh;

// Oracle: Newton: on the distorted patch, rigid motions give the mass ρ t a b and the inertias of the rectangle about its
// centre, m b²/12, m a²/12 (plus the rotary ρ t³/12 a b) and m (a² + b²)/12.
TEST(ShellMass, MassAndInertiaOfRigidMotion) {
  Mesh mesh = macneal_patch();
  for (Eigen::Vector3d& x : mesh.node_m) x -= Eigen::Vector3d(0.12, 0.06, 0.0);
  const double per_area = 450.0, rotary = 1.2, area = 0.24 * 0.12, mass = per_area * area;
  const Eigen::MatrixXd m = assemble(mesh, [&](const auto& e) { return shell_mass(shell_of(mesh, e), per_area, rotary); });
  const auto energy = [&](int d) {
    const Eigen::VectorXd u = testing_mesh::rigid_motion_of(mesh.node_m, d);
    return u.dot(m * u);
  };
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(energy(d) / mass, 1.0, 1e-12);
  EXPECT_NEAR(energy(3) / (mass * 0.12 * 0.12 / 12.0 + rotary * area), 1.0, 1e-12);
  EXPECT_NEAR(energy(4) / (mass * 0.24 * 0.24 / 12.0 + rotary * area), 1.0, 1e-12);
  EXPECT_NEAR(energy(5) / (mass * (0.24 * 0.24 + 0.12 * 0.12) / 12.0), 1.0, 1e-12);
}

// Oracle: Archimedes: the area of a parallelogram; areas of a patch add up.
TEST(ShellMass, Area) {
  ShellGeometry g;
  g.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(3, 3, 4), Eigen::Vector3d(1, 3, 4)};
  EXPECT_NEAR(shell_area(g), 10.0, 1e-13);
  const Mesh mesh = macneal_patch();
  double sum = 0.0;
  for (const auto& e : mesh.element) sum += shell_area(shell_of(mesh, e));
  EXPECT_NEAR(sum, 0.24 * 0.12, 1e-15);
}

}  // namespace
}  // namespace twindeck::fe
