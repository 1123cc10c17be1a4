#include "matching/solved_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "unit/fe/assembly_models.hpp"
#include "unit/matching/measured_modes.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using tests::SpringChain;

/// Two chains of five masses; the factors scale the springs of the first and of the second.
SolvedModel two_chains(double m, double first, double second, int n_modes) {
  const SpringChain chain{.n = 5, .copies = 2};
  return solve_modes(matrix_model(chain.system(), {chain.k, m, first, second}), n_modes);
}

// Oracle: Phi' M Phi = 1, and closed forms of the frequencies. 1e-9: the solver's own tolerance is smaller.
TEST(SolveModes, KeepsTheMassAndItsShapes) {
  const SpringChain chain{.n = 6};
  const SolvedModel solved = solve_modes(matrix_model(chain.system()), 3);
  ASSERT_TRUE(solved.modes.status.converged);
  EXPECT_LT((solved.modes.shapes.transpose() * solved.mass_shapes - MatrixXd::Identity(3, 3)).norm(), 1e-9);
  EXPECT_LT((MatrixXd(solved.mass) - chain.m * MatrixXd::Identity(6, 6)).norm(), 1e-14);
  for (int j = 1; j <= 3; ++j) EXPECT_NEAR(solved.modes.frequency_Hz[j - 1] / chain.frequency_Hz(j), 1.0, 1e-9);
}

// Oracle: the header. A structure gives as many modes as it has, and a prestress that did not converge is not a success.
TEST(SolveModes, TellsWhatWentWrong) {
  const SolvedModel small = solve_modes(matrix_model(SpringChain{.n = 4}.system()), 9);
  EXPECT_TRUE(small.modes.status.converged);
  EXPECT_EQ(small.modes.frequency_Hz.size(), 4);
  dynamics::LoadedModel loaded = matrix_model(SpringChain{.n = 4}.system());
  loaded.state.status = {false, "no equilibrium"};
  const SolvedModel solved = solve_modes(loaded, 2);
  EXPECT_FALSE(solved.modes.status.converged);
  EXPECT_EQ(solved.modes.status.message, "no equilibrium");
}

// Oracle: closed form. Three times the mass leaves the shapes as they are: MAC 1 and f/sqrt(3), whatever the normalisation.
TEST(Follow, IsBlindToTheScaleOfTheMass) {
  const SolvedModel reference = two_chains(2.0, 1.0, 1.3, 6), heavy = two_chains(6.0, 1.0, 1.3, 6);
  const TrackedModes followed = follow(reference, heavy, 4);
  EXPECT_EQ(followed.position, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_LT((followed.mac - Eigen::Vector4d::Ones()).norm(), 1e-9);
  EXPECT_LT((followed.frequency_Hz - reference.modes.frequency_Hz.head(4) / std::sqrt(3.0)).norm(), 1e-8);
}

// Oracle: closed form. The first chain grows stiffer than the second and its modes pass those of the other: f1 sqrt(1.6) and
// f2 sqrt(1.6) come second and fourth. Modes of the second chain keep sqrt(1.3).
TEST(Follow, FindsModesThatPassEachOther) {
  const SpringChain chain{.n = 5, .copies = 2};
  const TrackedModes followed = follow(two_chains(2.0, 1.0, 1.3, 4), two_chains(2.0, 1.6, 1.3, 4), 4);
  EXPECT_EQ(followed.position, (std::vector<int>{1, 0, 3, 2}));
  for (int i = 0; i < 4; ++i) {
    const double factor = i % 2 == 0 ? 1.6 : 1.3;
    EXPECT_NEAR(followed.frequency_Hz[i], std::sqrt(factor) * chain.frequency_Hz(i / 2 + 1), 1e-8) << i;
    EXPECT_NEAR(followed.mac[i], 1.0, 1e-9) << i;
  }
}

// Oracle: hand calculation. Two masses between three springs have the shapes (1, 1) and (1, -1). With a mass of a instead of
// one at the first, the MAC in the reference's mass is the squared cosine of the angle between the vectors.
TEST(Follow, WeighsWithTheMassOfTheReference) {
  fe::ParametricSystem system = SpringChain{.n = 2, .k = 1.0, .m = 1.0}.system();
  fe::ParametricSystem other = system;
  other.mass_terms[0].value = {1.5, 1.0};
  const SolvedModel reference = solve_modes(matrix_model(system), 2), changed = solve_modes(matrix_model(other), 2);
  // K = [2 -1; -1 2], M = diag(1.5, 1): 1.5 L² - 5 L + 3 = 0, shape (1, 2 - 1.5 L).
  for (const int mode : {0, 1}) {
    const double lambda = (5.0 + (mode == 0 ? -1.0 : 1.0) * std::sqrt(7.0)) / 3.0;
    const Eigen::Vector2d shape(1.0, 2.0 - 1.5 * lambda), equal(1.0, mode == 0 ? 1.0 : -1.0);
    const TrackedModes followed = follow(reference, changed, 2);
    EXPECT_NEAR(followed.mac[mode], mac_by_hand(shape, equal), 1e-9);
    EXPECT_NEAR(followed.frequency_Hz[mode], std::sqrt(lambda) / (2.0 * std::numbers::pi), 1e-9);
  }
  // The other way round the weight is diag(1.5, 1).
  const Eigen::Vector2d first(std::sqrt(1.5), 2.0 - 1.5 * (5.0 - std::sqrt(7.0)) / 3.0), equal(std::sqrt(1.5), 1.0);
  EXPECT_NEAR(follow(changed, reference, 2).mac[0], mac_by_hand(first, equal), 1e-9);
}

// Oracle: by construction. A changed model with two modes of the second chain alone leaves those of the first without partner.
TEST(Follow, MarksLostModes) {
  const TrackedModes followed = follow(two_chains(2.0, 1.0, 1.3, 4), two_chains(2.0, 20.0, 1.3, 2), 4);
  EXPECT_EQ(followed.position[1], 0);
  EXPECT_EQ(followed.position[3], 1);
  for (const int lost : {0, 2}) {
    EXPECT_EQ(followed.position[static_cast<std::size_t>(lost)], -1);
    EXPECT_TRUE(std::isnan(followed.frequency_Hz[lost]));
    EXPECT_TRUE(std::isnan(followed.mac[lost]));
  }
}

/// Cantilever of 4 m in beams of equal length. @param width_factor  of the inertia that bends in the vertical plane
SolvedModel solved_cantilever(int elements, double vertical, int n_modes) {
  fe::Model model = fe::test::with_steel();
  model.sections[0].inertia_y_m4 *= vertical;
  for (int i = 0; i <= elements; ++i) fe::test::add_node(model, 4.0 * i / elements, 0.0, 0.0);
  for (int i = 0; i < elements; ++i) fe::test::add_element(model, fe::ElementType::beam, "beam", 0, 0, {i, i + 1});
  fe::test::fix(model, 0);
  return solve_modes(dynamics::from_model(model), n_modes);
}

// Oracle: closed form, (1.8751, 4.6941)² sqrt(E I/(rho A L⁴))/(2 pi) of a cantilever. Iy = 4 Iz: the order of the first four is
// lateral 1, vertical 1, lateral 2, vertical 2. With Iy/40 the vertical ones come first. Two beams of cubic shape are good to
// 1 %, so that shapes at their common nodes have a MAC above 0.999.
TEST(Follow, ComparesMeshesAtTheirCommonNodes) {
  const SolvedModel coarse = solved_cantilever(2, 1.0, 4), fine = solved_cantilever(4, 1.0 / 40.0, 4);
  const TrackedModes followed = follow(coarse, fine, 2);
  const double lateral = std::pow(1.875104, 2) * std::sqrt(200e9 * 1e-5 / (8000.0 * 0.01 * 256.0)) / (2.0 * std::numbers::pi);
  EXPECT_EQ(followed.position, (std::vector<int>{1, 0}));
  EXPECT_NEAR(followed.frequency_Hz[0] / lateral, 1.0, 1e-3);
  EXPECT_NEAR(followed.frequency_Hz[1] / (lateral * std::sqrt(0.1)), 1.0, 1e-3);
  EXPECT_GT(followed.mac.minCoeff(), 0.999);
}

// Oracle: torsion of a straight line of beams moves no node, so that its shapes have no MAC at the nodes of two meshes. The
// third mode is torsion here: sqrt(G J/(rho Ip))/(4 L) = 28 Hz between 11.1 and 34.7 Hz of bending.
TEST(Follow, ComparesNoRounding) {
  const auto slender = [](int elements) {
    fe::Model model = fe::test::with_steel();
    model.sections[0].torsion_m4 = 1e-6;
    for (int i = 0; i <= elements; ++i) fe::test::add_node(model, 4.0 * i / elements, 0.0, 0.0);
    for (int i = 0; i < elements; ++i) fe::test::add_element(model, fe::ElementType::beam, "beam", 0, 0, {i, i + 1});
    fe::test::fix(model, 0);
    return solve_modes(dynamics::from_model(model), 4);
  };
  const TrackedModes followed = follow(slender(2), slender(4), 4);
  EXPECT_EQ(followed.mac[2], 0.0);
  EXPECT_GT(followed.mac[3], 0.999);
}

// Oracle: the header of the comparison: other meshes are compared by coordinates, which matrices do not have, and need common
// nodes.
TEST(Follow, RefusesWhatCannotBeCompared) {
  const SolvedModel four = solve_modes(matrix_model(SpringChain{.n = 4}.system()), 2);
  const SolvedModel five = solve_modes(matrix_model(SpringChain{.n = 5}.system()), 2);
  EXPECT_THROW((void)follow(four, five, 2), InputError);
  SolvedModel beam = solved_cantilever(2, 1.0, 2);
  EXPECT_THROW((void)follow(beam, four, 2), InputError);
  fe::Model away = *solved_cantilever(3, 1.0, 1).loaded.model;
  for (fe::Node& node : away.nodes) node.x_m.y() += 1.0;
  EXPECT_THROW((void)follow(beam, solve_modes(dynamics::from_model(away), 2), 2), InputError);
}

}  // namespace
}  // namespace twindeck::matching
