/// Oracles: constant strain on distorted meshes (patch test), rigid motions, quadratic fields, volumes in closed form, pure
/// bending, the modes of a beam.
#include "fe/solid_quadratic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/mass_properties.hpp"
#include "fe/static_stage.hpp"
#include "fe/validate.hpp"

namespace twindeck::fe::quadratic_solids {
namespace {

/// Nodes in the middles of the edges, moved by `bend` [m] to make the edges curved.
QuadraticSolid with_middles(std::vector<Eigen::Vector3d> corners, double bend = 0.0) {
  QuadraticSolid solid{corners};
  const auto edges = test::edges_of_solid(corners.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double turn = 1.0 + 2.0 * static_cast<double>(e);
    solid.node_m.push_back(0.5 * (corners[edges[e][0]] + corners[edges[e][1]]) +
                           bend * Eigen::Vector3d(std::cos(turn), std::sin(turn), std::cos(2.0 * turn)));
  }
  return solid;
}

QuadraticSolid box(double a, double b, double c) {
  return with_middles({{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}, {0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}});
}

/// A crooked hexahedron and a crooked tetrahedron with curved edges.
std::vector<QuadraticSolid> crooked_solids(double bend) {
  return {
      with_middles(
          {{0.1, 0, 0}, {1.2, 0.1, 0.1}, {1, 0.9, -0.1}, {0, 1, 0.1}, {0, 0.1, 0.8}, {1, 0, 0.9}, {1.1, 1, 1}, {0.1, 0.9, 0.9}},
          bend),
      with_middles({{0.1, 0.2, 0.0}, {1.2, 0.1, 0.3}, {0.2, 0.9, -0.1}, {0.4, 0.3, 0.8}}, bend)};
}

Eigen::VectorXd field_on(const QuadraticSolid& solid, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field) {
  Eigen::VectorXd u(3 * std::ssize(solid.node_m));
  for (std::size_t i = 0; i < solid.node_m.size(); ++i) u.segment<3>(3 * static_cast<Eigen::Index>(i)) = field(solid.node_m[i]);
  return u;
}

TEST(QuadraticSolid, SixRigidMotionsAndNoOther) {
  for (const QuadraticSolid& solid : crooked_solids(0.03)) {
    const Eigen::MatrixXd k = quadratic_solid_stiffness(solid, {210e9, 0.3});
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d a = Eigen::Vector3d::Unit(axis);
      EXPECT_LT((k * field_on(solid, [&](const Eigen::Vector3d&) { return a; })).norm(), 1e-14 * k.norm());
      EXPECT_LT((k * field_on(solid, [&](const Eigen::Vector3d& x) { return a.cross(x); })).norm(), 1e-14 * k.norm());
    }
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    EXPECT_LT(std::abs(eigenvalues[5]), 1e-13 * eigenvalues.tail<1>()[0]);
    EXPECT_GT(eigenvalues[6], 1e-3 * eigenvalues.tail<1>()[0]);
  }
}

// A linear field has constant strain: the nodal forces are the stress on the surface, so the energy is ½ σ:ε V, and inner nodes
// are without force (the mesh below).
TEST(QuadraticSolid, ConstantStrainHasItsEnergy) {
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.5, 0.5, 0.5, 1.0, 0.5, 0.5, 0.5, 1.0;
  const double nu = 0.25, e = 1e6;
  for (const QuadraticSolid& solid : crooked_solids(0.0)) {
    const Eigen::VectorXd u = field_on(solid, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(1e-3 * gradient * x); });
    const double energy = 0.5 * u.dot(quadratic_solid_stiffness(solid, {e, nu}) * u);
    EXPECT_NEAR(energy, 0.5 * (3 * 2000.0 * 1e-3 + 3 * 400.0 * 1e-3) * quadratic_solid_shape(solid).volume_m3, 1e-10);
  }
}

/// Two hexahedra, or six tetrahedra, that fill the box 2 × 1 × 1 m with an inner face that is neither plane nor straight.
/// `inner` returns the nodes off the surface.
Model distorted_box(bool tetrahedra, std::vector<int>& inner) {
  Model model;
  model.source = "box";
  model.materials.push_back({"m", 1e6, 0.4e6, 0.25, 1000.0});
  std::vector<std::vector<std::size_t>> cells;
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {0.0, 1.0, 2.0})
    for (const auto& [y, z] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      corners.push_back({x + (x == 1.0 ? 0.2 * (y - 0.4 * z) : 0.0), y, z});
  if (tetrahedra) {
    corners.push_back({0.9, 0.55, 0.4});  // a node inside, with which every triangle of the surface makes a tetrahedron
    for (const auto& f : std::vector<std::array<std::size_t, 4>>{{0, 1, 2, 3},
                                                                 {8, 11, 10, 9},
                                                                 {0, 4, 5, 1},
                                                                 {4, 8, 9, 5},
                                                                 {1, 5, 6, 2},
                                                                 {5, 9, 10, 6},
                                                                 {2, 6, 7, 3},
                                                                 {6, 10, 11, 7},
                                                                 {3, 7, 4, 0},
                                                                 {7, 11, 8, 4}}) {
      cells.push_back({f[0], f[1], f[2], 12});
      cells.push_back({f[0], f[2], f[3], 12});
    }
  } else {
    cells = {{0, 4, 5, 1, 3, 7, 6, 2}, {4, 8, 9, 5, 7, 11, 10, 6}};
  }
  for (const Eigen::Vector3d& x : corners) test::add_node(model, x.x(), x.y(), x.z());
  for (const auto& cell : cells)
    test::add_element(model, ElementType::solid, "box", 0, -1, std::vector<int>(cell.begin(), cell.end()));
  test::make_quadratic(model);
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    const Eigen::Vector3d& x = model.nodes[slot(i)].x_m;
    if (x.minCoeff() > 1e-9 && x.x() < 2.0 - 1e-9 && std::max(x.y(), x.z()) < 1.0 - 1e-9) inner.push_back(i);
  }
  return model;
}

TEST(QuadraticSolid, PatchTest) {
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.2, -0.3, 0.5, -1.0, 0.4, 0.1, 0.7, 0.6;
  for (const bool tetrahedra : {false, true}) {
    std::vector<int> inner;
    const Model model = distorted_box(tetrahedra, inner);
    validate(model);
    const Eigen::MatrixXd k = test::full(assemble(model, {}).stiffness({}));
    Eigen::VectorXd exact(k.rows());
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
      exact.segment<3>(3 * static_cast<Eigen::Index>(i)) = 1e-3 * gradient * model.nodes[i].x_m;
    const Eigen::VectorXd force = k * exact;
    EXPECT_EQ(inner.empty(), !tetrahedra);
    for (const int i : inner) EXPECT_LT(force.segment<3>(3 * i).norm(), 1e-13 * force.norm());
    // Forces and moments of the stresses balance, and their work is ½ σ:ε V.
    const Eigen::Matrix3d strain = 0.5e-3 * (gradient + gradient.transpose());
    const Eigen::Matrix3d stress =
        1e6 / 1.25 * (strain + 0.25 / 0.5 * strain.trace() * Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
    EXPECT_NEAR(0.5 * exact.dot(force), 0.5 * (stress * strain).trace() * 2.0, 1e-10);
  }
}

// ∫ x² and ∫ x of the unit box and of the corner tetrahedron; a box with a bulged face gains 2/3 of the bulge times the face at
// four middles: volumes and first moments are those of the functions, whatever the edges.
TEST(QuadraticSolid, Masses) {
  const double rho = 2500.0;
  const QuadraticSolid corner = with_middles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const auto moment = [&](const QuadraticSolid& solid, const Eigen::MatrixXd& m) {
    const Eigen::VectorXd x = field_on(solid, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), 0.0, 0.0); });
    return x.dot(m * x);
  };
  EXPECT_NEAR(quadratic_solid_mass(corner, rho).sum(), 3.0 * rho / 6.0, 1e-9);
  EXPECT_NEAR(moment(corner, quadratic_solid_mass(corner, rho)), rho / 60.0, 1e-9);
  const QuadraticSolid brick = box(2.0, 3.0, 0.5);
  EXPECT_NEAR(quadratic_solid_mass(brick, rho).sum(), 3.0 * rho * 3.0, 1e-8);
  EXPECT_NEAR(moment(brick, quadratic_solid_mass(brick, rho)), rho * 8.0 / 3.0 * 1.5, 1e-8);
  for (const QuadraticSolid& solid : crooked_solids(0.03)) {
    const Eigen::MatrixXd consistent = quadratic_solid_mass(solid, rho), lumped = quadratic_solid_mass_lumped(solid, rho);
    const double mass = rho * quadratic_solid_shape(solid).volume_m3;
    EXPECT_NEAR(consistent.sum(), 3.0 * mass, 1e-12 * mass);
    EXPECT_NEAR(lumped.sum(), 3.0 * mass, 1e-12 * mass);
    EXPECT_GT(lumped.diagonal().minCoeff(), 0.0);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(consistent).eigenvalues()[0], 0.0);
  }
  std::vector<int> inner;
  const Model model = distorted_box(true, inner);
  EXPECT_NEAR(mass_properties(model).mass_kg.x(), 2000.0, 1e-9);
  EXPECT_LT((mass_properties(model).centre_m - Eigen::Vector3d(1.0, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(dead_load(model).sum(), -2000.0 * 9.81, 1e-7);
}

// u_x = -κ x z, u_z = κ x²/2 + ν κ (z² - y²)/2, u_y = ν κ y z is the exact solution of pure bending: quadratic, so in the space
// of both elements. Its energy is ½ E I κ² L.
TEST(QuadraticSolid, PureBendingIsExact) {
  const double kappa = 1e-3, nu = 0.3, e = 210e9, length = 3.0, b = 0.4, h = 0.6;
  const QuadraticSolid solid = box(length, b, h);
  const Eigen::VectorXd u = field_on(solid, [&](const Eigen::Vector3d& at) {
    const double x = at.x(), y = at.y() - 0.5 * b, z = at.z() - 0.5 * h;
    return Eigen::Vector3d(-kappa * x * z, nu * kappa * y * z, 0.5 * kappa * x * x + 0.5 * nu * kappa * (z * z - y * y));
  });
  const double energy = 0.5 * u.dot(quadratic_solid_stiffness(solid, {e, nu}) * u);
  EXPECT_NEAR(energy, 0.5 * e * b * h * h * h / 12.0 * kappa * kappa * length, 1e-10 * energy);
}

/// Boxes over the grid of x, y and z, each one hexahedron or six tetrahedra about a diagonal, with nodes on edges.
Model boxes(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z, bool tetrahedra,
            const Material& material) {
  Model model;
  model.source = "boxes";
  model.materials.push_back(material);
  for (const double c : z)
    for (const double b : y)
      for (const double a : x) test::add_node(model, a, b, c);
  const auto nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size()), nz = static_cast<int>(z.size());
  for (int k = 0; k + 1 < nz; ++k)
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i) {
        const int n = i + nx * (j + ny * k), up = nx * ny;
        const std::vector<int> c = {n, n + 1, n + nx + 1, n + nx, n + up, n + up + 1, n + up + nx + 1, n + up + nx};
        if (!tetrahedra) test::add_element(model, ElementType::solid, "all", 0, -1, c);
        for (const auto& t : {std::array{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
          if (tetrahedra)
            test::add_element(model, ElementType::solid, "all", 0, -1, {c[0], c[slot(t[0])], c[slot(t[1])], c[6]});
      }
  test::make_quadratic(model);
  return model;
}

std::vector<double> steps(int n, double length) {
  std::vector<double> at;
  for (int i = 0; i <= n; ++i) at.push_back(length * i / n);
  return at;
}

/// Frequencies [Hz], ascending, by a dense solver.
Eigen::VectorXd frequencies_of(const Model& model) {
  validate(model);
  const ParametricSystem system = assemble(model, {});
  const Eigen::VectorXd theta = system.initial();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      test::full(system.stiffness(theta)), test::full(system.mass(theta)), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

// Timoshenko's cantilever of 10 m, 0.5 m square, E 200 GPa, G 100 GPa, as in decks_test.cpp: 4.03187 and 25.0236 Hz twice each.
TEST(QuadraticSolid, ModesOfACantilever) {
  for (const bool tetrahedra : {false, true})
    for (const bool lumped : {false, true}) {
      Model model = boxes(steps(10, 10.0), {0.0, 0.5}, {0.0, 0.5}, tetrahedra, {"m", 200e9, 100e9, 0.0, 8000.0});
      model.formulation.lumped_mass = lumped;
      for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i)
        if (model.nodes[slot(i)].x_m.x() < 1e-9) test::fix(model, i, {true, true, true, false, false, false});
      const Eigen::VectorXd f = frequencies_of(model);
      const double allowed = lumped ? 0.02 : 0.01;
      for (const auto& [mode, exact] : {std::pair{0, 4.03187}, {1, 4.03187}, {2, 25.0236}, {3, 25.0236}})
        EXPECT_NEAR(f[mode], exact, allowed * exact) << tetrahedra << lumped;
    }
}

// A square plate of 1 m, 10 mm, on four simple supports: f = π/a² sqrt(D/(ρ t)) (Kirchhoff). A quarter of it: symmetric at x =
// 0 and y = 0, held at x = y = 0.5 m. Aspect ratio 12.5 in four elements a side.
TEST(QuadraticSolid, ModeOfAThinPlate) {
  Model model = boxes(steps(4, 0.5), steps(4, 0.5), {0.0, 0.01}, false, {"m", 200e9, 200e9 / 2.6, 0.3, 8000.0});
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    const Eigen::Vector3d x = model.nodes[slot(i)].x_m;
    const bool far_x = x.x() > 0.5 - 1e-9, far_y = x.y() > 0.5 - 1e-9;
    test::fix(model, i, {x.x() < 1e-9 || far_y, x.y() < 1e-9 || far_x, far_x || far_y, false, false, false});
  }
  const double exact = std::numbers::pi * std::sqrt(200e9 * 1e-6 / (12.0 * 0.91) / (8000.0 * 0.01));
  EXPECT_NEAR(frequencies_of(model)[0], exact, 0.01 * exact);
}

TEST(QuadraticSolid, AFreeBodyHasSixModesAtZero) {
  for (const bool tetrahedra : {false, true}) {
    const Eigen::VectorXd f =
        frequencies_of(boxes(steps(2, 2.0), {0.0, 0.7}, {0.0, 0.5}, tetrahedra, {"m", 200e9, 80e9, 0.25, 8000.0}));
    EXPECT_LT(f[5], 1e-3) << tetrahedra;
    EXPECT_GT(f[6], 100.0) << tetrahedra;
  }
}

// Pulled along its axis by σ, a bar gains string stiffness: a rigid turn by φ about an end costs ½ σ A L φ². The stress is that
// of the linear displacement, so it holds for both elements.
TEST(QuadraticSolid, GeometricStiffnessOfATension) {
  const double strain = 1e-3, e = 210e9;
  std::vector<QuadraticSolid> solids = crooked_solids(0.0);
  for (const QuadraticSolid& solid : solids) {
    const auto pull = [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(strain * x.x(), 0.0, 0.0); };
    const auto turn = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(0.0, 0.0, x.x()); };
    const Eigen::VectorXd u = field_on(solid, turn);
    const Eigen::MatrixXd k = quadratic_solid_geometric_stiffness(solid, {e, 0.0}, field_on(solid, pull));
    const double exact = e * strain * quadratic_solid_shape(solid).volume_m3;
    EXPECT_NEAR(u.dot(k * u), exact, 1e-9 * exact);
  }
}

TEST(QuadraticSolid, FaultyShapesAreNamed) {
  const auto refusal = [](const Model& model) -> std::string {
    try {
      validate(model);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Material material{"m", 1e6, 0.4e6, 0.25, 1000.0};
  Model model = boxes({0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}, false, material);
  EXPECT_EQ(refusal(model), "");
  std::swap(model.elements[0].nodes[12], model.elements[0].nodes[16]);  // another program's order
  EXPECT_NE(refusal(model).find("is folded or flat near node"), std::string::npos) << refusal(model);
  EXPECT_NE(refusal(model).find("corners first, then the nodes in the middles"), std::string::npos) << refusal(model);
  model = boxes({0.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}, false, material);
  EXPECT_NE(refusal(model).find("has no volume"), std::string::npos) << refusal(model);
  EXPECT_THROW(
      (void)quadratic_solid_stiffness(with_middles(std::vector<Eigen::Vector3d>(4, Eigen::Vector3d::Zero())), {1.0, 0.0}),
      InputError);
}

}  // namespace
}  // namespace twindeck::fe::quadratic_solids
