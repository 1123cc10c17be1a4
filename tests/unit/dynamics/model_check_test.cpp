// Matrices that cannot belong to a structure. Oracles: signs of diagonal matrices and of a chain of springs, known by hand; the
// number of modes of such a chain.
#include "dynamics/model_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"
#include "spring_chain.hpp"

namespace twindeck::dynamics {
namespace {

using tests::SpringChain;

LoadedModel chain_as_loaded(fe::ParametricSystem system) {
  LoadedModel out;
  out.theta = system.initial();
  out.system = std::move(system);
  out.source = "springs";
  return out;
}

/// A matrix model of three masses with one more stiffness and one more mass at dof 1.
LoadedModel three_masses(double more_stiffness, double more_mass) {
  fe::ParametricSystem system = SpringChain{.n = 3}.system();
  fe::Term stiffness, mass;
  stiffness.position = mass.position = {system.pattern.outerIndexPtr()[1]};
  stiffness.value = {more_stiffness};
  mass.value = {more_mass};
  system.stiffness_terms.push_back(stiffness);
  system.mass_terms.push_back(mass);
  return chain_as_loaded(std::move(system));
}

std::string refusal(LoadedModel model) {
  try {
    (void)with_sound_matrices(std::move(model));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WithSoundMatrices, AcceptsAChainAndLeavesItAsItIs) {
  const LoadedModel given = three_masses(10.0, 1.0), checked = with_sound_matrices(given);
  EXPECT_EQ(checked.source, "springs");
  EXPECT_EQ(checked.theta, given.theta);
  EXPECT_EQ(Eigen::MatrixXd(checked.system.stiffness(checked.theta)), Eigen::MatrixXd(given.system.stiffness(given.theta)));
}

// k = 100 N/m, so K at dof 1 is 200; the dof's own stiffness between its neighbours is 200 - 100²/200 - 100²/200 = 100 N/m.
TEST(WithSoundMatrices, RefusesANegativeStiffness) {
  EXPECT_EQ(refusal(three_masses(-99.0, 0.0)), "");
  const std::string said = refusal(three_masses(-101.0, 0.0));
  EXPECT_NE(said.find("springs"), std::string::npos) << said;
  EXPECT_NE(said.find("stiffness"), std::string::npos) << said;
}

// m = 2 kg.
TEST(WithSoundMatrices, RefusesANegativeMass) {
  EXPECT_EQ(refusal(three_masses(0.0, -1.9)), "");
  EXPECT_NE(refusal(three_masses(0.0, -2.1)).find("mass"), std::string::npos);
}

TEST(WithSoundMatrices, RefusesNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, 1e60}) {
    EXPECT_NE(refusal(three_masses(bad, 0.0)), "") << bad;
    EXPECT_NE(refusal(three_masses(0.0, bad)), "") << bad;
  }
}

TEST(WithSoundMatrices, RefusesAStructureWithoutMass) {
  fe::ParametricSystem system = SpringChain{.n = 3}.system();
  system.mass_terms.clear();
  EXPECT_NE(refusal(chain_as_loaded(std::move(system))).find("mass"), std::string::npos);
}

/// A chain that is free: without the springs to the walls, K (1, 1, …) = 0.
fe::ParametricSystem free_chain() {
  fe::ParametricSystem system = SpringChain{.n = 4}.system();
  SpringChain::add_ground_spring(system, 0, -100.0);
  SpringChain::add_ground_spring(system, 3, -100.0);
  return system;
}

// A motion without stiffness is allowed where mass holds it, and refused where nothing does.
TEST(WithSoundMatrices, AcceptsAFreeStructureButNoLooseDof) {
  EXPECT_EQ(refusal(chain_as_loaded(free_chain())), "");
  fe::ParametricSystem loose = SpringChain{.n = 2}.system();
  loose.stiffness_terms.clear();
  loose.mass_terms.clear();
  fe::Term only;  // dof 0 has a spring and a mass, dof 1 neither
  only.position = {loose.pattern.outerIndexPtr()[0]};
  only.value = {3.0};
  loose.stiffness_terms.push_back(only);
  loose.mass_terms.push_back(only);
  EXPECT_NE(refusal(chain_as_loaded(std::move(loose))), "");
}

// A state that was not found is for the step to report.
TEST(WithSoundMatrices, LeavesAModelWithoutAStateAlone) {
  LoadedModel model = three_masses(-1000.0, 0.0);
  model.state.status = {false, "no equilibrium"};
  EXPECT_EQ(refusal(std::move(model)), "");
}

TEST(RefuseMoreModes, ThanTheStructureHas) {
  const LoadedModel three = three_masses(0.0, 0.0);
  const EigenModes all = available_modes(three.system, three.theta, 5);
  ASSERT_EQ(all.frequency_Hz.size(), 3);
  EXPECT_NO_THROW(refuse_more_modes_than_there_are(3, three, all));
  try {
    refuse_more_modes_than_there_are(5, three, all);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("3 degrees of freedom"), std::string::npos) << said;
    EXPECT_NE(said.find("--set n_modes=3"), std::string::npos) << said;
  }
}

// Two of three dofs have mass, so there are two modes though three dofs.
TEST(RefuseMoreModes, ThanDofsWithMass) {
  const LoadedModel two = three_masses(0.0, -2.0);
  const EigenModes all = available_modes(two.system, two.theta, 3);
  ASSERT_EQ(all.frequency_Hz.size(), 2);
  try {
    refuse_more_modes_than_there_are(3, two, all);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("only 2 modes have mass"), std::string::npos) << error.what();
  }
  EigenModes none;
  none.status = {false, "no modes"};
  EXPECT_NO_THROW(refuse_more_modes_than_there_are(3, two, none));  // that failure is told elsewhere
}

}  // namespace
}  // namespace twindeck::dynamics
