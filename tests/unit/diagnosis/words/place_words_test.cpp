// Places in words. Oracle: the names and coordinates that the made-up models below were given.
#include "diagnosis/words/place_words.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

using diagnosis::PlaceWords;
using Eigen::Vector3d;

matching::Channel sensor(const std::string& name, const std::string& point, std::optional<Vector3d> x = {}) {
  matching::Channel channel;
  channel.name = name;
  channel.point = point;
  channel.x_m = x;
  return channel;
}

fe::Spring spring(const std::string& name, const std::string& group, int node) {
  fe::Spring out;
  out.name = name;
  out.group = group;
  out.node = node;
  out.stiffness = 1e8;
  return out;
}

/// 40 m along x in eight beams of group "deck", a pier at 20 m, feet at both ends, a damper at 30 m, one support without a name
/// at 10 m.
fe::Model girder() {
  fe::Model model;
  model.materials.push_back({"steel", 210e9, 80e9, 0.3, 7850.0});
  for (int i = 0; i <= 8; ++i) model.nodes.push_back({100 + i, Vector3d(5.0 * i, 0.0, 0.0)});
  for (int i = 0; i < 8; ++i) {
    fe::Element beam;
    beam.id = i + 1;
    beam.group = "deck";
    beam.material = 0;
    beam.nodes = {i, i + 1};
    model.elements.push_back(beam);
  }
  model.springs = {spring("pier_z", "pier_W", 4), spring("foot_1", "foot", 0), spring("foot_2", "foot", 8),
                   spring("node_102_rigid_z", "node_102", 2)};
  fe::Spring damper = spring("D1", "damper_D", 6);
  damper.damping = 1e4;
  model.springs.push_back(damper);
  fe::Parameter modulus;
  modulus.name = "E_s";
  modulus.target = fe::Target::youngs_modulus;
  modulus.of = {"steel"};
  fe::Parameter bearing;
  bearing.name = "k_pier";
  bearing.target = fe::Target::spring_stiffness;
  bearing.of = {"pier_W"};
  model.parameters = {modulus, bearing};
  return model;
}

TEST(PlaceWords, APointOfTheGirderIsItsPartItsCoordinateAndWhatIsNear) {
  const fe::Model model = girder();
  const diagnosis::Places none;
  const PlaceWords words(&model, {}, {sensor("A5", "P5", Vector3d(35.0, 0.0, 0.0))}, none);
  EXPECT_EQ(words.at("node:107").words, "the deck at x = 35 m (node 107, at the sensor A5)");
  EXPECT_EQ(words.at("node:104").words, "the deck at x = 20 m (node 104, at the support pier_W)");
  EXPECT_EQ(words.at("node:101").words, "the deck at x = 5 m (node 101)");  // 5 m from anything: no help to name it
  EXPECT_DOUBLE_EQ(words.at("node:107").x_m.x(), 35.0);
  EXPECT_EQ(words.at("nodes:101,103").words, "the deck at x = 5 m (node 101) and the deck at x = 15 m (node 103)");
  EXPECT_DOUBLE_EQ(words.at("nodes:101,103").x_m.x(), 10.0);
}

TEST(PlaceWords, ASensorBesideANodeIsTheDistanceAway) {
  const fe::Model model = girder();
  const diagnosis::Places none;
  const PlaceWords words(&model, {}, {sensor("A5", "", Vector3d(36.5, 0.0, 2.0))}, none);
  EXPECT_EQ(words.at("node:107").words, "the deck at x = 35 m (node 107, 2.5 m from the sensor A5)");
}

TEST(PlaceWords, SupportsAreCalledAsTheUserCalledThem) {
  const fe::Model model = girder();
  const diagnosis::Places none;
  const PlaceWords words(&model, {}, {}, none);
  EXPECT_EQ(words.at("support:pier_W").words, "the support pier_W at x = 20 m");
  EXPECT_DOUBLE_EQ(words.at("support:pier_W").x_m.x(), 20.0);
  EXPECT_EQ(words.at("support:foot").words, "the support foot at x = 0 m and at x = 40 m");
  EXPECT_EQ(words.at("support:foot at node 108").words, "the support foot at node 108 at x = 40 m");
  EXPECT_TRUE(std::isnan(words.at("support:foot").x_m.x()));  // two ends of the bridge have no middle to look at
  EXPECT_EQ(words.at("support:node_102").words, "the support of the deck at x = 10 m (node 102)");
}

TEST(PlaceWords, GroupsSayWhatTheyAre) {
  const fe::Model model = girder();
  const diagnosis::Places none;
  const PlaceWords words(&model, {}, {}, none);
  EXPECT_EQ(words.at("group:E_s").words, "what is of steel (parameter E_s)");
  EXPECT_EQ(words.at("group:k_pier").words, "the springs pier_W at x = 20 m (parameter k_pier)");
  EXPECT_EQ(words.at("group:deck").words, "the group deck");
  EXPECT_EQ(words.at("group:pier_W").words, "the group pier_W at x = 20 m");
}

TEST(PlaceWords, ZonesDampersSensorsModes) {
  const fe::Model model = girder();
  diagnosis::Places places;
  diagnosis::Place zone;
  zone.id = "element:3";
  zone.x_m = Vector3d(12.5, 0.0, 0.0);
  zone.elements = {1, 2, 3};
  diagnosis::Place single;
  single.id = "element:4";
  single.x_m = Vector3d(17.5, 0.0, 0.0);
  single.elements = {3};
  diagnosis::Place of_all_groups = zone;
  of_all_groups.id = "zone:3";
  places.sets["elements"] = {zone, single};
  places.sets["zones"] = {of_all_groups};
  const PlaceWords words(&model, {}, {sensor("A1", "", Vector3d(5.0, 0.0, 0.0)), sensor("A2", "102")}, places);
  EXPECT_EQ(words.at("element:3").words, "the deck round x = 12.5 m, 2.5 m from the sensor A2");
  EXPECT_EQ(words.at("zone:3").words, "the structure round x = 12.5 m, 2.5 m from the sensor A2");
  EXPECT_EQ(words.at("element:4").words, "the deck at x = 17.5 m (element 4, 2.5 m from the support pier_W)");
  EXPECT_EQ(words.at("damper:D1").words, "the damper D1 at x = 30 m");
  EXPECT_EQ(words.at("channel:A1").words, "the sensor A1 at x = 5 m");
  EXPECT_EQ(words.at("channel:A2").words, "the sensor A2 at x = 10 m");
  EXPECT_EQ(words.at("channels:A1,A2").words, "the sensors A1 and A2");
  EXPECT_EQ(words.at("mode:3").words, "mode 3");
  EXPECT_EQ(words.at("global").words, "the whole structure");
}

TEST(PlaceWords, AStayIsFoundAtItsLowerEnd) {
  fe::Model model = girder();
  model.nodes.push_back({200, Vector3d(20.0, 0.0, 15.0)});
  fe::Element stay;
  stay.id = 50;
  stay.type = fe::ElementType::stay;
  stay.name = "NE5";
  stay.material = 0;
  stay.nodes = {9, 7};
  model.elements.push_back(stay);
  const diagnosis::Places none;
  const PlaceWords words(&model, {}, {}, none);
  EXPECT_EQ(words.at("stay:NE5").words, "the stay NE5, anchored at x = 35 m, z = 0 m");
  EXPECT_EQ(words.at("node:107").words, "the deck at x = 35 m, z = 0 m (node 107, at the anchorage of the stay NE5)");
}

TEST(PlaceWords, AMatrixModelWithoutCoordinatesHasNamesAlone) {
  std::vector<fe::DofLabel> dofs;
  for (const char* name : {"1", "2", "3"}) dofs.push_back({name, 0, Vector3d::Constant(std::nan(""))});
  const diagnosis::Places none;
  const PlaceWords words(nullptr, dofs, {sensor("c2", "2")}, none);
  EXPECT_EQ(words.at("node:1").words, "node 1");
  EXPECT_EQ(words.at("node:2").words, "node 2, at the sensor c2");
  EXPECT_EQ(words.at("nodes:1,3").words, "node 1 and node 3");
  EXPECT_EQ(words.at("group:g5").words, "the group g5");
  EXPECT_EQ(words.at("channel:c2").words, "the sensor c2");
  EXPECT_TRUE(std::isnan(words.at("node:1").x_m.x()));
}

TEST(PlaceWords, OfAFrameOfHalfAMetreAreToldInMillimetres) {
  std::vector<fe::DofLabel> dofs;
  for (int i = 0; i < 4; ++i) dofs.push_back({std::to_string(i + 1), 0, Vector3d(0.0, 0.0, 0.1875 * i)});
  const diagnosis::Places none;
  const PlaceWords words(nullptr, dofs, {}, none);
  EXPECT_EQ(words.at("node:2").words, "node 2 at z = 0.188 m");
}

}  // namespace
}  // namespace twindeck::tests
