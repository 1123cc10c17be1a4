// Oracles: the values in the model's tables, and their ratios by hand.
#include "fe/assembly_parameters.hpp"

#include <gtest/gtest.h>

#include "assembly_models.hpp"
#include "core/error.hpp"

namespace twindeck::fe {
namespace {

// Oracle: materials and sections say their own values, whatever `initial` says; factors of groups stand for themselves.
TEST(AssemblyParameters, InitialValuesAreThoseOfTheTables) {
  Model model = test::one_of_everything();
  for (Parameter& p : model.parameters)
    if (p.target != Target::spring_stiffness && p.target != Target::point_mass) p.initial = 77.0;
  Eigen::VectorXd expected(9);
  expected << 200e9, 30e9, 165e9, 2400.0, 0.1, 2.0, 0.01, 1.0, 1.0;
  EXPECT_EQ(initial_parameters(model), expected);
  EXPECT_EQ(initial_parameters(test::cantilever()).size(), 0);
}

// Oracle: every property times its own ratio; G follows E; nothing else moves.
TEST(AssemblyParameters, ValuesAreWrittenIntoTheModel) {
  const Model model = test::one_of_everything();
  Eigen::VectorXd theta(9);
  theta << 100e9, 60e9, 165e9, 3000.0, 0.2, 5.0, 0.03, 4.0, 0.5;
  const Model changed = with_parameters(model, theta);
  EXPECT_DOUBLE_EQ(changed.materials[0].youngs_modulus_Pa, 100e9);
  EXPECT_DOUBLE_EQ(changed.materials[0].shear_modulus_Pa, 40e9);
  EXPECT_DOUBLE_EQ(changed.materials[0].density_kg_m3, 8000.0);
  EXPECT_DOUBLE_EQ(changed.materials[1].youngs_modulus_Pa, 60e9);
  EXPECT_DOUBLE_EQ(changed.materials[1].shear_modulus_Pa, 25e9);
  EXPECT_DOUBLE_EQ(changed.materials[1].density_kg_m3, 3000.0);
  EXPECT_DOUBLE_EQ(changed.materials[2].youngs_modulus_Pa, 165e9);
  EXPECT_DOUBLE_EQ(changed.sections[1].thickness_m, 0.2);
  EXPECT_DOUBLE_EQ(changed.sections[1].bending_inertia_ratio, 5.0);
  EXPECT_DOUBLE_EQ(changed.sections[0].area_m2, 0.03);
  EXPECT_DOUBLE_EQ(changed.sections[0].inertia_y_m4, 4e-5);
  EXPECT_DOUBLE_EQ(changed.sections[0].shear_area_y_m2, 0.006);
  EXPECT_DOUBLE_EQ(changed.sections[2].area_m2, 1.3e-3);
  EXPECT_DOUBLE_EQ(changed.springs[0].stiffness, 8e6);
  EXPECT_DOUBLE_EQ(changed.masses[0].mass_kg, 150.0);
  EXPECT_LT((changed.masses[0].inertia_kg_m2 - Eigen::Vector3d(2.5, 3.0, 3.5)).norm(), 1e-15);
  EXPECT_EQ(initial_parameters(changed), theta);
  for (std::size_t p = 0; p < model.parameters.size(); ++p)
    EXPECT_EQ(with_parameters(changed, 2.0 * theta).parameters[p].nominal, model.parameters[p].initial);
}

// Oracle: going back gives the first model (each ratio and its inverse are powers of two: no rounding).
TEST(AssemblyParameters, GoingBackIsExact) {
  const Model model = test::one_of_everything();
  const Eigen::VectorXd theta = initial_parameters(model);
  const Model back = with_parameters(with_parameters(model, 4.0 * theta), theta);
  EXPECT_EQ(back.materials[0].shear_modulus_Pa, model.materials[0].shear_modulus_Pa);
  EXPECT_EQ(back.sections[1].thickness_m, model.sections[1].thickness_m);
  EXPECT_EQ(back.springs[0].stiffness, model.springs[0].stiffness);
  EXPECT_EQ(back.masses[0].inertia_kg_m2, model.masses[0].inertia_kg_m2);
}

// Oracle: a parameter of two materials has the value of the first in the table; the second keeps its ratio to it.
TEST(AssemblyParameters, ThingsOfOneParameterKeepTheirRatio) {
  Model model = test::one_of_everything();
  model.parameters = {{"E", Target::youngs_modulus, {"cable", "concrete"}, "Pa", 30e9, 1e9, 1e12}};
  EXPECT_EQ(initial_parameters(model)[0], 30e9);
  const Model changed = with_parameters(model, Eigen::VectorXd::Constant(1, 45e9));
  EXPECT_DOUBLE_EQ(changed.materials[1].youngs_modulus_Pa, 45e9);
  EXPECT_DOUBLE_EQ(changed.materials[2].youngs_modulus_Pa, 1.5 * 165e9);
  EXPECT_EQ(changed.materials[0].youngs_modulus_Pa, 200e9);
}

// Oracle: the contract: one value a parameter.
TEST(AssemblyParameters, AsksForOneValueEach) {
  EXPECT_THROW((void)with_parameters(test::one_of_everything(), Eigen::VectorXd::Ones(3)), InternalError);
}

}  // namespace
}  // namespace twindeck::fe
