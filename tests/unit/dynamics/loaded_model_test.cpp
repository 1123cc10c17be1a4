// A model on its way to its modes. Oracles: Euler's cantilever in closed form, and that frequencies go with sqrt(E); a chain of
// springs in closed form; what is refused.
#include "dynamics/loaded_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "spring_chain.hpp"

namespace twindeck::dynamics {
namespace {

constexpr double kModulus_Pa = 200e9, kDensity_kg_m3 = 8000.0, kInertia_m4 = 1e-5, kArea_m2 = 0.01, kLength_m = 8.0;

/// A cantilever of 16 beams along X with a parameter for its modulus; `held` false leaves it without support.
fe::Model plain_cantilever(bool held = true) {
  fe::Model model;
  model.source = "cantilever";
  model.formulation.shear_flexible = false;
  model.materials.push_back({"steel", kModulus_Pa, kModulus_Pa / 2.6, 0.3, kDensity_kg_m3});
  fe::Section section;
  section.name = "bar";
  section.area_m2 = kArea_m2;
  section.inertia_y_m4 = kInertia_m4;
  section.inertia_z_m4 = 4.0 * kInertia_m4;
  section.torsion_m4 = kInertia_m4;
  model.sections.push_back(section);
  for (int i = 0; i <= 16; ++i) model.nodes.push_back({i + 1, {kLength_m / 16 * i, 0.0, 0.0}});
  for (int i = 0; i < 16; ++i) {
    fe::Element element;
    element.id = i + 1;
    element.type = fe::ElementType::beam;
    element.group = "deck";
    element.material = element.section = 0;
    element.nodes = {i, i + 1};
    model.elements.push_back(element);
  }
  if (held) model.supports.push_back({"wall", 0, {true, true, true, true, true, true}});
  model.parameters.push_back({"E", fe::Target::youngs_modulus, {"steel"}, "Pa", kModulus_Pa, 1e11, 4e11});
  model.prestress.rule = fe::PullRule::none;
  return model;
}

// First root of Euler's cantilever: beta L = 1.8751041, f = beta² sqrt(EI / rho A) / 2 pi. Sixteen beams: error below 1e-5.
double cantilever_Hz(double modulus_Pa) {
  return std::pow(1.8751041 / kLength_m, 2) * std::sqrt(modulus_Pa * kInertia_m4 / (kDensity_kg_m3 * kArea_m2)) /
         (2.0 * std::numbers::pi);
}

TEST(LoadedModel, OfACantileverHasItsFrequency) {
  const LoadedModel loaded = from_model(plain_cantilever());
  EXPECT_EQ(loaded.source, "cantilever");
  ASSERT_NE(loaded.fe_model(), nullptr);
  EXPECT_EQ(loaded.fe_model(), &loaded.structure->model());
  EXPECT_EQ(loaded.theta, Eigen::VectorXd::Constant(1, kModulus_Pa));
  EXPECT_NEAR(available_modes(loaded.system, loaded.theta, 1).frequency_Hz(0) / cantilever_Hz(kModulus_Pa), 1.0, 1e-4);
}

TEST(LoadedModel, WithValuesChangesTheModelAndLeavesTheFirst) {
  const LoadedModel loaded = from_model(plain_cantilever());
  const LoadedModel stiffer = with_values(loaded, Eigen::VectorXd::Constant(1, 1.44 * kModulus_Pa));
  const double before = available_modes(loaded.system, loaded.theta, 1).frequency_Hz(0);
  EXPECT_NEAR(available_modes(stiffer.system, stiffer.theta, 1).frequency_Hz(0) / before, 1.2, 1e-9);  // sqrt(E)
  EXPECT_EQ(loaded.theta(0), kModulus_Pa);
}

/// The cantilever with a stay from its tip straight up, whose pull holds the tip where it is, and a parameter for the density.
fe::Model propped_cantilever(double density_kg_m3) {
  fe::Model model = plain_cantilever();
  model.gravity_m_s2 = 10.0;
  model.materials[0].density_kg_m3 = density_kg_m3;
  model.materials.push_back({"weightless", 165e9, 65e9, 0.3, 0.0});
  model.nodes.push_back({18, {kLength_m, 0.0, 10.0}});
  fe::Element stay;
  stay.id = 17;
  stay.type = fe::ElementType::stay;
  stay.group = "stays";
  stay.name = "S1";
  stay.material = 1;
  stay.section = 0;
  stay.nodes = {16, 17};
  model.elements.push_back(stay);
  model.supports.push_back({"top", 17, {true, true, true, true, true, true}});
  model.prestress.rule = fe::PullRule::shape_finding;
  model.prestress.minimum_pull_N = 1.0;
  model.prestress.ridge = 1e-14;
  model.prestress.conditions = {{16, 2}};
  model.parameters = {{"rho", fe::Target::density, {"steel"}, "kg/m3", density_kg_m3, 1e3, 1e5}};
  return model;
}

// The tip does not move, so the stay pulls 3/8 of the weight: 3/8 · 800 N/m · 8 m at 8000 kg/m3, twice that at 16000. What the
// new values give is what a model with these values from its start gives, geometric stiffness and all.
TEST(LoadedModel, WithValuesFindsThePrestressAnew) {
  const LoadedModel light = from_model(propped_cantilever(8000.0)), heavy = from_model(propped_cantilever(16000.0));
  EXPECT_NEAR(light.state.stay_pull_N(16), 2400.0, 1e-3);
  const LoadedModel changed = with_values(light, heavy.theta);
  EXPECT_NEAR(changed.state.stay_pull_N(16), 4800.0, 2e-3);
  const Eigen::VectorXd expected = available_modes(heavy.system, heavy.theta, 4).frequency_Hz;
  EXPECT_LT((available_modes(changed.system, changed.theta, 4).frequency_Hz - expected).norm(), 1e-9 * expected.norm());
  // With the pull of the first values the sway would be slower.
  EXPECT_GT((available_modes(light.system, heavy.theta, 4).frequency_Hz - expected).norm(), 1e-6 * expected.norm());
}

TEST(LoadedModel, RefusesAMechanism) {
  EXPECT_NO_THROW((void)valid_model(plain_cantilever(false)));  // it is valid, but has no prestress
  EXPECT_THROW((void)from_model(plain_cantilever(false)), InputError);
  EXPECT_THROW((void)solvable(valid_model(plain_cantilever(false))), InputError);
}

TEST(ReadModel, RefusesAnInvalidModel) {
  fe::Model model = plain_cantilever();
  model.materials[0].youngs_modulus_Pa = -1.0;
  EXPECT_THROW((void)valid_model(std::move(model)), InputError);
}

TEST(ReadModel, TellsParametersOfEitherKind) {
  const ReadModel read = valid_model(plain_cantilever());
  ASSERT_EQ(read.parameters().size(), 1U);
  EXPECT_EQ(read.parameters()[0].name, "E");
  ReadModel matrices;
  matrices.matrices = tests::SpringChain{.n = 5}.system();
  EXPECT_EQ(matrices.parameters().size(), 3U);
  EXPECT_EQ(matrices.fe_model(), nullptr);
}

// A matrix model comes through as it is, and takes new values alone: f goes with sqrt(k).
TEST(LoadedModel, OfMatricesHasTheFrequenciesOfTheChain) {
  const tests::SpringChain chain{.n = 5};
  ReadModel read;
  read.matrices = chain.system();
  read.source = "springs";
  const LoadedModel loaded = solvable(with_displacements(read, "large", 10));
  EXPECT_EQ(loaded.fe_model(), nullptr);
  EXPECT_EQ(loaded.source, "springs");
  EXPECT_NEAR(available_modes(loaded.system, loaded.theta, 1).frequency_Hz(0), chain.frequency_Hz(1), 1e-12);
  Eigen::VectorXd theta = loaded.theta;
  theta(0) *= 4.0;
  const LoadedModel changed = with_values(loaded, theta);
  EXPECT_NEAR(available_modes(changed.system, changed.theta, 1).frequency_Hz(0), 2.0 * chain.frequency_Hz(1), 1e-12);
}

TEST(AvailableModes, AreNoMoreThanThereAre) {
  const auto system = tests::SpringChain{.n = 5}.system();
  EXPECT_EQ(available_modes(system, system.initial(), 9).frequency_Hz.size(), 5);
  EXPECT_EQ(available_modes(system, system.initial(), 3).frequency_Hz.size(), 3);
}

TEST(WithDisplacements, SetsWhatIsAskedFor) {
  const ReadModel read = valid_model(plain_cantilever());
  EXPECT_EQ(with_displacements(read, "as_model", 7).structure, read.structure);
  const ReadModel large = with_displacements(read, "large", 7);
  EXPECT_EQ(large.fe_model()->prestress.displacements, fe::Displacements::large);
  EXPECT_EQ(large.fe_model()->prestress.load_steps, 7);
  EXPECT_EQ(with_displacements(large, "linear", 3).fe_model()->prestress.displacements, fe::Displacements::linear);
  EXPECT_EQ(read.fe_model()->prestress.displacements, fe::Prestress{}.displacements);  // the first stays
}

TEST(LoadedModel, ModesReachTheMeasuredBand) {
  const tests::SpringChain chain;
  const fe::ParametricSystem system = chain.system();
  const auto count = [&](int asked, double highest_Hz) {
    return modes_for_band(system, system.initial(), asked, Eigen::Vector2d(chain.frequency_Hz(1), highest_Hz), 0.1);
  };
  EXPECT_EQ(count(3, 0.9 * chain.frequency_Hz(3)), 3) << "the last of them lies above all that is measured";
  EXPECT_EQ(count(3, chain.frequency_Hz(6) / 1.05), 6) << "those within a tenth above";
  EXPECT_EQ(count(3, 2.0 * chain.frequency_Hz(10)), 10) << "as many as there are";
  EXPECT_EQ(count(3, 1000.0 * chain.frequency_Hz(1)), 3) << "far off the others: a slip of units";
  EXPECT_EQ(modes_for_band(system, system.initial(), 3, {}, 0.1), 3);
}

}  // namespace
}  // namespace twindeck::dynamics
