#include <gtest/gtest.h>

#include <cmath>

#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using namespace testing_mesh;

/// Smallest compression for which K + K_G is singular: K x = P K_G1 x with K_G1 of a unit force.
double buckling_load(const Mesh& mesh, const Freedom& freedom, const BeamStiffnessProperties& s) {
  const Eigen::MatrixXd k = assemble(mesh, [&](const auto& e) { return beam_stiffness(beam_of(mesh, e), s); });
  const Eigen::MatrixXd g =
      assemble(mesh, [&](const auto& e) { return Matrix12(-beam_geometric_stiffness(beam_of(mesh, e), -1.0)); });
  return lowest_eigenvalues(k, g, freedom, 1)[0];
}

// Oracle: Euler's column in its weaker plane, P = π² E I/(c L)², within 1 % with four elements (the cubic errs by some 1e-4 or
// less).
TEST(BeamBuckling, EulerColumn) {
  const BeamStiffnessProperties s{210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 0.0, 5.0e-8, 0.0, 0.0};
  const double length = 5.0, euler = std::pow(M_PI / length, 2) * s.youngs_modulus_Pa * s.inertia_z_m4;
  const Mesh mesh = line(4, length);
  Freedom pinned(mesh), cantilever(mesh), clamped(mesh);
  pinned.fix(0, {0, 1, 2, 3});
  pinned.fix(4, {1, 2});
  cantilever.fix(0, {0, 1, 2, 3, 4, 5});
  clamped.fix(0, {0, 1, 2, 3, 4, 5});
  clamped.fix(4, {1, 2, 4, 5});
  EXPECT_NEAR(buckling_load(mesh, pinned, s) / euler, 1.0, 1e-3);
  EXPECT_NEAR(buckling_load(mesh, cantilever, s) / (euler / 4.0), 1.0, 1e-3);
  EXPECT_NEAR(buckling_load(mesh, clamped, s) / (4.0 * euler), 1.0, 1e-2);
}

// Oracle: Engesser's load of a shear-flexible pinned column, P = P_E/(1 + P_E/(G A_s)). The geometric stiffness keeps the
// Hermite cubics, so agreement comes with the mesh: 16 elements, 0.5 %.
TEST(BeamBuckling, ShearLowersTheLoad) {
  const BeamStiffnessProperties s{210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 0.0, 5.0e-8, 2.0e-5, 0.0};
  const double length = 5.0, euler = std::pow(M_PI / length, 2) * s.youngs_modulus_Pa * s.inertia_z_m4;
  const Mesh mesh = line(16, length);
  Freedom pinned(mesh);
  pinned.fix(0, {0, 1, 2, 3});
  pinned.fix(16, {1, 2});
  const double expected = euler / (1.0 + euler / (s.shear_modulus_Pa * s.shear_area_y_m2));
  EXPECT_LT(expected, 0.9 * euler);  // the check would be empty without a shear effect
  EXPECT_NEAR(buckling_load(mesh, pinned, s) / expected, 1.0, 5e-3);
}

}  // namespace
}  // namespace twindeck::fe
