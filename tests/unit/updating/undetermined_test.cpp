// Oracles: chains whose frequencies are known not to depend on a parameter, or on one combination of them only.
#include <gtest/gtest.h>

#include "measured_chain.hpp"
#include "updating/weighing_words.hpp"

namespace twindeck::updating {
namespace {

struct Case {
  dynamics::LoadedModel model;
  std::vector<int> active;
  matching::Measured measured;
  Case(const SmallSystem& small, const Eigen::VectorXd& truth, Eigen::Index pairs)
      : model(loaded(small)), measured(measured_frequencies(dense_frequencies(small.system(), truth).head(pairs), 0.01)) {
    for (int j = 0; j < truth.size(); ++j) active.push_back(j);
  }
  [[nodiscard]] UpdatingResult updated(std::uint64_t seed, double std_Hz = 0.0) const {
    std::vector<FrequencyTarget> targets;
    for (Eigen::Index i = 0; i < measured.modes.frequency_Hz.size(); ++i)
      targets.push_back({std::to_string(i + 1), static_cast<int>(i), measured.modes.frequency_Hz(i)});
    UpdatingOptions options;
    options.seed = seed;
    MeasuredRows rows;
    if (std_Hz > 0.0) rows.covariance = std_Hz * std_Hz * Eigen::MatrixXd::Identity(std::ssize(targets), std::ssize(targets));
    return update(model.system, {}, active, targets, options, {}, rows);
  }
  [[nodiscard]] std::vector<std::string> warned(const UpdatingResult& result) const {
    HeardReporter heard;
    warn_of_undetermined(heard, {model, active, measured, {}, {}, result});
    return heard.warned;
  }
};

// Springs k and k2 of one mass in two directions, and a spring between grounds that holds nothing.
SmallSystem with_a_dead_spring() {
  SmallSystem small(2);
  const int k = small.parameter("k", 1.0, 0.2, 5.0), dead = small.parameter("dead", 1.0, 0.5, 2.0);
  small.stiffness(100.0 * spring(2, 0, -1) + 150.0 * spring(2, 1, 0), k).stiffness(Eigen::MatrixXd::Zero(2, 2), dead);
  return small.mass(Eigen::MatrixXd::Identity(2, 2));
}

TEST(Undetermined, AParameterThatNothingDependsOnStaysAndIsNamed) {
  const Case dead(with_a_dead_spring(), Eigen::Vector2d(0.6, 1.0), 2);
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double std_Hz : {0.0, 0.01, 1e-4}) {
      const UpdatingResult result = dead.updated(seed, std_Hz);
      ASSERT_TRUE(result.status.converged) << result.status.message;
      EXPECT_NEAR(result.theta(0), 0.6, 1e-6) << seed;
      EXPECT_EQ(result.theta(1), 1.0) << seed;
      const auto warned = dead.warned(result);
      ASSERT_EQ(warned.size(), 1U);
      EXPECT_NE(warned[0].find("do not determine dead"), std::string::npos) << warned[0];
      EXPECT_NE(warned[0].find("initial value 1"), std::string::npos) << warned[0];
    }
  }
}

/// Springs of sizes a and b, masses of one size m.
SmallSystem two_masses_of_one_size() {
  SmallSystem small(2);
  const int a = small.parameter("a", 1.0, 0.1, 5.1), b = small.parameter("b", 1.0, 0.1, 5.1),
            m = small.parameter("m", 1.0, 0.3, 2.3);
  small.stiffness(100.0 * spring(2, 0, -1), a).stiffness(80.0 * spring(2, 1, 0), b);
  return small.mass(Eigen::MatrixXd::Identity(2, 2), m);
}

// Frequencies depend on a/m and b/m alone. Along a multiple of the truth the step in units of the ranges is (0.5/5, 1.1/5,
// 0.8/2) over its length 0.4673; a standard deviation of the ranges is 1/sqrt(12) of them: a by 0.309, b by 0.679, m by 0.494.
TEST(Undetermined, ParametersOfWhichOnlyCombinationsAreKnownAreNamed) {
  const Case valley(two_masses_of_one_size(), Eigen::Vector3d(0.5, 1.1, 0.8), 2);
  for (const double std_Hz : {0.0, 0.01}) {
    const auto warned = valley.warned(valley.updated(1, std_Hz));
    ASSERT_EQ(warned.size(), 1U);
    EXPECT_NE(warned[0].find("moving a by +0.309 and b by +0.679 and m by +0.494 together"), std::string::npos) << warned[0];
    EXPECT_NE(warned[0].find("do not determine a, b, m one by one"), std::string::npos) << warned[0];
  }
}

// One frequency of three parameters: two ways.
TEST(Undetermined, OfSeveralDirectionsTheNamesAreTold) {
  const Case valley(two_masses_of_one_size(), Eigen::Vector3d(0.5, 1.1, 0.8), 1);
  const auto warned = valley.warned(valley.updated(1));
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_NE(warned[0].find("in 2 ways"), std::string::npos) << warned[0];
  EXPECT_NE(warned[0].find("a, b, m"), std::string::npos) << warned[0];
}

TEST(Undetermined, NothingIsSaidWhereTheDataDecide) {
  const Case seen(two_masses(), Eigen::Vector3d(0.8, 1.1, 1.2), 2);
  Case one = seen;
  one.active = {0, 1};
  const UpdatingResult result = one.updated(1);
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_EQ(result.flat.cols(), 0);
  EXPECT_TRUE(one.warned(result).empty());
}

}  // namespace
}  // namespace twindeck::updating
