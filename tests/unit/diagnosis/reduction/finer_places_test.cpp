// Oracles: ways that are measured by hand on a row of nodes with unequal distances and on a branch; matrices that add up.
#include "diagnosis/reduction/finer_places.hpp"

#include <gtest/gtest.h>

#include "diagnosis/reduction/diagnosed_model.hpp"
#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::NodeGraph;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Names = std::vector<std::string>;

/// Nodes a to g on x, joined in a row, with the given distances from one to the next; NaN where no coordinates are known.
std::unique_ptr<MatrixModel> row_of_nodes(const std::vector<double>& distances) {
  std::vector<fe::DofLabel> dofs;
  double x = 0.0;
  for (std::size_t i = 0; i <= distances.size(); ++i) {
    dofs.push_back({std::string(1, static_cast<char>('a' + i)), 0, Vector3d(x, 0.0, 0.0)});
    if (i < distances.size()) x += distances[i];
  }
  const auto n = static_cast<Eigen::Index>(dofs.size());
  return std::make_unique<MatrixModel>(dofs, springs_in_a_row(Eigen::VectorXd::Ones(n + 1)), MatrixXd::Identity(n, n));
}

TEST(NodeGraphOfAMatrixModel, MiddleIsThatOfTheWayInMetres) {
  // From a to g are 20 m; the nodes on the way lie at 1, 2, 3, 4 and 12 m, of which 12 m is nearest to the middle.
  const auto model = row_of_nodes({1, 1, 1, 1, 8, 8});
  EXPECT_EQ(NodeGraph(model->structure()).between("a", {"a", "g"}), Names{"f"});
  EXPECT_EQ(NodeGraph(model->structure()).between("g", {"a", "g"}), Names{"f"});
}

TEST(NodeGraphOfAMatrixModel, EveryEdgeCountsOneWhereCoordinatesAreUnknown) {
  const double nowhere = std::nan("");
  const auto model = row_of_nodes({nowhere, nowhere, nowhere, nowhere, nowhere, nowhere});
  EXPECT_EQ(NodeGraph(model->structure()).between("a", {"a", "g"}), Names{"d"});
}

TEST(NodeGraphOfAMatrixModel, TheShortestWayComesFirst) {
  // From d to a are 6 m with middle b or c at 2 and 4 m; to g are 4 m with middle f.
  const auto model = row_of_nodes({2, 1.5, 2.5, 1, 1, 2});
  const NodeGraph graph(model->structure());
  EXPECT_EQ(graph.between("d", {"a", "d", "g"}), (Names{"f", "c"}));
}

TEST(NodeGraphOfAMatrixModel, AnOpenEndIsLookedAtWhereItIsFarther) {
  // Beside d lies b, with c between them at 1 m; the open end g is 9 m away.
  const auto model = row_of_nodes({1, 1, 1, 3, 3, 3});
  EXPECT_EQ(NodeGraph(model->structure()).between("d", {"b", "d"}), (Names{"c", "g"}));
  // An end 0.5 m away is nearer than the middle of the way.
  const auto short_end = row_of_nodes({1, 1, 1, 0.5});
  EXPECT_EQ(NodeGraph(short_end->structure()).between("d", {"b", "d"}), Names{"c"});
}

TEST(NodeGraphOfAMatrixModel, NeighboursThatAreLocationsLeaveNothing) {
  const auto model = row_of_nodes({1, 1, 1, 1, 1, 1});
  const NodeGraph graph(model->structure());
  EXPECT_TRUE(graph.between("b", {"a", "b", "c"}).empty());
  EXPECT_TRUE(graph.between("nowhere", {"a", "b"}).empty());
  EXPECT_TRUE(graph.between("b", {"a", "nowhere"}).empty());  // the centre itself is no location
}

TEST(NodePlace, OfAMatrixModelHasTheTranslationsThatItHas) {
  std::vector<fe::DofLabel> dofs = {{"p", 2, {1, 2, 3}}, {"q", 0, {4, 5, 6}}, {"q", 2, {4, 5, 6}}, {"q", 4, {4, 5, 6}}};
  const MatrixModel model(dofs, MatrixXd::Identity(4, 4), MatrixXd::Identity(4, 4));
  const diagnosis::Place q = diagnosis::node_place(model.structure(), "q");
  EXPECT_EQ(q.id, "node:q");
  EXPECT_EQ(q.x_m, Vector3d(4, 5, 6));
  MatrixXd unit = MatrixXd::Zero(4, 2);
  unit(1, 0) = unit(2, 1) = 1.0;  // its rotation is no unit force
  EXPECT_EQ(MatrixXd(q.directions), unit);
}

/// Six beams in a row along y, a node a metre, of one material whose modulus is a parameter.
std::shared_ptr<diagnosis::DiagnosedModel> six_beams() {
  fe::Model model;
  model.source = "beams";
  for (int i = 0; i <= 6; ++i) model.nodes.push_back({i + 1, {0.0, 1.0 * i, 0.0}});
  model.materials.push_back({"steel", 210e9, 81e9, 0.3, 7850.0});
  fe::Section section;
  section.name = "tube";
  section.area_m2 = 0.01;
  section.inertia_y_m4 = section.inertia_z_m4 = 1e-5;
  section.torsion_m4 = 2e-5;
  model.sections.push_back(section);
  for (int i = 0; i < 6; ++i) {
    fe::Element element;
    element.id = 11 + i;
    element.group = "beams";
    element.material = element.section = 0;
    element.nodes = {i, i + 1};
    model.elements.push_back(element);
  }
  model.supports.push_back({"left", 0, {true, true, true, true, true, true}});
  model.parameters.push_back({"E", fe::Target::youngs_modulus, {"steel"}, "Pa", 210e9, 190e9, 230e9});
  matching::Channel channel;
  channel.name = "tip";
  channel.point = "7";
  channel.direction = Vector3d::UnitZ();
  return diagnosis::prepare_model(dynamics::from_model(model), {channel}, 0.1);
}

TEST(HalvesOf, AreCutAcrossTheLongestDirectionAndAddUp) {
  const auto prepared = six_beams();
  const diagnosis::Structure structure = prepared->structure();
  const diagnosis::Places places = diagnosis::find_places(
      structure, {.max_zones = 1, .max_nodes = 2, .moves = {}, .zone_centres = {}, .node_positions = {}});
  const diagnosis::Place& zone = places.sets.at("elements").at(0);
  const auto halves = diagnosis::halves_of(structure, places, zone);
  ASSERT_EQ(halves.size(), 2U);
  // Three beams each, with middles at 1.5 and 4.5 m, in either order.
  const auto& near = halves[0].x_m.y() < halves[1].x_m.y() ? halves[0] : halves[1];
  const auto& far = &near == &halves[0] ? halves[1] : halves[0];
  EXPECT_NEAR(near.x_m.y(), 1.5, 1e-12);
  EXPECT_NEAR(far.x_m.y(), 4.5, 1e-12);
  EXPECT_EQ(far.id, "element:15");  // the middle one of elements 14 to 16
  const MatrixXd sum = MatrixXd(near.stiffness.whole()) + MatrixXd(far.stiffness.whole());
  EXPECT_LT((sum - MatrixXd(zone.stiffness.whole())).norm(), 1e-12 * sum.norm());
  const MatrixXd mass = MatrixXd(near.mass.whole()) + MatrixXd(far.mass.whole());
  EXPECT_LT((mass - MatrixXd(zone.mass.whole())).norm(), 1e-12 * mass.norm());
  EXPECT_GT(mass.norm(), 0.0);
}

TEST(HalvesOf, AParameterKeepWhatSaysHowFarItMayChange) {
  const auto prepared = six_beams();
  const diagnosis::Structure structure = prepared->structure();
  const diagnosis::Places places = diagnosis::find_places(
      structure, {.max_zones = 1, .max_nodes = 2, .moves = {}, .zone_centres = {}, .node_positions = {}});
  const diagnosis::Place& modulus = places.sets.at("groups").at(0);
  const auto halves = diagnosis::halves_of(structure, places, modulus);
  ASSERT_EQ(halves.size(), 2U);
  for (const auto& half : halves) {
    EXPECT_DOUBLE_EQ(half.attributes.at("least_change"), 190.0 / 230.0);
    EXPECT_DOUBLE_EQ(half.attributes.at("most_change"), 230.0 / 190.0);
    EXPECT_DOUBLE_EQ(half.stiffness_law.ratio.value(Eigen::VectorXd::Constant(1, 220e9)), 220.0 / 210.0);
  }
  EXPECT_NE(halves[0].id, halves[1].id);
}

TEST(HalvesOf, AreNoneWhereEveryElementIsAPlaceAlready) {
  const auto prepared = six_beams();
  const diagnosis::Structure structure = prepared->structure();
  const diagnosis::Places places = diagnosis::find_places(structure, {});
  EXPECT_EQ(places.sets.at("elements").size(), 6U);
  EXPECT_TRUE(diagnosis::halves_of(structure, places, places.sets.at("groups").at(0)).empty());
}

TEST(HalvesOf, OneElementOrNoneAreNone) {
  const auto prepared = six_beams();
  const diagnosis::Structure structure = prepared->structure();
  diagnosis::Place place;
  EXPECT_TRUE(diagnosis::halves_of(structure, {}, place).empty());
  place.elements = {3};
  EXPECT_TRUE(diagnosis::halves_of(structure, {}, place).empty());
  place.elements = {3, 4};
  EXPECT_EQ(diagnosis::halves_of(structure, {}, place).size(), 2U);
  const auto matrices = row_of_nodes({1, 1});
  EXPECT_TRUE(diagnosis::halves_of(matrices->structure(), {}, place).empty());
}

}  // namespace
}  // namespace twindeck::tests
