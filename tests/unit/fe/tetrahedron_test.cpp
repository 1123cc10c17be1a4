/// Oracles: constant strain (patch test), rigid motions, the volume of a unit corner, a body that moves as a whole.
#include "fe/tetrahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/large_displacement.hpp"
#include "fe/static_stage.hpp"
#include "fe/structure.hpp"
#include "fe/validate.hpp"

namespace twindeck::fe {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

TetrahedronGeometry crooked() {
  return {{Eigen::Vector3d(0.1, 0.2, 0.0), Eigen::Vector3d(1.2, 0.1, 0.3), Eigen::Vector3d(0.2, 0.9, -0.1),
           Eigen::Vector3d(0.4, 0.3, 0.8)}};
}

/// A cube of five tetrahedra round a node that lies off its middle: the cube's corners are nodes 0 to 7.
Model cube_of_tetrahedra() {
  Model model;
  model.source = "cube";
  model.materials.push_back({"m", 1e6, 0.4e6, 0.25, 1000.0});
  for (int i = 0; i < 8; ++i) test::add_node(model, i & 1, (i >> 1) & 1, (i >> 2) & 1);
  test::add_node(model, 0.4, 0.55, 0.6);
  // Two triangles a face, each with the inner node.
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  for (const auto& f : faces)
    for (const auto& corners : {std::array{f[0], f[2], f[1]}, std::array{f[0], f[3], f[2]}})
      test::add_element(model, ElementType::solid, "cube", 0, -1, {corners[0], corners[1], corners[2], 8});
  return model;
}

TEST(Tetrahedron, PatchTest) {
  const Model model = cube_of_tetrahedra();
  validate(model);
  const ParametricSystem system = assemble(model, {});
  ASSERT_EQ(system.size(), 27);
  const Eigen::MatrixXd k = linalg::SparseMatrix(system.stiffness({}).selfadjointView<Eigen::Lower>());
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.5, 0.5, 0.5, 1.0, 0.5, 0.5, 0.5, 1.0;
  Eigen::VectorXd exact(27);
  for (std::size_t i = 0; i < 9; ++i) exact.segment<3>(3 * static_cast<Eigen::Index>(i)) = 1e-3 * gradient * model.nodes[i].x_m;
  const Eigen::Vector3d inside =
      Eigen::Matrix3d(k.bottomRightCorner<3, 3>()).ldlt().solve(-k.bottomLeftCorner<3, 24>() * exact.head<24>());
  EXPECT_LT((inside - exact.tail<3>()).norm(), 1e-15);
  // ½ σ:ε V with σ = 2000 Pa in all directions and τ = 400 Pa, as for the hexahedron (solid_test.cpp).
  EXPECT_NEAR(0.5 * exact.dot(k * exact), 0.5 * (3 * 2000.0 * 1e-3 + 3 * 400.0 * 1e-3), 1e-10);
}

TEST(Tetrahedron, SixRigidMotionsAndNoOther) {
  const TetrahedronGeometry g = crooked();
  const MatrixTetrahedron k = tetrahedron_stiffness(g, {210e9, 0.3});
  Eigen::Matrix<double, 12, 6> rigid;
  for (int i = 0; i < 4; ++i) {
    rigid.block<3, 3>(3 * i, 0).setIdentity();
    for (int a = 0; a < 3; ++a)
      rigid.block<3, 1>(3 * i, 3 + a) = Eigen::Vector3d::Unit(a).cross(g.node_m[static_cast<std::size_t>(i)]);
  }
  EXPECT_LT((k * rigid).norm() / k.norm(), 1e-14);
  const Vector12 eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  EXPECT_LT(std::abs(eigenvalues[5]), 1e-12 * eigenvalues[11]);
  EXPECT_GT(eigenvalues[6], 1e-3 * eigenvalues[11]);
}

TEST(Tetrahedron, VolumeAndMasses) {
  const TetrahedronGeometry corner{
      {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}};
  EXPECT_NEAR(tetrahedron_volume(corner), 1.0 / 6.0, 1e-15);
  const double rho = 2500.0, mass = rho / 6.0;
  EXPECT_NEAR(tetrahedron_mass(corner, rho)(0, 0), mass / 10.0, 1e-12);
  EXPECT_NEAR(tetrahedron_mass(corner, rho)(0, 3), mass / 20.0, 1e-12);
  Vector12 u;
  for (int i = 0; i < 4; ++i) u.segment<3>(3 * i) << 1.0, 2.0, -2.0;
  EXPECT_NEAR(u.dot(tetrahedron_mass(corner, rho) * u), 9.0 * mass, 1e-9);
  EXPECT_NEAR(u.dot(tetrahedron_mass_lumped(corner, rho) * u), 9.0 * mass, 1e-9);
  EXPECT_NEAR(dead_load(cube_of_tetrahedra()).sum(), -1000.0 * 9.81, 1e-8);
}

TEST(Tetrahedron, FaultyShapesAreNamed) {
  const auto refusal = [](const Model& model) -> std::string {
    try {
      validate(model);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Model model = cube_of_tetrahedra();
  std::swap(model.elements[0].nodes[0], model.elements[0].nodes[1]);
  EXPECT_NE(refusal(model).find("cube: element 1: the solid 4-1-3-9 is inverted"), std::string::npos) << refusal(model);
  model = cube_of_tetrahedra();
  model.nodes[8].x_m.z() = 0.0;  // in the plane of the lowest face
  EXPECT_NE(refusal(model).find("has no volume"), std::string::npos) << refusal(model);
}

}  // namespace
}  // namespace twindeck::fe
