// Transverse shear of shells of four and three nodes. Oracles: the thin shells (DKQ, DKT) as t / L -> 0, rigid motions, patch
// tests, Timoshenko's cantilever, Mindlin's frequencies of a simply supported plate, a rebuilt model.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "fe/assembly.hpp"
#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using testing_mesh::Freedom;
using testing_mesh::Mesh;

/// A mesh of quadrilaterals and triangles.
Eigen::MatrixXd plates(const Mesh& mesh, const ShellProperties& s) {
  return testing_mesh::assemble(mesh, [&](const auto& e) -> Eigen::MatrixXd {
    if (e.size() == 3) return triangle_bending_stiffness(testing_mesh::triangle_of(mesh, e), s);
    return shell_bending_stiffness(testing_mesh::shell_of(mesh, e), s);
  });
}

ShellProperties steel_plate(double thickness_m, double ratio = homogeneous_shear_ratio) {
  return {200e9, 0.3, thickness_m, 1.0, ratio};
}

/// One quadrilateral and one triangle without right angles, of sides near 1 m.
std::array<Mesh, 2> lopsided() {
  return {Mesh{{{0, 0, 0}, {1.2, 0.2, 0}, {1.0, 1.1, 0}, {-0.2, 0.9, 0}}, {{0, 1, 2, 3}}},
          Mesh{{{0, 0, 0}, {1.2, 0.2, 0}, {0.3, 1.1, 0}}, {{0, 1, 2}}}};
}

// Oracle: DKQ and DKT. φ falls with (t/L)², so that at t/L = 1e-7 nothing but rounding is left.
TEST(ShellShear, ThinShellsAreKirchhoffs) {
  for (const Mesh& mesh : lopsided()) {
    const Eigen::MatrixXd thin = plates(mesh, steel_plate(1e-7)), rigid = plates(mesh, steel_plate(1e-7, 0.0));
    EXPECT_LT((thin - rigid).norm(), 1e-12 * rigid.norm());
    EXPECT_GT((plates(mesh, steel_plate(0.1)) - plates(mesh, steel_plate(0.1, 0.0))).norm(),
              1e-3 * plates(mesh, steel_plate(0.1)).norm());
  }
}

// Oracle: rigid motions store nothing, and nothing else is without energy (rank 9 and 6), however thick and warped.
TEST(ShellShear, RigidMotionsStoreNothing) {
  for (Mesh mesh : lopsided()) {
    mesh.node_m[1].z() += 0.1;
    for (const double t : {0.01, 0.3, 2.0}) {
      const Eigen::MatrixXd k = plates(mesh, steel_plate(t));
      for (int d = 0; d < 6; ++d) EXPECT_LT((k * testing_mesh::rigid_motion_of(mesh.node_m, d)).norm(), 1e-12 * k.norm());
      EXPECT_EQ(testing_mesh::shell_rank(k), 3 * static_cast<int>(mesh.node_m.size()) - 3);
    }
  }
}

/// Solution at the inner nodes 4-7 of MacNeal's patch where the outer ones are given.
Eigen::VectorXd inner_solution(const Mesh& mesh, const Eigen::MatrixXd& k, const Eigen::VectorXd& exact) {
  Freedom freedom(mesh);
  freedom.fix_everywhere({0, 1, 5});
  for (int node = 0; node < 4; ++node) freedom.fix(node, {2, 3, 4});
  return testing_mesh::solve(k, Eigen::VectorXd::Zero(k.rows()), freedom, exact);
}

// Oracle: w = ½ xᵀ C x without shear strains: the inner nodes follow, energy ½ κᵀ D κ A; quadrilaterals, triangles, and both.
TEST(ShellShear, ConstantCurvature) {
  const ShellProperties s = steel_plate(0.05);
  const double d = s.youngs_modulus_Pa * std::pow(s.thickness_m, 3) / 12.0 / 0.91;
  for (const std::size_t each : {100U, 1U, 2U}) {
    Mesh mesh = testing_mesh::macneal_patch();
    if (each < 100) mesh = testing_mesh::cut(mesh, each);
    Eigen::VectorXd exact = Eigen::VectorXd::Zero(mesh.dofs());
    for (std::size_t i = 0; i < mesh.node_m.size(); ++i) {
      const double x = mesh.node_m[i].x(), y = mesh.node_m[i].y();
      exact.segment<3>(static_cast<Eigen::Index>(6 * i + 2)) << 0.5 * (x * x + x * y + y * y), 0.5 * x + y, -x - 0.5 * y;
    }
    const Eigen::MatrixXd k = plates(mesh, s);
    EXPECT_LT((inner_solution(mesh, k, exact) - exact).norm(), 1e-11 * exact.norm());
    EXPECT_NEAR(exact.dot(k * exact) / (d * 0.24 * 0.12 * (2.0 + 0.6 + 0.35)), 1.0, 1e-11);
  }
}

// Oracle: a plate so thick that only shear counts: w = γ x without rotations is a solution, energy ½ κ G t γ² A.
TEST(ShellShear, ConstantShearOfAVeryThickPlate) {
  const ShellProperties s = steel_plate(1e4);
  for (const std::size_t each : {100U, 1U, 2U}) {
    Mesh mesh = testing_mesh::macneal_patch();
    if (each < 100) mesh = testing_mesh::cut(mesh, each);
    Eigen::VectorXd exact = Eigen::VectorXd::Zero(mesh.dofs());
    for (std::size_t i = 0; i < mesh.node_m.size(); ++i) exact[static_cast<Eigen::Index>(6 * i + 2)] = mesh.node_m[i].x();
    const Eigen::MatrixXd k = plates(mesh, s);
    EXPECT_LT((inner_solution(mesh, k, exact) - exact).norm(), 1e-8 * exact.norm());
    EXPECT_NEAR(exact.dot(k * exact) / (homogeneous_shear_ratio * 200e9 / 2.6 * 1e4 * 0.24 * 0.12), 1.0, 1e-8);
  }
}

// Oracle: Timoshenko's cantilever under a force at its end, P L³ / (3 E I) + P L / (κ G A) at ν = 0: the shear is constant, the
// moment linear, and the rotations quadratic, as the sides have it. Exact for rectangles.
TEST(ShellShear, CantileverInConstantShear) {
  const double length = 3.0, width = 0.5, t = 0.8, e = 30e9;
  const Mesh mesh = testing_mesh::grid(4, 1, [&](double x, double y) { return Eigen::Vector3d(length * x, width * y, 0.0); });
  Freedom freedom(mesh);
  freedom.fix_everywhere({0, 1, 5});
  Eigen::VectorXd force = Eigen::VectorXd::Zero(mesh.dofs());
  for (const int side : {0, 5}) {
    freedom.fix(side, {2, 3, 4});
    force[6 * (side + 4) + 2] = 0.5e6;
  }
  const Eigen::VectorXd u = testing_mesh::solve(plates(mesh, {e, 0.0, t, 1.0, homogeneous_shear_ratio}), force, freedom);
  const double inertia = width * t * t * t / 12.0, area = width * t * homogeneous_shear_ratio;
  const double exact = 1e6 * std::pow(length, 3) / (3.0 * e * inertia) + 1e6 * length / (0.5 * e * area);
  EXPECT_NEAR(u[6 * 4 + 2] / exact, 1.0, 1e-10);
}

constexpr double density = 8000.0;

/// Mindlin's lowest frequency of p and q half waves on a simply supported square of 1 m: the pencil of w and the rotation along
/// the wave, ρ t ω² w = κ G t k (k w + β), ρ t³/12 ω² β = D k² β + κ G t (k w + β).
double mindlin_Hz(const ShellProperties& s, int p, int q) {
  const double t = s.thickness_m, k = std::numbers::pi * std::hypot(p, q);
  const double d = s.youngs_modulus_Pa * t * t * t / 12.0 / (1.0 - s.poisson_ratio * s.poisson_ratio);
  const double shear = s.shear_thickness_ratio * s.youngs_modulus_Pa * t / (2.0 + 2.0 * s.poisson_ratio);
  Eigen::Matrix2d stiffness, mass;
  stiffness << shear * k * k, shear * k, shear * k, d * k * k + shear;
  mass << density * t, 0.0, 0.0, density * t * t * t / 12.0;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(stiffness, mass);
  return std::sqrt(solver.eigenvalues()[0]) / (2.0 * std::numbers::pi);
}

/// The four lowest of n × n elements of which every `each`-th is cut in two triangles (0: none), tangential rotations held.
Eigen::Vector4d square_plate_Hz(const ShellProperties& s, int n, std::size_t each) {
  Mesh mesh = testing_mesh::grid(n, n, [](double x, double y) { return Eigen::Vector3d(x, y, 0.0); });
  if (each > 0) mesh = testing_mesh::cut(mesh, each);
  const double t = s.thickness_m, per_area = density * t, rotary = density * t * t * t / 12.0;
  const Eigen::MatrixXd m = testing_mesh::assemble(mesh, [&](const auto& e) -> Eigen::MatrixXd {
    if (e.size() == 3) return triangle_mass(testing_mesh::triangle_of(mesh, e), per_area, rotary);
    return shell_mass(testing_mesh::shell_of(mesh, e), per_area, rotary);
  });
  Freedom freedom(mesh);
  freedom.fix_everywhere({0, 1, 5});
  for (std::size_t i = 0; i < mesh.node_m.size(); ++i) {
    const auto edge = [](double x) { return x == 0.0 || x == 1.0; };
    if (edge(mesh.node_m[i].x())) freedom.fix(static_cast<int>(i), {2, 3});
    if (edge(mesh.node_m[i].y())) freedom.fix(static_cast<int>(i), {2, 4});
  }
  return testing_mesh::lowest_eigenvalues(plates(mesh, s), m, freedom, 4).cwiseSqrt() / (2.0 * std::numbers::pi);
}

// Oracle: Mindlin (1951), J. Appl. Mech. 18, 31-38, at t/L of 0.1 and 0.2, modes (1, 1), twice (1, 2), (2, 2). The consistent
// mass errs with the square of the elements' size: the first is within 1 % on 16 × 16 elements, and all four are within 0.1 %
// where 8 × 8 and 16 × 16 are extrapolated to size zero.
TEST(ShellShear, ThickPlatesHaveMindlinsFrequencies) {
  for (const double t : {0.1, 0.2})
    for (const std::size_t each : {0U, 1U, 3U}) {
      const ShellProperties s = steel_plate(t);
      const Eigen::Vector4d coarse = square_plate_Hz(s, 8, each), fine = square_plate_Hz(s, 16, each);
      const Eigen::Vector4d exact(mindlin_Hz(s, 1, 1), mindlin_Hz(s, 1, 2), mindlin_Hz(s, 1, 2), mindlin_Hz(s, 2, 2));
      const Eigen::Array4d limit = ((4.0 * fine - coarse) / 3.0).array() / exact.array() - 1.0;
      std::cout << "t/L " << t << ", cut " << each << ": first off by " << 100.0 * (fine[0] / exact[0] - 1.0)
                << " %, extrapolated by " << 100.0 * limit.transpose() << " %\n";
      EXPECT_NEAR(fine[0] / exact[0], 1.0, 0.01);
      EXPECT_LT(limit.abs().maxCoeff(), 1e-3) << t << " " << each;
      EXPECT_GT(square_plate_Hz(steel_plate(t, 0.0), 16, each)[0], 1.02 * exact[0]);  // a thin shell is too stiff
    }
}

/// Simply supported plate of 8 × 8 shells, 0.15 thick, whose modulus, thickness and bending inertia ratio are parameters.
Model thick_deck() {
  Model model = test::with_steel();
  model.sections.push_back({.name = "slab", .thickness_m = 0.15, .shear_thickness_ratio = homogeneous_shear_ratio});
  const Mesh mesh = testing_mesh::grid(8, 8, [](double x, double y) { return Eigen::Vector3d(x, y, 0.0); });
  for (const Eigen::Vector3d& x : mesh.node_m) {
    const bool at_x = x.x() == 0.0 || x.x() == 1.0, at_y = x.y() == 0.0 || x.y() == 1.0;
    const int node = test::add_node(model, x.x(), x.y(), 0.0);
    test::fix(model, node, {true, true, at_x || at_y, at_x, at_y, true});
  }
  for (const auto& e : mesh.element) test::add_element(model, ElementType::shell, "deck", 0, 1, e);
  model.parameters = {{"E", Target::youngs_modulus, {"steel"}, "Pa", 200e9, 1e11, 3e11},
                      {"t", Target::thickness, {"slab"}, "m", 0.15, 0.1, 0.2},
                      {"RMI", Target::bending_inertia_ratio, {"slab"}, "-", 1.0, 0.5, 2.0}};
  return model;
}

double lowest_Hz(const ParametricSystem& system, const Eigen::VectorXd& theta) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(test::full(system.mass(theta)),
                                                                         test::full(system.stiffness(theta)));
  return 1.0 / std::sqrt(solver.eigenvalues().maxCoeff()) / (2.0 * std::numbers::pi);
}

// Oracle: the model rebuilt at other values. K is linear in E. In the thickness and the bending inertia it is right to first
// order: derivatives of the frequency to 1e-6, and the effect of 10 % more and less to 2e-3.
TEST(ShellShear, ParametersAreRightToFirstOrder) {
  const Model model = thick_deck();
  const ParametricSystem system = assemble(model, {});
  const Eigen::VectorXd standing = system.initial();
  for (Eigen::Index p = 0; p < 3; ++p) {
    const auto off = [&](double change) {
      const auto change_of = [&](bool rebuild) {
        Eigen::Vector2d f;
        for (const int side : {0, 1}) {
          Eigen::VectorXd theta = standing;
          theta[p] *= 1.0 + (2 * side - 1) * change;
          f[side] = lowest_Hz(rebuild ? assemble(with_parameters(model, theta), {}) : system, theta);
        }
        return f[1] - f[0];
      };
      return change_of(false) / change_of(true) - 1.0;
    };
    std::cout << "parameter " << p << ": derivative off by " << off(1e-3) << ", change of 10 % by " << off(0.1) << "\n";
    EXPECT_NEAR(off(1e-3), 0.0, p == 0 ? 1e-8 : 1e-6);
    EXPECT_NEAR(off(0.1), 0.0, p == 0 ? 1e-8 : 2e-3);
  }
}

}  // namespace
}  // namespace twindeck::fe
