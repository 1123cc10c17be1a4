// Oracles: a cantilever that its stay holds up, by statics; the functions that do the same for a single use.
#include "fe/structure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly_models.hpp"
#include "core/error.hpp"

namespace twindeck::fe {
namespace {

/// Cantilever of 4 m along X under 1600 N; a weightless stay goes straight up from its tip, 3 m long.
Model held_cantilever() {
  Model model = test::cantilever();
  model.materials.push_back({"rope", 200e9, 80e9, 0.3, 0.0});
  test::add_node(model, 4.0, 0.0, 3.0);
  test::add_element(model, ElementType::stay, "stays", 1, 0, {2, 3}).name = "S1";
  model.elements[2].pull_N = 900.0;
  test::fix(model, 3, {true, true, true, false, false, false});
  model.prestress.rule = PullRule::given;
  model.parameters.push_back({"rho", Target::density, {"steel"}, "kg/m3", 8000.0, 4000.0, 32000.0});
  return model;
}

// Oracle: tip displacement (T L³/3 - w L⁴/8)/(E I), E I = 8e6 N m2, w = 800 N/m times the density's ratio.
TEST(Structure, PrestressFollowsItsParameters) {
  const Structure structure(held_cantilever());
  for (const double ratio : {1.0, 2.0}) {
    const PrestressState state = structure.prestress(Eigen::VectorXd::Constant(1, 8000.0 * ratio));
    EXPECT_EQ(state.stay_pull_N[2], 900.0);
    EXPECT_NEAR(state.displacement[14], (900.0 * 64.0 / 3.0 - ratio * 800.0 * 256.0 / 8.0) / 8e6, 1e-10);
  }
  EXPECT_EQ(structure.model().materials[0].density_kg_m3, 8000.0);  // its own model stays as it is
}

// Oracle: across the stay T/L = 300 N/m beside 3 E I/L³ of the beam; along it E A/L, no geometry. Without geometric stiffness
// the string is gone.
TEST(Structure, SystemHasTheStayAndItsString) {
  Model model = held_cantilever();
  const Structure structure(model);
  const Eigen::VectorXd theta = Eigen::VectorXd::Constant(1, 8000.0);
  const PrestressState state = structure.prestress(theta);
  const auto tip = [](const ParametricSystem& system) {
    const Eigen::MatrixXd k = test::full(system.stiffness(system.initial()));
    return Eigen::Vector3d(k.diagonal().segment<3>(6));
  };
  model.prestress.geometric_stiffness = false;
  const Eigen::Vector3d bare = tip(Structure(model).system(state)), with = tip(structure.system(state));
  EXPECT_NEAR(bare.z() - 12e6, 200e9 * 0.01 / 3.0, 1.0);
  EXPECT_NEAR(with.x() - bare.x(), 300.0, 1e-5);
  EXPECT_NEAR(with.y() - bare.y(), 300.0, 1e-5);
  EXPECT_NEAR(with.z() - bare.z(), 0.0, 1e-5);
}

// Oracle: the header: assemble and find_prestress do the same; copies share; several uses do not change it.
TEST(Structure, AgreesWithTheFunctionsOfASingleUse) {
  const Model model = test::one_of_everything();
  const Structure structure(model), copy = structure;
  const Eigen::VectorXd theta = initial_parameters(model);
  const PrestressState state = structure.prestress(theta), single = find_prestress(model, theta);
  EXPECT_EQ(state.displacement, single.displacement);
  EXPECT_EQ(state.axial_force_N, single.axial_force_N);
  (void)structure.prestress(1.3 * theta);
  const auto k = [&](const ParametricSystem& system) { return Eigen::MatrixXd(system.stiffness(theta)); };
  EXPECT_EQ(k(copy.system(state)), k(assemble(model, state)));
  EXPECT_EQ(&copy.model(), &structure.model());
}

// Oracle: the contract.
TEST(Structure, RefusesWhatDoesNotFit) {
  Model model = test::cantilever();
  model.materials[0].youngs_modulus_Pa = -1.0;
  EXPECT_THROW(Structure{model}, InputError);
  PrestressState state;
  state.stay_pull_N = Eigen::VectorXd::Zero(1);
  EXPECT_THROW((void)Structure(test::cantilever()).system(state), InternalError);
  EXPECT_EQ(Structure(test::cantilever()).prestress(Eigen::VectorXd(0)).displacement.norm(), 0.0);  // no rule, no force
}

}  // namespace
}  // namespace twindeck::fe
