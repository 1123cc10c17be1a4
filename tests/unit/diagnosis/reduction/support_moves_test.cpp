// Oracles: stations of a line of beams by hand; at its own station a support's springs are its own stiffness.
#include <gtest/gtest.h>

#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/structure.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Place;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Beams of unequal length through the given points, with two springs under one of them.
fe::Model beams_on_springs(const std::vector<Vector3d>& points, int support) {
  fe::Model model;
  model.source = "beams";
  for (std::size_t i = 0; i < points.size(); ++i) model.nodes.push_back({static_cast<long>(i) + 1, points[i]});
  model.materials.push_back({"steel", 210e9, 81e9, 0.3, 7850.0});
  fe::Section section;
  section.name = "tube";
  section.area_m2 = 0.01;
  section.inertia_y_m4 = section.inertia_z_m4 = 1e-4;
  section.torsion_m4 = 2e-4;
  model.sections.push_back(section);
  for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) {
    fe::Element element;
    element.id = i + 1;
    element.group = "girder";
    element.material = element.section = 0;
    element.nodes = {i, i + 1};
    model.elements.push_back(element);
  }
  model.supports.push_back({"left", 0, {true, true, true, true, false, false}});
  for (const auto& [direction, stiffness] : {std::pair<Vector3d, double>{Vector3d::UnitZ(), 5e6}, {Vector3d::UnitY(), 2e6}}) {
    fe::Spring spring;
    spring.name = direction.z() > 0.0 ? "pier_z" : "pier_y";
    spring.group = "pier";
    spring.node = support;
    spring.direction = direction;
    spring.stiffness = stiffness;
    model.springs.push_back(spring);
  }
  return model;
}

std::vector<Vector3d> straight() { return {{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {9, 0, 0}, {10, 0, 0}, {14, 0, 0}}; }

struct Found {
  std::shared_ptr<diagnosis::DiagnosedModel> prepared;
  diagnosis::Places places;
  [[nodiscard]] const Place* move(const std::string& id) const {
    const auto set = places.sets.find("support_moves");
    if (set == places.sets.end()) return nullptr;
    for (const Place& place : set->second)
      if (place.id == id) return &place;
    return nullptr;
  }
};

Found found_in(const fe::Model& model) {
  matching::Channel channel;
  channel.name = "middle";
  channel.point = "4";
  channel.direction = Vector3d::UnitZ();
  Found out{diagnosis::prepare_model(dynamics::from_model(model), {channel}, 0.1), {}};
  out.places = diagnosis::find_places(out.prepared->structure(), {});
  return out;
}

TEST(SupportMoves, StandAtTheNodesOfTheLine) {
  const Found found = found_in(beams_on_springs(straight(), 2));
  const Place* pier = found.move("support:pier");
  ASSERT_NE(pier, nullptr);
  const double x[] = {0, 2, 5, 9, 10, 14};
  EXPECT_EQ(pier->attributes.at("stations"), 6.0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(pier->attributes.at("x_" + std::to_string(i)), x[i], 1e-12) << i;
    EXPECT_EQ(pier->attributes.at("node_" + std::to_string(i)), i);
  }
  EXPECT_NEAR(pier->attributes.at("x_low"), 0.0, 1e-12);
  EXPECT_NEAR(pier->attributes.at("x_high"), 14.0, 1e-12);
  // Eight starts in the middles of equal parts of 14 m.
  for (int s = 0; s < 8; ++s) EXPECT_NEAR(pier->attributes.at("x_start_" + std::to_string(s)), 14.0 * (s + 0.5) / 8.0, 1e-12);
}

TEST(SupportMoves, SpringsAtTheirOwnStationAreTheSupport) {
  const Found found = found_in(beams_on_springs(straight(), 2));
  const Place* pier = found.move("support:pier");
  ASSERT_NE(pier, nullptr);
  ASSERT_EQ(pier->directions.cols(), 12);  // two springs at each of six stations
  EXPECT_EQ(pier->attributes.at("k_0"), 5e6);
  EXPECT_EQ(pier->attributes.at("k_1"), 2e6);
  const MatrixXd b = pier->directions;
  const MatrixXd own = 5e6 * b.col(4) * b.col(4).transpose() + 2e6 * b.col(5) * b.col(5).transpose();
  EXPECT_LT((own - MatrixXd(pier->stiffness.whole())).norm(), 1e-9 * own.norm());
  // At other stations each is a unit force at another dof.
  EXPECT_EQ(b.col(8).sum(), 1.0);
  EXPECT_EQ(b.col(8).dot(b.col(4)), 0.0);
  EXPECT_EQ(b.col(8).dot(b.col(9)), 0.0);
}

// What a fixed support of the same name holds is a place of its own, which stays: moved too it would be held twice.
TEST(SupportMoves, SpringsOfAFixedSupportOfTheNameStay) {
  fe::Model model = beams_on_springs(straight(), 2);
  model.springs.pop_back();  // a bearing in z alone; the support holds in y
  model.supports.push_back({"pier", 2, {false, true, false, false, false, false}});
  const Found found = found_in(model);
  const Place* pier = found.move("support:pier");
  ASSERT_NE(pier, nullptr);
  ASSERT_EQ(pier->directions.cols(), 6);  // one spring at each of six stations
  EXPECT_EQ(pier->attributes.at("k_0"), 5e6);
  const MatrixXd b = pier->directions;
  const MatrixXd own = 5e6 * b.col(2) * b.col(2).transpose();
  EXPECT_LT((own - MatrixXd(pier->stiffness.whole())).norm(), 1e-9 * own.norm());
}

TEST(SupportMoves, AreInOrderOfXHoweverTheBeamsRun) {
  auto points = straight();
  std::reverse(points.begin(), points.end());
  const Found found = found_in(beams_on_springs(points, 3));
  const Place* pier = found.move("support:pier");
  ASSERT_NE(pier, nullptr);
  EXPECT_NEAR(pier->attributes.at("x_0"), 0.0, 1e-12);
  EXPECT_EQ(pier->attributes.at("node_0"), 5.0);
  EXPECT_NEAR(pier->attributes.at("x_5"), 14.0, 1e-12);
}

TEST(SupportMoves, EndWhereTheLineTurns) {
  // The last two beams go up: the line has the four nodes before the corner. Without one of these it is too short.
  std::vector<Vector3d> points = {{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {9, 0, 0}, {9, 0, 3}, {9, 0, 6}};
  const Found found = found_in(beams_on_springs(points, 2));
  ASSERT_NE(found.move("support:pier"), nullptr);
  EXPECT_EQ(found.move("support:pier")->attributes.at("stations"), 4.0);
  points.erase(points.begin() + 1);
  EXPECT_EQ(found_in(beams_on_springs(points, 1)).move("support:pier"), nullptr);
}

TEST(SupportMoves, AFootThatHoldsAgainstTurningStays) {
  fe::Model model = beams_on_springs(straight(), 2);
  fe::Spring turning;
  turning.name = "pier_r";
  turning.group = "pier";
  turning.node = 2;
  turning.direction = Vector3d::UnitY();
  turning.rotation = true;
  turning.stiffness = 1e7;
  model.springs.push_back(turning);
  EXPECT_EQ(found_in(model).move("support:pier"), nullptr);
}

TEST(SupportMoves, OneOnTwoNodesStays) {
  fe::Model model = beams_on_springs(straight(), 2);
  model.springs.back().node = 3;
  EXPECT_EQ(found_in(model).move("support:pier"), nullptr);
}

}  // namespace
}  // namespace twindeck::tests
