// One search of an update. Oracles: springs of two masses whose frequencies are known in closed form; a prestress that follows
// a parameter, whose fixed point is solved by hand; full and reduced search against each other.
#include "updating/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measured_chain.hpp"

namespace twindeck::updating {
namespace {

using Eigen::VectorXd;

double hertz(double omega_squared) { return std::sqrt(omega_squared) / (2.0 * std::numbers::pi); }

/// Two masses of 1 kg between walls: outer springs 400 a, the one between 100 c [N/m], and `held` [N/m] from each mass to the
/// ground.  omega² = 400 a + held and 400 a + held + 200 c.
fe::ParametricSystem pair_of_masses(double held = 0.0) {
  SmallSystem small(2);
  const int a = small.parameter("a", 1.0, 0.5, 2.0), c = small.parameter("c", 1.0, 0.5, 2.0);
  small.stiffness(400.0 * (spring(2, 0, -1) + spring(2, 1, -1)), a).stiffness(100.0 * spring(2, 0, 1), c);
  if (held != 0.0) small.stiffness(held * (spring(2, 0, -1) + spring(2, 1, -1)));
  return small.mass(Eigen::MatrixXd::Identity(2, 2)).system();
}

/// A search for a and c with the frequencies of given omega².
struct PairSearch {
  Refresh refresh;
  UpdatingOptions options;
  Search search;

  PairSearch(double first, double second, Refresh again = {})
      : refresh(std::move(again)), search{refresh, options, {}, {}, {}, {}} {
    const fe::ParametricSystem start = refresh ? refresh(VectorXd::Ones(2)) : pair_of_masses();
    search.initial_system = std::make_shared<const fe::ParametricSystem>(start);
    ResidualDefinition& definition = search.definition;
    definition.targets = {{"1", 0, hertz(first)}, {"2", 1, hertz(second)}};
    definition.active = {0, 1};
    definition.initial = Eigen::Vector2d::Ones();
    definition.scale = Eigen::Vector2d::Ones();
    definition.n_modes = 2;
    dynamics::ModalSolver solver(*search.initial_system);
    const dynamics::EigenModes reference = solver.solve(definition.initial, 2);
    definition.follower = std::make_shared<const matching::ModeFollower>(solver.mass(), reference);
    search.box = {Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(2.0, 2.0)};
  }
  PairSearch(const PairSearch&) = delete;
  PairSearch& operator=(const PairSearch&) = delete;
  ~PairSearch() = default;
};

// a = 480 / 400 and c = (720 - 480) / 200.
TEST(RunStart, FindsTheSpringsOfTwoFrequencies) {
  const PairSearch pair(480.0, 720.0);
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(1.0, 1.0), 3);
  ASSERT_TRUE(end.result.converged) << end.result.message;
  EXPECT_LT((end.result.theta - Eigen::Vector2d(1.2, 1.2)).norm(), 1e-6);
  EXPECT_LT(end.result.cost, 1e-12);
  EXPECT_EQ(end.result.outer, 1);
  EXPECT_EQ(end.end.x, end.result.theta);  // scale 1
  EXPECT_EQ(end.result.initial, VectorXd(Eigen::Vector2d(1.0, 1.0)));
  ASSERT_FALSE(end.history.empty());
  for (std::size_t i = 0; i < end.history.size(); ++i) {
    EXPECT_EQ(end.history[i].start, 3);
    if (i > 0) {
      EXPECT_LE(end.history[i].cost, end.history[i - 1].cost);
    }
  }
}

// omega² of mode 1 asks for a = 0.25, below its bound 0.5; c then makes up for mode 2 alone: 200 + 200 c = 500, c = 1.5.
TEST(RunStart, EndsOnABoundWhereTheSpringIsBeyondIt) {
  const PairSearch pair(100.0, 500.0);
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(1.0, 1.0), 0);
  ASSERT_TRUE(end.result.converged) << end.result.message;
  EXPECT_DOUBLE_EQ(end.result.theta(0), 0.5);
  EXPECT_NEAR(end.result.theta(1), 1.5, 1e-6);
  EXPECT_NEAR(end.result.cost, 0.5 * std::pow(std::sqrt(2.0) - 1.0, 2), 1e-9);  // f_N / f_X = sqrt(200 / 100)
}

// A start outside the box begins on its edge.
TEST(RunStart, BeginsInsideTheBox) {
  const PairSearch pair(480.0, 720.0);
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(9.0, 0.1), 0);
  ASSERT_FALSE(end.history.empty());
  EXPECT_EQ(end.history.front().theta, VectorXd(Eigen::Vector2d(2.0, 0.5)));
  EXPECT_LT((end.result.theta - Eigen::Vector2d(1.2, 1.2)).norm(), 1e-6);
}

/// A prestress that holds each mass with 80 N/m times a.
fe::ParametricSystem held_by_prestress(const VectorXd& theta) { return pair_of_masses(80.0 * theta(0)); }

// Fixed point of the prestress: 400 a + 80 a = omega1², so a = 1.1 for omega1² = 528; c = (748 - 528) / 200.
TEST(RunStart, FollowsThePrestress) {
  PairSearch pair(528.0, 748.0, held_by_prestress);
  pair.search.definition.scale = Eigen::Vector2d(2.0, 0.5);  // the prestress is that of the parameters, not of x
  pair.search.box = {Eigen::Vector2d(0.25, 1.0), Eigen::Vector2d(1.0, 4.0)};
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(0.8, 1.4), 0);
  ASSERT_TRUE(end.result.converged) << end.result.message;
  EXPECT_LT((end.result.theta - Eigen::Vector2d(1.1, 1.1)).norm(), 1e-6);
  EXPECT_GT(end.result.outer, 2);  // the error falls by 80 / 400 a state
  const Evaluation there = evaluate_in_balance(pair.search, Eigen::Vector2d(0.55, 2.2));
  EXPECT_LT(there.residual.norm(), 1e-12);
}

TEST(RunStart, SaysThatThePrestressDoesNotSettle) {
  PairSearch pair(528.0, 748.0, held_by_prestress);
  pair.options.outer_iterations = 2;
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(1.6, 0.7), 0);
  EXPECT_FALSE(end.result.converged);
  EXPECT_EQ(end.result.outer, 2);
  EXPECT_NE(end.result.message.find("still change"), std::string::npos) << end.result.message;
}

// The reduced system has the whole space here, so that the search on it ends at the same springs.
TEST(RunStart, EndsAtTheSameSpringsOnTheReducedSystem) {
  PairSearch pair(528.0, 748.0, held_by_prestress);
  pair.search.surrogate = make_surrogate(pair.search, Eigen::MatrixXd::Ones(2, 1));
  ASSERT_TRUE(pair.search.surrogate.basis);
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(1.6, 0.7), 0);
  ASSERT_TRUE(end.result.converged) << end.result.message;
  EXPECT_LT((end.result.theta - Eigen::Vector2d(1.1, 1.1)).norm(), 1e-5);  // tolerance of the projected gradient, 1e-6
  EXPECT_EQ(end.result.message, "projected gradient below its tolerance");
}

// With no step allowed nothing converges, and the search says so.
TEST(RunStart, SaysThatItRanOutOfSteps) {
  PairSearch pair(480.0, 720.0);
  pair.options.max_iterations = 1;
  pair.options.trust_radius = 1e-3;
  const SearchEnd end = run_start(pair.search, Eigen::Vector2d(1.9, 0.6), 0);
  EXPECT_FALSE(end.result.converged);
  EXPECT_FALSE(end.result.message.empty());
}

// At a = 1.5 the prestress is 120 N/m; the one of the initial values stays at 80 N/m. omega1² = 600 + either.
TEST(Evaluate, InBalanceAndAtTheStartDifferByThePrestress) {
  const PairSearch pair(528.0, 748.0, held_by_prestress);
  const Eigen::Vector2d x(1.5, 1.0);
  EXPECT_NEAR(evaluate_in_balance(pair.search, x).frequency_Hz(0), hertz(720.0), 1e-10);
  const Evaluation start = evaluate_at_start(pair.search, x);
  EXPECT_NEAR(start.frequency_Hz(0), hertz(680.0), 1e-10);
  // At frozen prestress domega1²/da = 400.
  EXPECT_NEAR(start.jacobian(0, 0), 0.5 * 400.0 / 680.0 * std::sqrt(680.0 / 528.0), 1e-10);
}

// The smooth map never reaches a bound, but comes as near to the same optimum as its tolerance lets it.
TEST(SmoothCheck, MeetsTheSearchInsideTheBoundsAndFromTheReducedSystem) {
  for (const bool reduced : {false, true}) {
    PairSearch pair(480.0, 720.0);
    if (reduced) pair.search.surrogate = make_surrogate(pair.search, Eigen::MatrixXd::Ones(2, 1));
    const SearchEnd end = run_start(pair.search, Eigen::Vector2d(0.8, 1.6), 0);
    const SmoothCheck check = check_by_smooth_map(pair.search, end);
    ASSERT_EQ(check.theta.size(), 2);
    EXPECT_LT((check.theta - Eigen::Vector2d(1.2, 1.2)).norm(), 1e-4) << reduced;
    // Of the range of 1.5.
    EXPECT_NEAR(check.largest_difference, (check.theta - end.result.theta).cwiseAbs().maxCoeff() / 1.5, 1e-12);
  }
}

}  // namespace
}  // namespace twindeck::updating
