// Oracles: statics of a rigid beam on a spring hinge and of a cantilever on stays, written out; enumeration of active sets.
#include "fe/prestress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/static_stage.hpp"

namespace twindeck::fe {
namespace {

/// Cantilever of 6 m along X (three nodes) with vertical stays of 3 m at 3 m and 6 m; the stays have no weight.
Model two_stays() {
  Model model = test::with_steel();
  model.materials.push_back({"weightless", 165e9, 65e9, 0.3, 0.0});
  for (int i = 0; i < 3; ++i) test::add_node(model, 3.0 * i, 0.0, 0.0);
  for (int i = 1; i < 3; ++i) test::add_node(model, 3.0 * i, 0.0, 3.0);
  for (int i = 0; i < 2; ++i) test::add_element(model, ElementType::beam, "girder", 0, 0, {i, i + 1});
  for (int i = 1; i < 3; ++i)
    test::add_element(model, ElementType::stay, "stays", 1, 0, {i, i + 2}).name = "S" + std::to_string(i);
  test::fix(model, 0);
  for (const int head : {3, 4}) test::fix(model, head, {true, true, true, false, false, false});
  model.prestress.rule = PullRule::shape_finding;
  model.prestress.minimum_pull_N = 10.0;
  model.prestress.ridge = 1e-14;
  model.prestress.conditions = {{1, 2}, {2, 2}};
  return model;
}

TEST(Prestress, PullsOfTwoStaysAreTheReactionsOfAContinuousBeam) {
  // Zero displacement at the stays makes them the supports of a two-span beam, built in at the left (w = 800 N/m, l = 3 m).
  // Three-moment equations: 2 M0 + M1 = -w l²/4, M0 + 4 M1 = -w l²/2 (M2 = 0) give M0 = -w l²/14, M1 = -3 w l²/28.
  // R1 = w l - 2 M1/l + M0/l = 8/7 w l, R2 = w l/2 + M1/l = 11/28 w l.
  const Model model = two_stays();
  const PrestressState state = find_prestress(model, initial_parameters(model));
  ASSERT_TRUE(state.status.converged);
  EXPECT_NEAR(state.stay_pull_N[2], 8.0 / 7.0 * 2400.0, 1e-3);
  EXPECT_NEAR(state.stay_pull_N[3], 11.0 / 28.0 * 2400.0, 1e-3);
  EXPECT_NEAR(state.displacement[6 + 2], 0.0, 1e-9);
  EXPECT_NEAR(state.displacement[12 + 2], 0.0, 1e-9);
}

// A soft cantilever whose tip a shallow stay draws outwards. The stay's pull of T = w l 3/8 / sin(slope) makes the tip T/l
// stiffer across, many times the beam's own 3 EI/l³, so that each round of shape finding mends a small part of the deflection
// only.
TEST(Prestress, ForcesThatDoNotSettleUnderLargeDisplacementsAreSaid) {
  Model model = two_stays();
  model.sections[0].inertia_y_m4 = 1e-8;
  model.nodes[4].x_m = {16.0, 0.0, 0.5};
  model.elements.erase(model.elements.begin() + 2);
  model.supports.erase(model.supports.begin() + 1);
  model.nodes.erase(model.nodes.begin() + 3);
  model.supports.back().node = 3;
  model.elements.back().nodes = {2, 3};
  model.prestress.conditions = {{2, 2}};
  const Eigen::VectorXd theta = initial_parameters(model);
  EXPECT_TRUE(find_prestress(model, theta).status.converged);
  model.prestress.displacements = Displacements::large;
  const PrestressState state = find_prestress(model, theta);
  EXPECT_FALSE(state.status.converged);
  EXPECT_NE(state.status.message.find("rounds of shape finding"), std::string::npos) << state.status.message;
}

TEST(Prestress, SlackStayIsHeldAtItsLeastPull) {
  Model model = two_stays();
  model.prestress.minimum_pull_N = 1500.0;  // above the 943 N that the tip would want
  const PrestressState state = find_prestress(model, initial_parameters(model));
  EXPECT_NEAR(state.stay_pull_N[3], 1500.0, 1e-6);
  EXPECT_GE(state.stay_pull_N[2], 1500.0 - 1e-9);
}

TEST(Prestress, HeavySiteWeightReturnsTheSitePulls) {
  Model model = two_stays();
  model.elements[2].pull_N = 2000.0;
  model.elements[3].pull_N = 700.0;
  model.prestress.site_weight = 1e12;
  const PrestressState state = find_prestress(model, initial_parameters(model));
  EXPECT_NEAR(state.stay_pull_N[2], 2000.0, 0.1);
  EXPECT_NEAR(state.stay_pull_N[3], 700.0, 0.1);
}

TEST(Prestress, DenserMaterialAsksForMorePull) {
  Model model = two_stays();
  model.parameters.push_back({"rho", Target::density, {"steel"}, "kg/m3", 8000.0, 4000.0, 16000.0});
  const PrestressState state = find_prestress(model, Eigen::VectorXd::Constant(1, 12000.0));
  EXPECT_NEAR(state.stay_pull_N[2], 1.5 * 8.0 / 7.0 * 2400.0, 1e-3);
}

TEST(Prestress, GivenPullsBalanceByAxialForce) {
  // A stay at 3-4-5 with a pull of 1000 N pushes the cantilever with 600 N over both of its beams.
  Model model = two_stays();
  model.elements.pop_back();
  model.elements[2].nodes = {2, 3};
  model.nodes[3].x_m = Eigen::Vector3d(3.0, 0.0, 4.0);
  model.elements[2].pull_N = 1000.0;
  model.prestress.rule = PullRule::given;
  const PrestressState state = find_prestress(model, initial_parameters(model));
  EXPECT_DOUBLE_EQ(state.stay_pull_N[2], 1000.0);
  EXPECT_NEAR(state.axial_force_N[0], -600.0, 1e-6);
  EXPECT_NEAR(state.axial_force_N[1], -600.0, 1e-6);
  // u_z of the tip: w L⁴/8EI down, 800 N L³/3EI up.
  EXPECT_NEAR(state.displacement[12 + 2], (-800.0 * 1296.0 / 8.0 + 800.0 * 216.0 / 3.0) / 8e6, 1e-9);
}

TEST(Prestress, RuleNoneLeavesEverythingUnstressed) {
  Model model = two_stays();
  model.prestress.rule = PullRule::none;
  const PrestressState state = find_prestress(model, initial_parameters(model));
  EXPECT_EQ(state.stay_pull_N.norm() + state.axial_force_N.norm() + state.displacement.norm(), 0.0);
}

TEST(Prestress, StructureThatOnlyStaysHoldUpIsRefused) {
  Model model = two_stays();
  model.supports.front().fixed = {true, true, true, true, false, true};  // a hinge about y at the wall
  try {
    static_cast<void>(find_prestress(model, initial_parameters(model)));
    FAIL() << "a mechanism was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("without its stays is a mechanism"), std::string::npos) << error.what();
  }
}

TEST(DeadLoad, IsConsistentAlongABeam) {
  const Eigen::VectorXd load = dead_load(test::cantilever());  // w = 800 N/m over 2 + 2 m
  EXPECT_NEAR(load[2], -800.0, 1e-9);
  EXPECT_NEAR(load[8], -1600.0, 1e-9);
  EXPECT_NEAR(load[4], 800.0 * 4.0 / 12.0, 1e-9);  // w L²/12, about y: a load downwards tips the near end by +ry
  EXPECT_NEAR(load[10], 0.0, 1e-9);
  EXPECT_NEAR(load[16], -800.0 * 4.0 / 12.0, 1e-9);
}

TEST(BoundedLeastSquares, EqualsTheBestOfAllActiveSets) {
  std::srand(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(9, 5);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(9);
    const double lower = 0.05;
    double best = std::numeric_limits<double>::infinity();
    for (int set = 0; set < 32; ++set) {  // every choice of unknowns on the bound; admissible ones are candidates
      std::vector<Eigen::Index> off;
      for (int i = 0; i < 5; ++i)
        if ((set >> i) & 1) off.push_back(i);
      Eigen::VectorXd x = Eigen::VectorXd::Constant(5, lower);
      if (!off.empty()) {
        const Eigen::MatrixXd part = a(Eigen::indexing::all, off);
        const Eigen::VectorXd z = part.colPivHouseholderQr().solve(b - a * x);
        for (std::size_t i = 0; i < off.size(); ++i) x[off[i]] += z[static_cast<Eigen::Index>(i)];
      }
      if (x.minCoeff() >= lower - 1e-12) best = std::min(best, (a * x - b).squaredNorm());
    }
    const BoundedLeastSquares found = solve_bounded_least_squares(a, b, lower);
    EXPECT_TRUE(found.status.converged);
    EXPECT_GE(found.x.minCoeff(), lower - 1e-12);
    EXPECT_NEAR((a * found.x - b).squaredNorm(), best, 1e-10);
  }
}

// Oracle: a condition that the dead load does not move (sideways here) says nothing about pulls: a status, and no nan.
TEST(Prestress, ConditionsThatDeadLoadDoesNotMoveDoNotConverge) {
  Model model = two_stays();
  model.prestress.conditions = {{1, 1}, {2, 1}};
  const PrestressState state = find_prestress(model, initial_parameters(model));
  EXPECT_FALSE(state.status.converged);
  EXPECT_TRUE(state.stay_pull_N.allFinite());
}

}  // namespace
}  // namespace twindeck::fe
