// Oracle: mass, centre and inertia of a brick, a rod and a sphere as textbooks have them.
#include "fe/mass_properties.hpp"

#include <gtest/gtest.h>

#include "assembly_models.hpp"

namespace twindeck::fe {
namespace {

TEST(MassProperties, OfABrick) {
  Model model = test::with_steel();
  for (const double z : {0.0, 2.0})
    for (const auto& [x, y] : {std::pair{5.0, 0.0}, {8.0, 0.0}, {8.0, 1.0}, {5.0, 1.0}}) test::add_node(model, x, y, z);
  test::add_element(model, ElementType::solid, "brick", 0, -1, {0, 1, 2, 3, 4, 5, 6, 7});
  const MassProperties p = mass_properties(model);
  const double mass = 8000.0 * 6.0;
  EXPECT_LT((p.mass_kg - Eigen::Vector3d::Constant(mass)).norm(), 1e-9 * mass);
  EXPECT_LT((p.centre_m - Eigen::Vector3d(6.5, 0.5, 1.0)).norm(), 1e-12);
  // A brick's consistent matrix moves as the brick does: m/12 (b² + c²).
  const Eigen::Vector3d exact = mass / 12.0 * Eigen::Vector3d(1.0 + 4.0, 9.0 + 4.0, 9.0 + 1.0);
  EXPECT_LT((p.inertia_kg_m2 - Eigen::Matrix3d(exact.asDiagonal())).norm(), 1e-9 * mass);
}

TEST(MassProperties, OfARodWithAMassAtItsEnd) {
  Model model = test::cantilever();  // 4 m along x, 80 kg/m
  model.masses.push_back({"tip", 2, 320.0, {10.0, 20.0, 30.0}});
  const MassProperties p = mass_properties(model);
  EXPECT_NEAR(p.mass_kg[1], 640.0, 1e-9);
  EXPECT_NEAR(p.centre_m.x(), 3.0, 1e-12);
  // Rod m l²/12 and each half one metre from the common centre.
  const double across = 320.0 * 16.0 / 12.0 + 2.0 * 320.0;
  EXPECT_NEAR(p.inertia_kg_m2(1, 1), across + 20.0, 1e-9 * across);
  EXPECT_NEAR(p.inertia_kg_m2(2, 2), across + 30.0, 1e-9 * across);
  EXPECT_NEAR(p.inertia_kg_m2(0, 1), 0.0, 1e-9 * across);
}

TEST(MassProperties, OfMassesThatAreMatrices) {
  // Two points of 2 kg at (1, 1, 0) and (-1, -1, 0), of which one acts along z alone.
  Model model;
  test::add_node(model, 1.0, 1.0, 0.0), test::add_node(model, -1.0, -1.0, 0.0);
  MatrixElement matrix;
  matrix.name = "mass";
  matrix.dofs = {{0, 2}};
  matrix.mass = Eigen::MatrixXd::Constant(1, 1, 2.0);
  model.matrix_elements.push_back(matrix);
  EXPECT_EQ(mass_properties(model).mass_kg, Eigen::Vector3d(0.0, 0.0, 2.0));
  model.matrix_elements.clear();
  model.masses = {{"a", 0, 2.0, Eigen::Vector3d::Zero()}, {"b", 1, 2.0, Eigen::Vector3d::Zero()}};
  const MassProperties p = mass_properties(model);
  EXPECT_EQ(p.centre_m, Eigen::Vector3d::Zero());
  EXPECT_NEAR(p.inertia_kg_m2(0, 1), -4.0, 1e-12);  // -∫ x y dm
  EXPECT_NEAR(p.inertia_kg_m2(2, 2), 8.0, 1e-12);
}

}  // namespace
}  // namespace twindeck::fe
