// Oracle: differences in standard deviations worked by hand, for one frequency and a shape at two channels.
#include "updating/weighing_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measured_chain.hpp"

namespace twindeck::updating {
namespace {

/// An update of the two masses whose numbers are set by hand: one frequency of 4 Hz and a shape (1, 2).
struct ByHand {
  dynamics::LoadedModel model = loaded(two_masses());
  std::vector<int> active = {0, 2};
  matching::Measured measured = measured_modes(Eigen::VectorXd::Constant(1, 4.0), 0.1, Eigen::Vector2d(1.0, 2.0), 0.5);
  matching::Pairing pairing;
  MeasuredRows rows;
  UpdatingResult result;
  Posterior posterior;
  ByHand() {
    pairing.pairs = {{0, 0, 1.0, false}};
    rows.covariance = Eigen::Vector3d(0.01, 0.25, 0.25).asDiagonal();
    rows.shape = {{0, 0, false, 1.0}, {0, 1, true, 2.0}};
    result.theta = Eigen::Vector3d(1.1, 1.0, 0.9);
    result.at_optimum.predicted = Eigen::Vector3d(4.2, 1.0, -1.0);  // 2, 0 and -6 standard deviations away
    result.starts.resize(1);
    result.starts[0].optimum = 0;
    result.optima = {0};
    result.box = {Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(1.5, 1.5)};
    posterior.is_held = {false, false};
    posterior.prior_std = Eigen::Vector2d(0.3, 0.3);
    posterior.std = Eigen::Vector2d(0.02, 0.03);
    posterior.correlation = Eigen::Matrix2d::Identity();
    posterior.chi_squared = 1.0;
    posterior.degrees = 1;
  }
  [[nodiscard]] HeardReporter heard() const {
    HeardReporter reporter;
    say_weighing(reporter, {model, active, measured, pairing, rows, result}, posterior);
    return reporter;
  }
};

bool holds(const std::vector<std::string>& lines, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.find(words) != std::string::npos; });
}

TEST(WeighedRowList, PutsEachRowBesideWhatIsComputed) {
  const ByHand h;
  const std::vector<WeighedRow> list = weighed_row_list({h.model, h.active, h.measured, h.pairing, h.rows, h.result});
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].type, "frequency_Hz");
  EXPECT_EQ(list[0].value, 4.0);
  EXPECT_NEAR(list[0].difference_std(), 2.0, 1e-12);
  EXPECT_EQ(list[1].type, "shape");
  EXPECT_EQ(list[1].difference_std(), 0.0);
  EXPECT_EQ(list[2].type, "shape_imag");
  EXPECT_NEAR(list[2].difference_std(), -6.0, 1e-12);
}

TEST(SayWeighing, NamesParametersAndThoseThatABoundHolds) {
  ByHand h;
  h.posterior.is_held = {false, true};
  const HeardReporter heard = h.heard();
  EXPECT_TRUE(holds(heard.said, "+- 0.02"));
  EXPECT_TRUE(holds(heard.said, "0.9  held by its bound"));
  EXPECT_TRUE(heard.warned.empty());
}

TEST(SayWeighing, TellsParametersThatAreKnownTogetherOnly) {
  ByHand h;
  h.posterior.correlation(0, 1) = -0.95;
  EXPECT_TRUE(holds(h.heard().said, "left and right are known together only: correlation -0.950"));
  h.posterior.correlation(0, 1) = -0.85;
  EXPECT_FALSE(holds(h.heard().said, "known together"));
}

// chi² of 40 with one degree of freedom has a probability below 1e-9: deviations count sqrt(40) = 6.3 times. Of 2² + 6² the
// channel of the last row has 90 %.
TEST(SayWeighing, WarnsOfAMisfitAndNamesTheChannel) {
  ByHand h;
  h.measured.modes.dofs[1].direction = "c7";
  h.posterior.chi_squared = 40.0;
  const HeardReporter heard = h.heard();
  ASSERT_EQ(heard.warned.size(), 1U);
  EXPECT_NE(heard.warned[0].find("differ 6.3 times"), std::string::npos);
  EXPECT_NE(heard.warned[0].find("90 % of the squared differences are channel c7's"), std::string::npos);
  EXPECT_TRUE(holds(heard.said, "+- 0.13 (std_with_misfit)"));  // 0.02 · 6.3
  h.result.at_optimum.predicted = Eigen::Vector3d(4.6, 1.0, 1.0);
  EXPECT_TRUE(holds(h.heard().warned, "90 % of the squared differences are the frequencies'"));
}

// Both parameters do the same to the rows, by 5 deviations over half the range of each.
TEST(SayWeighing, WarnsOfTwins) {
  ByHand h;
  h.result.at_optimum.jacobian = (Eigen::MatrixXd(3, 2) << 10, 10, 0, 0, 0, 0).finished();
  EXPECT_TRUE(holds(h.heard().warned, "cannot tell left, right apart at the optimum"));
  h.result.at_start.jacobian = h.result.at_optimum.jacobian;
  EXPECT_EQ(h.heard().warned.size(), 1U);  // told once
  h.result.at_optimum.jacobian(1, 1) = 10.0;
  EXPECT_TRUE(holds(h.heard().warned, "cannot tell left, right apart at the initial values"));
}

TEST(SayWeighing, TellsFlatDirectionsOfOneAndOfSeveral) {
  ByHand h;
  h.posterior.flat = {{Eigen::Vector2d(0.3, 0.01), 0.2}};  // the second is below a fifth of its prior deviation
  EXPECT_TRUE(holds(h.heard().said, "moving left by +0.3 changes what is weighed by 0.2 standard deviations"));
  EXPECT_TRUE(h.heard().warned.empty());
  h.posterior.flat = {{Eigen::Vector2d(0.2, -0.2), 0.1}};
  EXPECT_TRUE(holds(h.heard().warned, "moving left by +0.2 and right by -0.2 together"));
}

// What the data do not see at all is told by another sentence (weighing_words.hpp), not twice.
TEST(SayWeighing, LeavesOutFlatDirectionsThatAreToldAlready) {
  ByHand h;
  h.result.scale = Eigen::Vector2d(1.0, 2.0);
  h.result.flat = Eigen::Vector2d(1.0, -1.0) / std::sqrt(2.0);
  h.posterior.flat = {{Eigen::Vector2d(0.2, -0.4), 0.0}};
  EXPECT_TRUE(h.heard().warned.empty());
  h.posterior.flat = {{Eigen::Vector2d(0.2, 0.4), 0.1}};
  EXPECT_TRUE(holds(h.heard().warned, "moving left by +0.2 and right by +0.4 together"));
}

// A residual of 0.001 is 0.04 of 40 deviations a unit. With the prior deviation 1/sqrt(12) of a range of 1 and a slope of 0.5,
// which is 20 deviations: C = 1/(400 + 12).
TEST(PosteriorOfFrequencies, CountsTheDeviationsThatAreStated) {
  ByHand h;
  h.active = {0};
  h.result.scale = Eigen::VectorXd::Ones(1);
  h.result.box = {Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Constant(1, 1.5)};
  h.result.at_optimum = {Eigen::VectorXd::Constant(1, 1e-3), Eigen::MatrixXd::Constant(1, 1, 0.5), {}, 0};
  const Weighed weighed{h.model, h.active, h.measured, h.pairing, {}, h.result};
  const std::optional<Posterior> found = posterior_of_frequencies(weighed);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->std[0], 1.0 / std::sqrt(412.0), 1e-12);
  EXPECT_NEAR(found->chi_squared, 0.04 * 0.04, 1e-15);
  h.measured.modes.frequency_std_Hz[0] = 0.0;
  EXPECT_FALSE(posterior_of_frequencies(weighed));
}

// A frequency of 4 Hz ± 0.1 Hz has 40 deviations. A slope of 0.05 over a range of 1, whose deviation is 1/sqrt(12), is 0.58 of
// them; one of 0.5 is 5.8.
TEST(SayFlatFrequencies, CountsRelativeResidualsInTheirDeviations) {
  ByHand h;
  h.result.scale = Eigen::Vector2d::Ones();
  h.result.at_optimum = {Eigen::VectorXd::Constant(1, 1e-3), Eigen::RowVector2d(0.5, 0.0), {}, 0};
  const auto said = [&] {
    HeardReporter reporter;
    const Weighed weighed{h.model, h.active, h.measured, h.pairing, {}, h.result};
    const std::optional<Posterior> posterior = posterior_of_frequencies(weighed);
    if (posterior) say_flat_frequencies(reporter, weighed, *posterior);
    EXPECT_TRUE(posterior);
    EXPECT_TRUE(reporter.warned.empty());
    return reporter.said;
  };
  ASSERT_EQ(said().size(), 1U);
  EXPECT_TRUE(holds(said(), "moving right by +0.289 changes the paired frequencies by 0 standard deviations"));
  h.active = {0};
  h.result.scale = Eigen::VectorXd::Ones(1);
  h.result.box = {Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Constant(1, 1.5)};
  h.result.at_optimum.jacobian = Eigen::MatrixXd::Constant(1, 1, 0.5);
  EXPECT_TRUE(said().empty());
  h.result.at_optimum.jacobian(0, 0) = 0.05;
  EXPECT_TRUE(holds(said(), "moving left by +0.289 changes the paired frequencies by 0.58 standard deviations"));
}

// Costs of 1 and 2.9 are chi² of 2 and 5.8: within 4. A cost of 3.1 is not.
TEST(SayWeighing, WarnsOfAnotherOptimumThatIsAsGood) {
  ByHand h;
  h.result.starts.resize(2);
  h.result.starts[0].cost = 1.0;
  h.result.starts[1].cost = 2.9;
  h.result.starts[1].optimum = 1;
  h.result.starts[1].theta = Eigen::Vector2d(0.7, 1.4);
  h.result.optima = {0, 1};
  EXPECT_TRUE(holds(h.heard().warned, "another optimum is as good (chi² 5.8 against 2): left 0.7, right 1.4"))
      << (h.heard().warned.empty() ? "" : h.heard().warned[0]);
  h.result.starts[1].cost = 3.1;
  EXPECT_TRUE(h.heard().warned.empty());
}

}  // namespace
}  // namespace twindeck::updating
