// Oracle: noise floors of m + 1 channels with errors s, on which ln of a factor a acts linearly on one channel. Their common
// level is free, so that the signature of a has the length |a| / (s sqrt(1 + 1/m)).
#include "diagnosis/visibility.hpp"

#include <gtest/gtest.h>

#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Candidate;
using diagnosis::Hypothesis;
using diagnosis::RowType;
using diagnosis::Visibility;
using Eigen::VectorXd;

constexpr int kQuietChannels = 4;
constexpr double kFloorStd = 0.1;
constexpr double kLevelPrior = 1e-4;  // relative: the level's prior is 10 wide, s²/100 of what the rows know of it

/// What is seen of entries that change the floors of five channels.
class SeenOnFloors {
 public:
  SeenOnFloors()
      : model_(nodes_in_a_row(1 + kQuietChannels), springs_in_a_row(VectorXd::Constant(2 + kQuietChannels, 2e6)),
               1000.0 * Eigen::MatrixXd::Identity(1 + kQuietChannels, 1 + kQuietChannels)) {
    for (int c = 0; c <= kQuietChannels; ++c) model_.add_row(RowType::psd_floor, "", c, 1.0, kFloorStd);
  }
  /// A family whose factor acts on one channel; ln of its bounds and of the magnitudes that are tried.
  void add(const std::string& id, const std::string& unknown, int channel, double low, double high, std::vector<double> tried,
           double log_prior) {
    hypotheses_.push_back(std::make_unique<Hypothesis>());
    Hypothesis& h = *hypotheses_.back();
    h.id = id;
    h.unknowns.push_back({unknown, "-", {}, {}, true, {}});
    h.actions.push_back({diagnosis::Primitive::channel_floor, {}, {{"factor", {1.0, "$" + unknown, 0}}}, 0});
    auto candidate = std::make_unique<Candidate>();
    candidate->hypothesis = &h;
    candidate->location = "channel:c" + std::to_string(channel);
    candidate->channels = {channel};
    candidate->log = {true};
    candidate->low = VectorXd::Constant(1, low);
    candidate->high = VectorXd::Constant(1, high);
    for (const double start : tried) candidate->starts.push_back(VectorXd::Constant(1, start));
    candidate->log_prior = log_prior;
    entries_.push_back(std::move(candidate));
  }
  [[nodiscard]] std::vector<Visibility> seen() const {
    const diagnosis::FeatureMap map = model_.map();
    return visibility(diagnosis::Inference(map, entries_));
  }
  /// Length of the signature of ln factor a.
  static double length(double a) { return std::abs(a) / (kFloorStd * std::sqrt(1.0 + 1.0 / kQuietChannels)); }

 private:
  Predicted model_;
  std::vector<std::unique_ptr<Hypothesis>> hypotheses_;
  std::vector<std::unique_ptr<Candidate>> entries_;
};

TEST(Visibility, IsTheLongestSignatureThatIsTried) {
  SeenOnFloors floors;
  floors.add("up", "factor", 0, -2.0, 2.0, {0.2, -1.5, 0.9}, -1.0);
  const auto seen = floors.seen();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_NEAR(seen[0].sigma / SeenOnFloors::length(1.5), 1.0, kLevelPrior);
  EXPECT_EQ(seen[0].status, "visible");
}

TEST(Visibility, SmallestMagnitudeNeedsFiveNatsWithThePrior) {
  // 1/2 s² = 5 - ln prior; from a factor of 1 towards the one that was tried, to 1/4096 of the way.
  SeenOnFloors floors;
  floors.add("up", "factor", 0, -2.0, 2.0, {1.5}, -3.0);
  floors.add("down", "factor", 0, -2.0, 2.0, {-1.5}, -3.0);
  const double needed = std::sqrt(2.0 * 8.0) / SeenOnFloors::length(1.0);  // ln of the factor
  const auto seen = floors.seen();
  ASSERT_TRUE(seen.at(0).smallest && seen.at(1).smallest);
  EXPECT_NEAR(std::log(*seen[0].smallest), needed, 1.5 / 2000.0);
  EXPECT_NEAR(std::log(*seen[1].smallest), -needed, 1.5 / 2000.0);
}

TEST(Visibility, OfWhatIsNoFactorStartsAtItsLowerBound) {
  // Its lower bound is 1, whose logarithm does nothing to a floor.
  SeenOnFloors floors;
  floors.add("size", "size", 0, 0.0, 2.0, {1.5}, -3.0);
  const double needed = std::sqrt(2.0 * 8.0) / SeenOnFloors::length(1.0);
  ASSERT_TRUE(floors.seen().at(0).smallest.has_value());
  EXPECT_NEAR(std::log(*floors.seen().at(0).smallest), needed, 1.5 / 2000.0);
}

TEST(Visibility, SaysWhyNothingIsSeen) {
  SeenOnFloors floors;
  const double one = 1.0 / SeenOnFloors::length(1.0);  // ln factor of one standard deviation
  floors.add("noise", "factor", 0, -2.0, 2.0, {0.9 * one}, -3.0);
  floors.add("small", "factor", 0, -2.0, 2.0, {3.9 * one}, -3.0);
  floors.add("enough", "factor", 0, -2.0, 2.0, {4.1 * one}, -3.0);  // sqrt(16) are needed
  const auto seen = floors.seen();
  EXPECT_EQ(seen.at(0).status, "these data cannot see it");
  EXPECT_EQ(seen.at(1).status, "too small at the tried magnitude");
  EXPECT_EQ(seen.at(2).status, "visible");
  EXPECT_FALSE(seen[0].smallest || seen[1].smallest);
  EXPECT_TRUE(seen[2].smallest.has_value());
}

TEST(Visibility, ImitationIsTheNearestOfAnotherFamily) {
  // Signatures of two channels, with the level taken off, have the cosine -1/m. The same channel is imitated wholly.
  SeenOnFloors floors;
  floors.add("first", "factor", 0, -2.0, 2.0, {1.5}, -1.0);
  floors.add("other", "factor", 1, -2.0, 2.0, {0.8}, -1.0);
  auto seen = floors.seen();
  EXPECT_EQ(seen.at(0).imitation, "other@channel:c1");
  EXPECT_NEAR(seen.at(0).separation / (seen[0].sigma * std::sqrt(1.0 - 1.0 / 16.0)), 1.0, 1e-3);
  floors.add("same", "factor", 0, -2.0, 2.0, {0.3}, -1.0);
  seen = floors.seen();
  EXPECT_EQ(seen.at(0).imitation, "same@channel:c0");
  EXPECT_NEAR(seen.at(0).separation, 0.0, 1e-5 * seen[0].sigma);
}

}  // namespace
}  // namespace twindeck::tests
