#include "sensors/setup_scores.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/error.hpp"

namespace twindeck::sensors {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;

/// A deck with points on an inner line at s = 1, 2, 3, 4 m and on an outer line at s = 1, 2, 3 m.
std::vector<LayoutPoint> two_lines() {
  std::vector<LayoutPoint> points;
  for (int s = 1; s <= 4; ++s) points.push_back({"I" + std::to_string(s), "foot_inner", static_cast<double>(s)});
  for (int s = 1; s <= 3; ++s) points.push_back({"O" + std::to_string(s), "foot_outer", static_cast<double>(s)});
  return points;
}

/// Three shapes at the candidates of a deck, without any symmetry.
MatrixXd rough_shapes(Index candidates) {
  MatrixXd phi(candidates, 3);
  for (Index i = 0; i < phi.size(); ++i) phi(i) = std::sin(1.0 + 0.7 * static_cast<double>(i * i));
  return phi;
}

LayoutChannel given(const std::string& setup, const std::string& channel, const std::string& point,
                    const std::string& direction) {
  LayoutChannel row;
  row.setup = setup;
  row.family = "fam";
  row.channel = channel;
  row.point = point;
  row.direction = direction;
  return row;
}

/// Eq. (1) term by term: the mean MAC of different modes.
double mean_mac(const MatrixXd& phi) {
  double sum = 0.0;
  int count = 0;
  for (Index i = 0; i < phi.cols(); ++i) {
    for (Index j = 0; j < phi.cols(); ++j) {
      if (i == j) continue;
      sum += std::pow(phi.col(i).dot(phi.col(j)), 2) / (phi.col(i).squaredNorm() * phi.col(j).squaredNorm());
      ++count;
    }
  }
  return sum / count;
}

double mean_mac_at(const MatrixXd& phi, const std::vector<Index>& rows) { return mean_mac(phi(rows, Eigen::all)); }

const ScoredSetup& by_name(const std::vector<ScoredSetup>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const ScoredSetup& s) { return s.name == name; });
}

LayoutSettings small_settings() {
  LayoutSettings settings;
  settings.channels = 4;
  settings.draws = 400;
  settings.free_setups = 3;
  return settings;
}

std::vector<ScoredSetup> scored(const LayoutSettings& settings, const std::vector<LayoutChannel>& setups, const MatrixXd& phi,
                                std::uint64_t seed = 11) {
  const std::vector<LayoutPoint> points = two_lines();
  return score_setups(settings, points, candidate_channels(points), setups, phi, seed);
}

// Oracle: the definition. Candidate 2 i is the vertical channel of point i, candidate 2 i + 1 the radial one.
TEST(CandidateChannels, AreTwoAPoint) {
  const std::vector<LayoutChannel> candidates = candidate_channels(two_lines());
  ASSERT_EQ(candidates.size(), 14U);
  EXPECT_EQ(candidates[4].channel, "I3z");
  EXPECT_EQ(candidates[4].direction, "vertical");
  EXPECT_EQ(candidates[5].channel, "I3r");
  EXPECT_EQ(candidates[5].direction, "radial");
  EXPECT_EQ(candidates[5].point, "I3");
}

// Oracle: Eq. (1) term by term, and det(Phi' Phi) of shapes of unit norm over all candidates by an LU factorisation.
TEST(ScoreSetups, ScoresThoseOfTheFile) {
  const MatrixXd phi = rough_shapes(14);
  const std::vector<LayoutChannel> setups = {given("A", "a1", "O2", "radial"), given("A", "a2", "I1", "vertical"),
                                             given("A", "a3", "I4", "radial")};
  const ScoredSetup setup = scored(small_settings(), setups, phi).front();
  const std::vector<Index> rows = {11, 0, 7};
  EXPECT_EQ(setup.name, "A");
  EXPECT_EQ(setup.family, "fam");
  EXPECT_EQ(setup.rows, rows);
  EXPECT_EQ(setup.channels, (std::vector<std::string>{"a1", "a2", "a3"}));
  EXPECT_NEAR(setup.score, mean_mac_at(phi, rows), 1e-14);
  MatrixXd part = phi(rows, Eigen::all);
  for (Index j = 0; j < 3; ++j) part.col(j) /= phi.col(j).norm();
  EXPECT_NEAR(setup.log_determinant, std::log((part.transpose() * part).determinant()), 1e-10);
}

// Oracle: enumeration. Inner vertical and outer radial at one place move together to the places 1, 2, 3: place 4 lacks the
// outer line. Each of the three comes up in a third of the draws; with 400 draws one deviation is 2.4 %, and the band is four.
TEST(ScoreSetups, DrawsCandidatesOfTheSameFamily) {
  const MatrixXd phi = rough_shapes(14);
  std::vector<double> scores;
  for (const Index place : {0, 1, 2}) scores.push_back(mean_mac_at(phi, {2 * place, 2 * (4 + place) + 1}));
  std::sort(scores.begin(), scores.end());
  for (const char* place : {"1", "2", "3"}) {
    const std::vector<LayoutChannel> setups = {given("A", "a1", std::string("I") + place, "vertical"),
                                               given("A", "a2", std::string("O") + place, "radial")};
    const ScoredSetup setup = scored(small_settings(), setups, phi).front();
    const auto better = std::count_if(scores.begin(), scores.end(), [&](double s) { return s < setup.score - 1e-12; });
    EXPECT_EQ(setup.draws, 400);
    EXPECT_NEAR(setup.best_drawn, scores[0], 1e-14);
    EXPECT_NEAR(setup.median_drawn, scores[1], 1e-14);
    EXPECT_NEAR(setup.better_drawn_pct, 100.0 * static_cast<double>(better) / 3.0, better == 0 ? 1e-12 : 10.0);
  }
}

// Oracle: enumeration. Two places of one line go to two different ones of four, six pairs. The least score is found, and for
// the pair that scores worst five of six draws are better. (Both at one place would tell nothing apart and score 1, in a
// quarter of the draws.) With 400 draws one deviation is 1.9 %; the band is four.
TEST(ScoreSetups, MovesPlacesToDifferentOnes) {
  const MatrixXd phi = rough_shapes(14);
  double least = 1.0, most = 0.0;
  std::pair<Index, Index> worst;
  for (Index a = 0; a < 4; ++a) {
    for (Index b = 0; b < a; ++b) {
      const double score = mean_mac_at(phi, {2 * a, 2 * b});
      least = std::min(least, score);
      if (score > most) worst = {a, b};
      most = std::max(most, score);
    }
  }
  const auto place = [](Index at) { return "I" + std::to_string(at + 1); };
  const ScoredSetup setup =
      scored(small_settings(),
             {given("A", "a1", place(worst.first), "vertical"), given("A", "a2", place(worst.second), "vertical")}, phi)
          .front();
  EXPECT_NEAR(setup.best_drawn, least, 1e-14);
  EXPECT_NEAR(setup.better_drawn_pct, 500.0 / 6.0, 7.5);
}

// Oracle: enumeration. Of two places only the second has both lines, so that a setup of all three points has no other candidate
// than itself. Half of the draws put the first place there and have to begin anew.
TEST(ScoreSetups, FindsAPlaceForAll) {
  const std::vector<LayoutPoint> points = {{"I1", "foot_inner", 1.0}, {"I2", "foot_inner", 2.0}, {"O2", "foot_outer", 2.0}};
  const std::vector<LayoutChannel> setups = {given("A", "a1", "I1", "vertical"), given("A", "a2", "I2", "vertical"),
                                             given("A", "a3", "O2", "vertical")};
  const ScoredSetup setup =
      score_setups(small_settings(), points, candidate_channels(points), setups, rough_shapes(6), 11).front();
  EXPECT_NEAR(setup.best_drawn, setup.score, 1e-14);
  EXPECT_NEAR(setup.median_drawn, setup.score, 1e-14);
}

// Oracle: the definitions. DC1, DC2, … are the lowest of the free draws in this order, each of so many different channels.
TEST(ScoreSetups, KeepsTheLowestFreeDraws) {
  const MatrixXd phi = rough_shapes(14);
  const std::vector<ScoredSetup> all = scored(small_settings(), {}, phi);
  ASSERT_EQ(all.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(all[i].name, "DC" + std::to_string(i + 1));
    EXPECT_EQ(all[i].family, "dec");
    EXPECT_EQ(std::set<Index>(all[i].rows.begin(), all[i].rows.end()).size(), 4U);
    EXPECT_NEAR(all[i].score, mean_mac_at(phi, all[i].rows), 1e-14);
    EXPECT_NEAR(all[i].best_drawn, all[0].score, 1e-14);
    EXPECT_GT(all[i].median_drawn, all[2].score);
    EXPECT_GE(all[i].score, all[i == 0 ? 0 : i - 1].score);
  }
  EXPECT_EQ(all[0].better_drawn_pct, 0.0);
  LayoutSettings few = small_settings();
  few.draws = 2;
  EXPECT_EQ(scored(few, {}, phi).size(), 5U);  // no more than were drawn
}

// Oracle: properties of the searches. Exchange cannot end below its start: the determinant is no less than Kammer's, and R_k no
// more than that of any setup of as many channels. No exchange of one channel betters it.
TEST(ScoreSetups, SearchesNoWorseThanWhatItStartsFrom) {
  const MatrixXd phi = rough_shapes(14);
  const std::vector<ScoredSetup> all = scored(small_settings(),
                                              {given("A", "a1", "I1", "vertical"), given("A", "a2", "I2", "radial"),
                                               given("A", "a3", "I3", "vertical"), given("A", "a4", "O2", "vertical")},
                                              phi);
  const ScoredSetup &kammer = by_name(all, "effective_independence"), &greatest = by_name(all, "greatest_determinant"),
                    &least = by_name(all, "least_R_k");
  EXPECT_GE(greatest.log_determinant, kammer.log_determinant);
  for (const ScoredSetup& setup : all) {
    ASSERT_EQ(setup.rows.size(), 4U);
    EXPECT_LE(least.score, setup.score + 1e-14) << setup.name;
    EXPECT_GE(greatest.log_determinant, setup.log_determinant - 1e-12) << setup.name;
  }
  EXPECT_EQ(least.draws, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    for (Index other = 0; other < 14; ++other) {
      std::vector<Index> rows = least.rows;
      rows[i] = other;
      if (std::set<Index>(rows.begin(), rows.end()).size() < 4U) continue;
      EXPECT_GE(mean_mac_at(phi, rows), least.score - 1e-9);
    }
  }
}

// Oracle: invariance. Neither R_k nor the scaled determinant depends on scale and sign of a mode; the draws depend on the seed.
TEST(ScoreSetups, DoNotDependOnTheScaleOfModes) {
  const MatrixXd phi = rough_shapes(14);
  const std::vector<LayoutChannel> setups = {given("A", "a1", "I1", "vertical"), given("A", "a2", "O2", "radial"),
                                             given("A", "a3", "I4", "radial")};
  const std::vector<ScoredSetup> once = scored(small_settings(), setups, phi);
  const std::vector<ScoredSetup> again = scored(small_settings(), setups, phi * Eigen::Vector3d(-2.0, 8.0, 0.25).asDiagonal());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(again[i].rows, once[i].rows) << once[i].name;
    EXPECT_NEAR(again[i].score, once[i].score, 1e-13);
    EXPECT_NEAR(again[i].log_determinant, once[i].log_determinant, 1e-11);
  }
  EXPECT_NE(scored(small_settings(), setups, phi, 12)[0].better_drawn_pct, once[0].better_drawn_pct);
}

// Oracle: the header. Setups of the file, drawn ones as far as there are any, and the searches are known.
TEST(RefuseUnknownBlindSetups, KnowsWhatWillBeScored) {
  LayoutSettings settings = small_settings();
  const std::vector<LayoutChannel> setups = {given("A", "a1", "I1", "vertical")};
  settings.blind_setups = {"A", "DC3", "least_R_k", "greatest_determinant", "effective_independence"};
  EXPECT_NO_THROW(refuse_unknown_blind_setups(settings, setups));
  for (const char* unknown : {"B", "DC0", "DC4", ""}) {
    settings.blind_setups = {"A", unknown};
    EXPECT_THROW(refuse_unknown_blind_setups(settings, setups), InputError) << unknown;
  }
  settings.draws = 2;
  settings.blind_setups = {"DC3"};
  EXPECT_THROW(refuse_unknown_blind_setups(settings, setups), InputError);
}

}  // namespace
}  // namespace twindeck::sensors
