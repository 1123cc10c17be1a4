#include "fe/solid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/static_stage.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::fe {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

SolidGeometry box(double a, double b, double c) {
  SolidGeometry g;
  const double x[8] = {0, 1, 1, 0, 0, 1, 1, 0}, y[8] = {0, 0, 1, 1, 0, 0, 1, 1}, z[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) g.node_m[i] = {a * x[i], b * y[i], c * z[i]};
  return g;
}

/// A box whose corners have each been pulled somewhere else.
SolidGeometry distorted() {
  SolidGeometry g = box(1.0, 0.8, 0.6);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto s = static_cast<double>(i);
    g.node_m[i] += 0.12 * Eigen::Vector3d(std::sin(1.0 + 2.0 * s), std::cos(2.0 * s), std::sin(3.0 + 5.0 * s));
  }
  return g;
}

/// MacNeal and Harder (1985), figure 2: a unit cube of seven solids round a distorted one. Nodes 1-8 inner, 9-16 corners.
Model macneal_cube() {
  Model model;
  model.source = "cube";
  model.materials.push_back({"m", 1e6, 0.4e6, 0.25, 1000.0});
  const double inner[8][3] = {{.249, .342, .192}, {.826, .288, .288}, {.850, .649, .263}, {.273, .750, .230},
                              {.320, .186, .643}, {.677, .305, .683}, {.788, .693, .644}, {.165, .745, .702}};
  for (const auto& x : inner) test::add_node(model, x[0], x[1], x[2]);
  for (const Eigen::Vector3d& x : box(1, 1, 1).node_m) test::add_node(model, x.x(), x.y(), x.z());
  test::add_element(model, ElementType::solid, "cube", 0, -1, {0, 1, 2, 3, 4, 5, 6, 7});
  const int side[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& f : side) {
    std::vector<int> outer, within;
    for (const int i : f) outer.push_back(8 + i), within.push_back(i);
    std::vector<int> nodes = outer;
    nodes.insert(nodes.end(), within.begin(), within.end());
    SolidGeometry g;
    for (std::size_t i = 0; i < 8; ++i) g.node_m[i] = model.nodes[static_cast<std::size_t>(nodes[i])].x_m;
    if (solid_shape(g).volume_m3 < 0.0) std::rotate(nodes.begin(), nodes.begin() + 4, nodes.end());
    test::add_element(model, ElementType::solid, "cube", 0, -1, nodes);
  }
  return model;
}

// Oracle: the solid patch test of MacNeal and Harder (1985): u = 1e-3 (2x + y + z)/2 and so on in turn on the faces gives the
// same inside, σxx = σyy = σzz = 2000 and τ = 400 for E = 1e6, ν = 0.25, however the elements are distorted.
TEST(Solid, PatchTest) {
  const Model model = macneal_cube();
  const ParametricSystem system = assemble(model, {});
  ASSERT_EQ(system.size(), 48);
  const Eigen::MatrixXd k = linalg::SparseMatrix(system.stiffness({}).selfadjointView<Eigen::Lower>());
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.5, 0.5, 0.5, 1.0, 0.5, 0.5, 0.5, 1.0;
  Eigen::VectorXd exact(48);
  for (std::size_t i = 0; i < 16; ++i)
    exact.segment<3>(3 * static_cast<Eigen::Index>(i)) = 1e-3 * gradient * model.nodes[i].x_m;
  const Eigen::VectorXd u =
      Eigen::MatrixXd(k.topLeftCorner<24, 24>()).ldlt().solve(Eigen::VectorXd(-k.topRightCorner<24, 24>() * exact.tail<24>()));
  EXPECT_NEAR((u - exact.head<24>()).norm() / exact.head<24>().norm(), 0.0, 1e-12);
  // Forces on the faces are those of the stress, whose energy is ½ σ:ε V.
  EXPECT_NEAR(0.5 * exact.dot(k * exact), 0.5 * (3 * 2000.0 * 1e-3 + 3 * 400.0 * 1e-3), 1e-10);
}

// Oracle: a body that moves as a whole has no strain; everything else does (rank 18, no zero-energy mode).
TEST(Solid, SixRigidMotionsAndNoOther) {
  const SolidGeometry g = distorted();
  const MatrixSolid k = solid_stiffness(g, {210e9, 0.3});
  Eigen::Matrix<double, 24, 6> rigid;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d& x = g.node_m[static_cast<std::size_t>(i)];
    rigid.block<3, 3>(3 * i, 0).setIdentity();
    for (int a = 0; a < 3; ++a) rigid.block<3, 1>(3 * i, 3 + a) = Eigen::Vector3d::Unit(a).cross(x);
  }
  EXPECT_LT((k * rigid).norm() / k.norm(), 1e-14);
  const Vector24 eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  EXPECT_LT(std::abs(eigenvalues[5]), 1e-12 * eigenvalues[23]);
  EXPECT_GT(eigenvalues[6], 1e-4 * eigenvalues[23]);
}

// Oracle: Euler-Bernoulli: a box under pure bending has the energy ½ E I κ² L about either axis (ν = 0), where a
// trilinear box without internal modes would add the parasitic shear energy of a slender one many times over.
TEST(Solid, PureBendingOfABox) {
  const double a = 2.0, b = 0.2, c = 0.3, kappa = 1e-3, e = 210e9;
  SolidGeometry g = box(a, b, c);
  for (Eigen::Vector3d& x : g.node_m) x -= Eigen::Vector3d(0.5 * a, 0.5 * b, 0.5 * c);
  const MatrixSolid k = solid_stiffness(g, {e, 0.0});
  for (const int across : {1, 2}) {
    Vector24 u = Vector24::Zero();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d& x = g.node_m[static_cast<std::size_t>(i)];
      u[3 * i] = -kappa * x.x() * x[across];
      u[3 * i + across] = 0.5 * kappa * x.x() * x.x();
    }
    const double inertia = across == 1 ? c * b * b * b / 12.0 : b * c * c * c / 12.0;
    EXPECT_NEAR(u.dot(k * u) / (e * inertia * kappa * kappa * a), 1.0, 1e-12);
  }
}

// Oracle: the tensor product of [[2, 1], [1, 2]]/6 for a box; the volume of a distorted solid by its own determinant; a body
// that moves as a whole by u has ½ m u².
TEST(Solid, Masses) {
  const double rho = 2500.0;
  const MatrixSolid m = solid_mass(box(2.0, 3.0, 0.5), rho);
  EXPECT_NEAR(m(0, 0), rho * 3.0 / 27.0, 1e-9);
  EXPECT_NEAR(m(0, 3), rho * 3.0 / 54.0, 1e-9);
  EXPECT_NEAR(m(0, 18), rho * 3.0 / 216.0, 1e-9);
  EXPECT_EQ(m(0, 1), 0.0);
  const SolidGeometry g = distorted();
  Vector24 u;
  for (int i = 0; i < 8; ++i) u.segment<3>(3 * i) << 1.0, 2.0, -2.0;
  const double expected = 9.0 * rho * solid_shape(g).volume_m3;
  EXPECT_NEAR(u.dot(solid_mass(g, rho) * u), expected, 1e-9 * expected);
  const MatrixSolid lumped = solid_mass_lumped(g, rho);
  EXPECT_NEAR(u.dot(lumped * u), expected, 1e-9 * expected);
  EXPECT_TRUE(lumped.isDiagonal());
  EXPECT_GT(lumped.diagonal().minCoeff(), 0.0);
}

// Oracle: K is linear in E and M in rho, and the weight of what stands on the ground is g rho V.
TEST(Solid, ParametersAndWeight) {
  Model model = macneal_cube();
  model.parameters = {{"E", Target::youngs_modulus, {"m"}, "Pa", 1e6, 5e5, 2e6},
                      {"rho", Target::density, {"m"}, "kg/m3", 1000.0, 500.0, 2000.0}};
  const ParametricSystem system = assemble(model, {});
  const Eigen::Vector2d theta = system.initial(), other(1.5e6, 700.0);
  EXPECT_NEAR((system.stiffness(other) - 1.5 * system.stiffness(theta)).norm() / system.stiffness(other).norm(), 0.0, 1e-14);
  EXPECT_NEAR((system.mass(other) - 0.7 * system.mass(theta)).norm() / system.mass(other).norm(), 0.0, 1e-14);
  const Model changed = with_parameters(model, other);
  EXPECT_NEAR((assemble(changed, {}).stiffness(other) - system.stiffness(other)).norm() / system.stiffness(other).norm(), 0.0,
              1e-14);
  EXPECT_NEAR(dead_load(model).sum(), -1000.0 * 9.81, 1e-8);
}

std::string refusal_of_shape(const Model& model) {
  try {
    validate(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Oracle: each model has one fault made on purpose; the message names the element, its nodes and the way out.
TEST(Solid, FaultyShapesAreNamed) {
  EXPECT_EQ(refusal_of_shape(macneal_cube()), "");
  Model model = macneal_cube();
  std::rotate(model.elements[0].nodes.begin(), model.elements[0].nodes.begin() + 4, model.elements[0].nodes.end());
  EXPECT_NE(refusal_of_shape(model).find("cube: element 1: the solid 5-6-7-8-1-2-3-4 is inverted"), std::string::npos)
      << refusal_of_shape(model);
  model = macneal_cube();
  std::swap(model.elements[0].nodes[0], model.elements[0].nodes[1]);
  EXPECT_NE(refusal_of_shape(model).find("element 1: the solid 2-1-3-4-5-6-7-8 is folded or flat near node"), std::string::npos)
      << refusal_of_shape(model);
  model = macneal_cube();
  for (std::size_t i = 4; i < 8; ++i) model.nodes[i].x_m = model.nodes[i - 4].x_m;
  EXPECT_NE(refusal_of_shape(model).find("element 1: the solid 1-2-3-4-5-6-7-8 has no volume"), std::string::npos)
      << refusal_of_shape(model);
  model = macneal_cube();
  model.elements[0].nodes.pop_back();
  EXPECT_NE(refusal_of_shape(model).find("element 1: has 7 nodes, expected 4, 8, 10 or 20"), std::string::npos)
      << refusal_of_shape(model);
  model = macneal_cube();
  model.materials[0].poisson_ratio = 0.5;
  EXPECT_NE(refusal_of_shape(model).find("Poisson's ratio is 0.5"), std::string::npos) << refusal_of_shape(model);
  EXPECT_THROW((void)solid_stiffness(box(1.0, 1.0, -1.0), {1.0, 0.0}), InputError);
}

}  // namespace
}  // namespace twindeck::fe
