// Oracle: scores by hand from a fit of three rows with unit errors.
#include <gtest/gtest.h>

#include "diagnosis/diagnose.hpp"
#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::LocationScore;
using diagnosis::RowType;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two masses and a parameter, with three rows. Unknowns: parameter k1, masses of nodes 1 and 2, damping of mode 1.
class ThreeRows {
 public:
  ThreeRows()
      : model(nodes_in_a_row(2), springs_in_a_row((VectorXd(3) << 2e6, 0, 3e6).finished()), 1000.0 * MatrixXd::Identity(2, 2),
              {{{"k1", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.8, 1.2},
                springs_in_a_row((VectorXd(3) << 0, 1e6, 0).finished())}}) {
    model.add_row(RowType::frequency, "1", -1, 6.0);
    model.add_row(RowType::frequency, "2", -1, 9.0);
    model.add_row(RowType::damping, "1", -1, 0.5);
    map = std::make_unique<diagnosis::FeatureMap>(model.map());
    inference = std::make_unique<diagnosis::Inference>(*map, none);
    fit.whitened = Eigen::Vector3d(3.0, -4.0, 1.0);
    fit.total_factor = MatrixXd::Identity(3, 3);
    fit.map.jacobian = MatrixXd::Zero(3, std::ssize(map->nuisances()));
  }
  void slope(const std::string& name, const Eigen::Vector3d& of) {
    for (std::size_t j = 0; j < map->nuisances().size(); ++j)
      if (map->nuisances()[j].name == name) fit.map.jacobian.col(static_cast<Eigen::Index>(j)) = of;
  }
  /// An entry of the ranking.
  diagnosis::Scored scored(HandMade& made, const std::string& location, double screen) {
    made.candidate.location = location;
    diagnosis::Scored out;
    out.candidate = &made.candidate;
    out.screen = screen;
    return out;
  }
  [[nodiscard]] std::map<std::string, double> scores(const std::vector<diagnosis::Scored>& ranking = {}) const {
    std::map<std::string, double> out;
    for (const LocationScore& score : location_map(*inference, fit, ranking)) out[score.location] = score.score;
    return out;
  }
  Predicted model;
  const std::vector<std::unique_ptr<diagnosis::Candidate>> none;
  std::unique_ptr<diagnosis::FeatureMap> map;
  std::unique_ptr<diagnosis::Inference> inference;
  diagnosis::Fit fit;
};

TEST(LocationMap, ScoresTheProjectionOfTheResidual) {
  ThreeRows rows;
  rows.slope("k1", {2.0, 0.0, 0.0});
  rows.slope("node:1 mass", {-0.3, 0.4, 0.0});  // whatever its sign and size: 5 of (3, -4)
  const auto found = rows.scores();
  EXPECT_NEAR(found.at("group:k1"), 3.0, 1e-12);
  EXPECT_NEAR(found.at("node:1"), 5.0, 1e-12);
  EXPECT_FALSE(found.contains("node:2"));  // it does nothing to these rows
}

TEST(LocationMap, SlopesAreSeenThroughTheErrors) {
  ThreeRows rows;
  rows.fit.total_factor.diagonal() << 2.0, 1.0, 1.0;
  rows.slope("k1", {2.0, 1.0, 0.0});  // whitened (1, 1): -1 / sqrt 2
  EXPECT_NEAR(rows.scores().at("group:k1"), std::sqrt(0.5), 1e-12);
}

TEST(LocationMap, DampingIsNoLocation) {
  ThreeRows rows;
  rows.slope("mode 1 structural damping", {0.0, 0.0, 1.0});
  EXPECT_TRUE(rows.scores().empty());
}

TEST(LocationMap, TakesTheBestOfTheScreen) {
  ThreeRows rows;
  rows.slope("node:1 mass", {0.0, 0.0, 1.0});
  HandMade mass("mass.add", {{"mass", 1.0}}), other("element.spring", {{"stiffness", 1.0}}),
      gain("channel.gain", {{"factor", 1.0}});
  gain.hypothesis.measurement = true;
  const auto found = rows.scores({rows.scored(mass, "node:1", 16.0)});
  EXPECT_NEAR(found.at("node:1"), 4.0, 1e-12);  // the root of 2 ln likelihood ratio
  EXPECT_FALSE(rows.scores({rows.scored(gain, "channel:c0", 99.0)}).contains("channel:c0"));
  EXPECT_FALSE(rows.scores({rows.scored(other, "global", 99.0)}).contains("global"));
  EXPECT_FALSE(rows.scores({rows.scored(other, "node:2", -1.0)}).contains("node:2"));
}

TEST(LocationMap, IsInDescendingOrderAndOfFortyAtMost) {
  ThreeRows rows;
  std::vector<std::unique_ptr<HandMade>> made;
  std::vector<diagnosis::Scored> ranking;
  for (int i = 0; i < 45; ++i) {
    made.push_back(std::make_unique<HandMade>("mass.add", std::map<std::string, double>{{"mass", 1.0}}));
    ranking.push_back(rows.scored(*made.back(), "node:" + std::to_string(100 + i), 1.0 + (i * 7) % 45));
  }
  const auto found = location_map(*rows.inference, rows.fit, ranking);
  ASSERT_EQ(found.size(), 40U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i].score, std::sqrt(45.0 - static_cast<double>(i)), 1e-12);
}

}  // namespace
}  // namespace twindeck::tests
