// Places and the reduced model. Oracles: parts add up to the whole; a reduced structure that is not reduced has the full one's
// modes; the bridge's changed frequencies by a full solve.
#include <gtest/gtest.h>
#include <malloc.h>

#include <numeric>

#include "chain.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/static_vectors.hpp"
#include "dynamics/eigenmodes.hpp"
#include "ponte/generator.hpp"
#include "test_places.hpp"

namespace twindeck::tests {
namespace {

TEST(Places, OfAMatrixModelAreItsGroupsAndNodes) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto& sets = chain.places().sets;
  EXPECT_EQ(sets.at("groups").size(), 7u);
  EXPECT_EQ(sets.at("nodes").size(), 6u);
  EXPECT_EQ(sets.at("groups")[2].id, "group:g2");
  EXPECT_DOUBLE_EQ(chain.places().total_mass_kg, 6.0 * Chain::kMass);
  // The groups are all there is of the stiffness, the nodes all there is of the mass.
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6), m = k;
  for (const auto& place : sets.at("groups")) k += Eigen::MatrixXd(place.stiffness.whole());
  for (const auto& place : sets.at("nodes")) m += Eigen::MatrixXd(place.mass.whole());
  EXPECT_LT((k - chain.stiffness(chain.as_modelled())).norm(), 1e-6);
  EXPECT_LT((m - Chain::kMass * Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-9);
}

TEST(Places, NearestIsTheNearest) {
  const std::vector<Eigen::Vector3d> centres = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  EXPECT_EQ(diagnosis::nearest(centres, {7, 1, 0}), 1);
  EXPECT_EQ(diagnosis::nearest(centres, {1, 8, 3}), 2);
}

TEST(ReducedModel, DriveStiffnessIsThatOfAUnitForce) {
  // Oracle: two springs in series on either side of a mass in a chain of n: k (1/(i+1) + 1/(n-i)).
  const Chain chain({.masses = 6, .modes = 4});
  const auto& nodes = chain.reduced().sets.at("nodes");
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(
        nodes[static_cast<std::size_t>(i)].attributes.at("k_drive") / (Chain::kSpring * (1.0 / (i + 1) + 1.0 / (6 - i))), 1.0,
        1e-9);
}

TEST(ReducedModel, HoldsNoMatrixOfDofsTimesPlaces) {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // A chain has a place a mass. Twice the masses must take about twice the memory; if all vectors of places were kept, they
  // would take four times as much.
  const auto held = [] {
    const struct mallinfo2 now = mallinfo2();
    return static_cast<double>(now.uordblks) + static_cast<double>(now.hblkhd);
  };
  const auto bytes = [&](int masses) {
    const Chain chain({.masses = masses, .channels = {0, 1, 2}, .modes = 4});
    const double before = held();
    const diagnosis::ReducedModel reduced(chain.structure(), chain.places(), {.modes = 8, .parameter_vectors = 2});
    EXPECT_GT(reduced.size(), masses);
    return held() - before;
  };
  const double few = bytes(600), many = bytes(1200);
  EXPECT_LT(many, 2.6 * few) << few << " bytes for 600 masses, " << many << " for 1200";
  RecordProperty("growth", std::to_string(many / few));
#endif
}

TEST(StaticVectors, OfAPlaceComeAgainFromItsForces) {
  const Chain chain({.masses = 80, .channels = {0, 40}, .modes = 4});
  dynamics::ModalSolver solver(*chain.structure().system);
  diagnosis::StaticVectors statics;
  statics.factorize(chain.structure());
  statics.make_common(chain.structure(), chain.places(), solver.solve(chain.structure().theta, 8), {.parameter_vectors = 2});
  for (const char* set : {"groups", "nodes"})
    for (const auto& place : chain.places().sets.at(set)) {
      const Eigen::MatrixXd own = statics.own_vectors(place, 3), again = statics.recipe(place, 3)();
      ASSERT_EQ(again.cols(), own.cols()) << place.id;
      EXPECT_LT((again - own).norm(), 1e-9 * own.norm()) << place.id;
    }
}

TEST(ReducedModel, OfTheBridgeHasTheFullModelsModesAndFollowsAChange) {
  // The refined bridge on a coarse mesh: a place's changed frequencies in the reduced basis against a full solve, within 0.1 %.
  const fe::Model model = ponte::generate(std::string(TWINDECK_SOURCE_DIR) + "/data/ponte_del_mare/bridge.toml", "refined");
  matching::Channel channel;
  channel.name = channel.point = "M3";
  channel.x_m = model.nodes[static_cast<std::size_t>(model.monitoring_points.at("M3"))].x_m;
  channel.direction = Eigen::Vector3d::UnitZ();
  const auto prepared = diagnosis::prepare_model(dynamics::from_model(model), {channel}, 0.6);
  const auto structure = prepared->structure();
  const auto places = diagnosis::find_places(
      structure, {.max_zones = 8, .max_nodes = 4, .moves = {}, .zone_centres = {}, .node_positions = {}});
  diagnosis::ReductionOptions options;
  options.modes = 24;
  const diagnosis::ReducedModel reduced(structure, places, options);
  const auto solve = [&](double factor, const diagnosis::ReducedMatrix& change) {
    // Vectors of one place and those that all share: those of other places may hold the same motion once more.
    std::vector<int> columns(static_cast<std::size_t>(reduced.common));
    std::iota(columns.begin(), columns.end(), 0);
    const auto& own = reduced.sets.at("stays")[3].columns;
    columns.insert(columns.end(), own.begin(), own.end());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(std::ssize(columns), std::ssize(columns)), m = k;
    for (const auto& term : reduced.stiffness) k += term.coefficient.value(reduced.theta) * term.matrix.part(columns);
    for (const auto& term : reduced.mass) m += term.coefficient.value(reduced.theta) * term.matrix.part(columns);
    if (change.size() > 0) k += factor * change.part(columns);
    // M phi = 1/omega² K phi, for static corrections hardly have a mass.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(m, k, Eigen::EigenvaluesOnly);
    return Eigen::VectorXd(eigen.eigenvalues().tail(8).reverse().cwiseSqrt().cwiseInverse() / (2.0 * std::numbers::pi));
  };
  const Eigen::VectorXd plain = solve(0.0, {});
  for (Eigen::Index i = 0; i < 8; ++i) EXPECT_NEAR(plain[i] / reduced.frequency_Hz[i], 1.0, 1e-5) << i;
  // A stay at half its stiffness, in the full model: an area halved would halve its mass too, so the modulus is halved by a
  // term.
  const auto& stay = places.sets.at("stays")[3];
  const auto& stay_reduced = reduced.sets.at("stays")[3];
  fe::ParametricSystem system = *structure.system;
  fe::Term term;
  term.coefficient.base = -0.5;
  const int* outer = system.pattern.outerIndexPtr();
  const int* inner = system.pattern.innerIndexPtr();
  const diagnosis::Symmetric stay_stiffness = stay.stiffness.whole();
  for (int c = 0; c < stay_stiffness.outerSize(); ++c)
    for (diagnosis::Symmetric::InnerIterator entry(stay_stiffness, c); entry; ++entry) {
      if (entry.row() < entry.col()) continue;
      const int* at = std::lower_bound(inner + outer[c], inner + outer[c + 1], static_cast<int>(entry.row()));
      ASSERT_TRUE(at != inner + outer[c + 1] && *at == entry.row());
      term.position.push_back(static_cast<int>(at - inner));
      term.value.push_back(entry.value());
    }
  system.stiffness_terms.push_back(term);
  dynamics::ModalSolver solver(system);
  const auto full = solver.solve(structure.theta, 8);
  const Eigen::VectorXd changed = solve(-0.5, stay_reduced.stiffness);
  double moved = 0.0;
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_NEAR(changed[i] / full.frequency_Hz[i], 1.0, 1e-3) << i;
    moved = std::max(moved, std::abs(changed[i] / plain[i] - 1.0));
  }
  EXPECT_GT(moved, 2e-3);  // a change that could have been missed
}

}  // namespace
}  // namespace twindeck::tests
