// Oracles: E A/L n n' of a bar, Ernst's modulus and a string's first frequency by hand; unit forces along given lines; masses
// rho A L; sums of the parts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Place;
using diagnosis::Places;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kModulus = 165e9, kArea = 2e-3, kDensity = 8000.0, kPull = 2e5, kGravity = 10.0;

/// A beam of two elements along x, 8 m each; a stay from its far end to an anchor 9 m above and 12 m on: 15 m long.
fe::Model beam_with_stay() {
  fe::Model model = fe::test::with_steel();
  model.gravity_m_s2 = kGravity;
  model.prestress.rule = fe::PullRule::given;
  model.materials.push_back({"rope", kModulus, 60e9, 0.3, kDensity});
  fe::Section rope;
  rope.name = "rope";
  rope.area_m2 = kArea;
  model.sections.push_back(rope);
  for (int i = 0; i < 3; ++i) fe::test::add_node(model, 8.0 * i, 0.0, 0.0);
  const int anchor = fe::test::add_node(model, 28.0, 0.0, 9.0);
  for (int i = 0; i < 2; ++i) fe::test::add_element(model, fe::ElementType::beam, "girder", 0, 0, {i, i + 1});
  fe::Element& stay = fe::test::add_element(model, fe::ElementType::stay, "ropes", 1, 1, {anchor, 2});
  stay.name = "NE8";
  stay.pull_N = kPull;
  model.supports.push_back({"left", 0, {true, true, true, true, true, true}});
  model.supports.push_back({"anchor", anchor, {true, true, true, true, true, true}});
  return model;
}

fe::Spring spring_at(const std::string& name, const std::string& group, int node, const Vector3d& direction, double stiffness,
                     bool rotation = false) {
  fe::Spring spring;
  spring.name = name;
  spring.group = group;
  spring.node = node;
  spring.direction = direction;
  spring.stiffness = stiffness;
  spring.rotation = rotation;
  return spring;
}

fe::Spring damper_at(const std::string& name, const std::string& group, int node, const Vector3d& direction, double damping) {
  fe::Spring damper = spring_at(name, group, node, direction, 0.0);
  damper.damping = damping;
  return damper;
}

struct PlacesOf {
  std::shared_ptr<diagnosis::DiagnosedModel> prepared;
  diagnosis::Structure structure;
  Places places;

  explicit PlacesOf(const fe::Model& model, const diagnosis::PlaceOptions& options = {}) {
    matching::Channel channel;
    channel.name = "tip";
    channel.point = "3";
    channel.direction = Vector3d::UnitZ();
    prepared = diagnosis::prepare_model(dynamics::from_model(model), {channel}, 0.1);
    structure = prepared->structure();
    places = diagnosis::find_places(structure, options);
  }
  [[nodiscard]] const Place* place(const std::string& set, const std::string& id) const {
    const auto list = places.sets.find(set);
    if (list == places.sets.end()) return nullptr;
    for (const Place& place : list->second)
      if (place.id == id) return &place;
    return nullptr;
  }
  /// A vector over the free dofs that has these values at a node (number from 1), its rotations when asked for.
  [[nodiscard]] VectorXd at(int node, const Vector3d& values, bool rotation = false) const {
    VectorXd out = VectorXd::Zero(structure.system->size());
    for (std::size_t i = 0; i < structure.system->dofs.size(); ++i) {
      const fe::DofLabel& dof = structure.system->dofs[i];
      if (dof.node == std::to_string(node) && (dof.direction >= 3) == rotation)
        out[static_cast<Eigen::Index>(i)] = values[dof.direction % 3];
    }
    return out;
  }
};

void expect_matrix(const diagnosis::CompactMatrix& found, const MatrixXd& expected) {
  ASSERT_EQ(found.size(), expected.rows());
  EXPECT_LT((MatrixXd(found.whole()) - expected).norm(), 1e-9 * expected.norm());
}

TEST(StayPlaces, HaveErnstsModulusAndAStringsFrequency) {
  const PlacesOf found(beam_with_stay());
  const Place* stay = found.place("stays", "stay:NE8");
  ASSERT_NE(stay, nullptr);
  // E/(1 + (gamma l)² E/(12 sigma³)), l the horizontal projection of 12 m.
  const double sigma = kPull / kArea, weight = kDensity * kGravity * 12.0;
  const double modulus = kModulus / (1.0 + weight * weight * kModulus / (12.0 * std::pow(sigma, 3)));
  ASSERT_LT(modulus, 0.99 * kModulus);
  // The anchor is held by springs that stand for a rigid support: it is free.
  const Vector3d along(0.8, 0.0, 0.6);
  const VectorXd stretch = found.at(4, along) - found.at(3, along);
  expect_matrix(stay->stiffness, modulus * kArea / 15.0 * stretch * stretch.transpose());
  EXPECT_NEAR(stay->attributes.at("length"), 15.0, 1e-12);
  EXPECT_NEAR(stay->attributes.at("cable_mass"), kDensity * kArea * 15.0, 1e-9);
  EXPECT_NEAR(stay->attributes.at("pull"), kPull, 1e-6);
  EXPECT_NEAR(stay->attributes.at("f_cable"), std::sqrt(kPull / (kDensity * kArea)) / 30.0, 1e-9);
  EXPECT_LT((stay->x_m - Vector3d(22.0, 0.0, 4.5)).norm(), 1e-12);
  // Two unit forces across the chord at the lower end: in the vertical plane and beside it.
  const MatrixXd b = stay->directions;
  ASSERT_EQ(b.cols(), 2);
  const MatrixXd across = b * b.transpose(),
                 expected =
                     MatrixXd(found.at(3, Vector3d(-0.6, 0.0, 0.8)) * found.at(3, Vector3d(-0.6, 0.0, 0.8)).transpose()) +
                     MatrixXd(found.at(3, Vector3d::UnitY()) * found.at(3, Vector3d::UnitY()).transpose());
  EXPECT_LT((across - expected).norm(), 1e-12);
}

TEST(StayPlaces, WithoutAPullHaveNoFrequency) {
  fe::Model model = beam_with_stay();
  model.prestress.rule = fe::PullRule::none;
  model.elements[2].pull_N = 0.0;
  const PlacesOf found(model);
  const Place* stay = found.place("stays", "stay:NE8");
  ASSERT_NE(stay, nullptr);
  EXPECT_FALSE(stay->attributes.contains("f_cable"));
  const VectorXd stretch = found.at(4, Vector3d(0.8, 0.0, 0.6)) - found.at(3, Vector3d(0.8, 0.0, 0.6));
  expect_matrix(stay->stiffness, kModulus * kArea / 15.0 * stretch * stretch.transpose());
}

TEST(DamperPlaces, AreUnitForcesAlongTheirLines) {
  fe::Model model = beam_with_stay();
  model.springs = {damper_at("C1", "make", 1, Vector3d(0.6, 0.0, 0.8), 500.0),
                   damper_at("C2", "make", 2, Vector3d::UnitZ(), 500.0), damper_at("C3", "other", 2, Vector3d::UnitY(), 0.0),
                   damper_at("C4", "", 1, Vector3d::UnitZ(), 70.0)};
  model.springs[1].node2 = 1;
  model.springs[1].stiffness = 3e4;
  model.springs[1].series = true;
  model.springs[2].friction_N = 900.0;
  model.springs[2].stiffness = 1e5;
  model.springs[3].active = false;
  const PlacesOf found(model);
  ASSERT_EQ(found.places.sets.at("dampers").size(), 4u);
  const auto line = [&](const char* id) { return MatrixXd(found.place("dampers", id)->directions); };
  const auto is_along = [&](const char* id, const VectorXd& expected) {  // of either sign
    const MatrixXd b = line(id);
    ASSERT_EQ(b.cols(), 1);
    EXPECT_LT((b * b.transpose() - expected * expected.transpose()).norm(), 1e-12) << id;
  };
  is_along("damper:C1", found.at(2, Vector3d(0.6, 0.0, 0.8)));
  is_along("damper:C2", found.at(3, Vector3d::UnitZ()) - found.at(2, Vector3d::UnitZ()));
  is_along("damper:C3", found.at(3, Vector3d::UnitY()));
  const auto number = [&](const char* id, const char* name) { return found.place("dampers", id)->attributes.at(name); };
  EXPECT_EQ(number("damper:C2", "damping"), 500.0);
  EXPECT_EQ(number("damper:C2", "stiffness"), 3e4);
  EXPECT_EQ(number("damper:C2", "series"), 1.0);
  EXPECT_EQ(number("damper:C1", "series"), 0.0);
  EXPECT_EQ(number("damper:C3", "friction"), 900.0);
  EXPECT_FALSE(found.place("dampers", "damper:C1")->attributes.contains("friction"));
  EXPECT_EQ(number("damper:C4", "always_on"), 0.0);
  EXPECT_EQ(number("damper:C1", "always_on"), 1.0);
  // Two of a make are a type; one alone is none, nor is one without a make.
  ASSERT_EQ(found.places.sets.at("damper_types").size(), 1u);
  const Place& type = found.places.sets.at("damper_types").front();
  EXPECT_EQ(type.id, "dampers:C1,C2");
  EXPECT_LT((type.x_m - Vector3d(12.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(type.attributes.at("type"), number("damper:C1", "type"));
  EXPECT_NE(type.attributes.at("type"), number("damper:C3", "type"));
}

TEST(DamperMoves, PutTheLineToTheNearestNode) {
  fe::Model model = beam_with_stay();
  model.springs = {damper_at("C1", "make", 1, Vector3d(0.6, 0.0, 0.8), 500.0),
                   damper_at("C2", "make", 2, Vector3d::UnitZ(), 500.0)};
  diagnosis::PlaceOptions options;
  options.moves = {{"swapped", {"C1", "C2"}, {Vector3d(15.0, 1.0, 0.0), Vector3d(7.0, 0.0, -1.0)}}};
  const PlacesOf found(model, options);
  const Place* move = found.place("damper_moves", "dampers:C1,C2@swapped");
  ASSERT_NE(move, nullptr);
  const MatrixXd b = move->directions;
  ASSERT_EQ(b.cols(), 2);
  EXPECT_LT((b.col(0) - found.at(3, Vector3d(0.6, 0.0, 0.8))).norm(), 1e-12);
  EXPECT_LT((b.col(1) - found.at(2, Vector3d::UnitZ())).norm(), 1e-12);
  EXPECT_EQ(move->attributes.at("node_0"), 2.0);
  EXPECT_EQ(move->attributes.at("node_1"), 1.0);
  EXPECT_LT((move->x_m - Vector3d(12.0, 0.0, 0.0)).norm(), 1e-12);
}

TEST(SupportPlaces, AreTheirSpringsInDisplacementsAndInRotations) {
  fe::Model model = beam_with_stay();
  model.springs = {spring_at("pad_z", "pad", 1, Vector3d::UnitZ(), 5e6), spring_at("pad_x", "pad", 1, Vector3d::UnitX(), 2e6),
                   spring_at("pad_ry", "pad", 1, Vector3d::UnitY(), 7e6, true),
                   damper_at("C1", "pad", 1, Vector3d::UnitY(), 50.0), spring_at("between", "pad", 2, Vector3d::UnitZ(), 4e5)};
  model.springs[4].node2 = 1;  // no support
  model.supports.push_back({"pad", 1, {false, true, false, false, false, false}});
  const PlacesOf found(model);
  const Place *pad = found.place("supports", "support:pad"), *fixed = found.place("supports", "support:pad fixed"),
              *turning = found.place("foundations", "support:pad"), *left = found.place("supports", "support:left");
  ASSERT_TRUE(pad != nullptr && fixed != nullptr && turning != nullptr && left != nullptr);
  const VectorXd z = found.at(2, Vector3d::UnitZ()), x = found.at(2, Vector3d::UnitX()), y = found.at(2, Vector3d::UnitY()),
                 ry = found.at(2, Vector3d::UnitY(), true);
  expect_matrix(pad->stiffness, 5e6 * z * z.transpose() + 2e6 * x * x.transpose());
  expect_matrix(turning->stiffness, 7e6 * ry * ry.transpose());
  // What is rigid under the same name is a place of its own, in y alone.
  const MatrixXd rigid = fixed->stiffness.whole();
  const double held = y.dot(rigid * y);
  EXPECT_GT(held, 1e9);
  EXPECT_LT((rigid - held * y * y.transpose()).norm(), 1e-12 * held);
  // A bearing may err both ways; a rigid support must fall by orders.
  EXPECT_GT(pad->attributes.at("f_high"), 1.0);
  for (const Place* place : {fixed, left}) EXPECT_LT(place->attributes.at("f_high"), 0.1) << place->id;
  EXPECT_LT((pad->x_m - Vector3d(8.0, 0.0, 0.0)).norm(), 1e-12);
}

TEST(SupportPlaces, BearingsOfOneGroupAreOneTogetherAndOneEach) {
  fe::Model model = beam_with_stay();
  model.springs = {spring_at("pad_1", "pads", 1, Vector3d::UnitZ(), 5e6),
                   spring_at("pad_2", "pads", 2, Vector3d::UnitZ(), 3e6)};
  const PlacesOf found(model);
  const auto bearing = [&](int node) {
    return found.place("supports", fmt::format("support:pads at node {}", model.nodes[static_cast<std::size_t>(node)].id));
  };
  const Place *all = found.place("supports", "support:pads"), *first = bearing(1), *second = bearing(2);
  ASSERT_TRUE(all != nullptr && first != nullptr && second != nullptr);
  const VectorXd one = found.at(2, Vector3d::UnitZ()), other = found.at(3, Vector3d::UnitZ());
  expect_matrix(all->stiffness, 5e6 * one * one.transpose() + 3e6 * other * other.transpose());
  expect_matrix(first->stiffness, 5e6 * one * one.transpose());
  expect_matrix(second->stiffness, 3e6 * other * other.transpose());
  EXPECT_LT((second->x_m - model.nodes[2].x_m).norm(), 1e-12);
  // Each bearing has an error of its own, all together none besides.
  EXPECT_TRUE(all->attributes.contains(diagnosis::kSeveralBearings));
  EXPECT_FALSE(first->attributes.contains(diagnosis::kSeveralBearings));
  EXPECT_TRUE(first->attributes.contains(diagnosis::kOneBearing));
  EXPECT_FALSE(all->attributes.contains(diagnosis::kOneBearing));
}

TEST(GroupPlaces, OfElementsAndOfSpringsBetweenNodes) {
  fe::Model model = beam_with_stay();
  model.springs = {spring_at("hinge", "joints", 1, Vector3d::UnitX(), 3e6),
                   spring_at("to_ground", "pad", 1, Vector3d::UnitZ(), 5e6)};
  model.springs[0].node2 = 2;
  const PlacesOf found(model);
  const VectorXd apart = found.at(2, Vector3d::UnitX()) - found.at(3, Vector3d::UnitX());
  const Place* joints = found.place("groups", "group:joints");
  ASSERT_NE(joints, nullptr);
  expect_matrix(joints->stiffness, 3e6 * apart * apart.transpose());
  EXPECT_EQ(joints->mass.size(), 0);
  EXPECT_EQ(found.place("groups", "group:pad"), nullptr);  // a support is none
  const Place *girder = found.place("groups", "group:girder"), *ropes = found.place("groups", "group:ropes");
  ASSERT_TRUE(girder != nullptr && ropes != nullptr);
  EXPECT_EQ(girder->elements, (std::vector<int>{0, 1}));
  EXPECT_LT((girder->x_m - Vector3d(8.0, 0.0, 0.0)).norm(), 1e-12);  // mean of the ends 0, 8, 8 and 16
  expect_matrix(ropes->stiffness, found.place("stays", "stay:NE8")->stiffness.whole());
  // The girder's mass moves with a unit displacement: 8000 kg/m3, 0.01 m2, 16 m.
  VectorXd up = VectorXd::Zero(apart.size());
  for (int node = 1; node <= 3; ++node) up += found.at(node, Vector3d::UnitZ());
  EXPECT_NEAR(up.dot(girder->mass.whole() * up), 8000.0 * 0.01 * 16.0, 1e-6);
}

TEST(GroupPlaces, ThatAParameterScalesAreThatParametersAlone) {
  fe::Model model = beam_with_stay();
  model.parameters.push_back({"E_girder", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 180e9, 220e9});
  const PlacesOf found(model);
  EXPECT_NE(found.place("groups", "group:E_girder"), nullptr);
  EXPECT_EQ(found.place("groups", "group:girder"), nullptr);
  EXPECT_NE(found.place("groups", "group:ropes"), nullptr);
}

TEST(ElementZones, AddUpToTheStructureWithoutItsStays) {
  const PlacesOf found(beam_with_stay());
  const auto& zones = found.places.sets.at("elements");
  ASSERT_EQ(zones.size(), 2u);
  MatrixXd stiffness = MatrixXd::Zero(found.structure.system->size(), found.structure.system->size()), mass = stiffness;
  for (const Place& zone : zones) {
    stiffness += MatrixXd(zone.stiffness.whole());
    mass += MatrixXd(zone.mass.whole());
  }
  const Place& global = found.places.sets.at("global").front();
  expect_matrix(global.stiffness, stiffness);
  expect_matrix(global.mass, mass);
  EXPECT_NEAR(global.attributes.at("deck_mass"), 8000.0 * 0.01 * 16.0, 1e-6);
  // Each is a beam: 8 m along x are E A/8 against a displacement of its ends apart.
  const VectorXd tip = found.at(3, Vector3d::UnitX());
  const Place* second = found.place("elements", "element:2");
  ASSERT_NE(second, nullptr);
  EXPECT_NEAR(tip.dot(second->stiffness.whole() * tip), 200e9 * 0.01 / 8.0, 1.0);
  EXPECT_LT((second->x_m - Vector3d(12.0, 0.0, 0.0)).norm(), 1e-12);
}

// Zones are chosen far from each other, which is another order than that of the elements.
TEST(ElementZones, OfEachElementAreInItsMiddle) {
  fe::Model model = fe::test::with_steel();
  for (int i = 0; i < 8; ++i) fe::test::add_node(model, 2.0 * i, 0.0, 0.0);
  for (int i = 0; i < 7; ++i) fe::test::add_element(model, fe::ElementType::beam, "girder", 0, 0, {i, i + 1});
  model.supports.push_back({"left", 0, {true, true, true, true, true, true}});
  const PlacesOf found(model);
  for (int i = 0; i < 7; ++i) {
    const Place* element = found.place("elements", "element:" + std::to_string(i + 1));
    ASSERT_NE(element, nullptr) << i;
    EXPECT_LT((element->x_m - Vector3d(2.0 * i + 1.0, 0.0, 0.0)).norm(), 1e-12) << i;
  }
}

// An upright spring to the ground is a bearing; one along the deck leaves the node free to be held.
TEST(NodePlaces, KnowTheBearingBelowThem) {
  fe::Model model = beam_with_stay();
  model.springs = {spring_at("pad_z", "pad", 1, Vector3d::UnitZ(), 5e6), spring_at("stop", "stop", 2, Vector3d::UnitX(), 2e6)};
  const PlacesOf found(model);
  const auto supported = [&](int node) {
    return found.place("nodes", "node:" + std::to_string(model.nodes[static_cast<std::size_t>(node)].id))
        ->attributes.contains("supported");
  };
  EXPECT_TRUE(supported(1));
  EXPECT_FALSE(supported(2));
}

// A slab is the deck where there is one: 10 m x 4 m x 0.1 m of 2400 kg/m3; its beams are not.
TEST(GlobalPlace, HasTheMassOfTheSlabs) {
  fe::Model model = fe::test::with_steel();
  model.materials.push_back({"concrete", 30e9, 12.5e9, 0.2, 2400.0});
  fe::Section slab;
  slab.name = "slab";
  slab.thickness_m = 0.1;
  model.sections.push_back(slab);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {0.0, 4.0}}) fe::test::add_node(model, x, y, 0.0);
  fe::test::add_element(model, fe::ElementType::shell, "slab", 1, 1, {0, 1, 2, 3});
  fe::test::add_element(model, fe::ElementType::beam, "edge", 0, 0, {0, 1});
  model.supports.push_back({"left", 0, {true, true, true, true, true, true}});
  model.supports.push_back({"far", 3, {true, true, true, true, true, true}});
  for (const auto drilling : {fe::Formulation::Drilling::penalty, fe::Formulation::Drilling::diagonal}) {
    model.formulation.drilling = drilling;
    const PlacesOf found(model);
    const Place& global = found.places.sets.at("global").front();
    EXPECT_NEAR(global.attributes.at("deck_mass"), 10.0 * 4.0 * 0.1 * 2400.0, 1e-6);
    // Stiffness is that of all: what the whole structure has less the springs of its supports.
    MatrixXd k = MatrixXd(found.structure.system->stiffness(found.structure.theta)).selfadjointView<Eigen::Lower>();
    for (const char* set : {"supports", "foundations"})
      for (const Place& support : found.places.sets.at(set)) k -= MatrixXd(support.stiffness.whole());
    EXPECT_LT((MatrixXd(global.stiffness.whole()) - k).norm(), 1e-9 * MatrixXd(global.stiffness.whole()).norm());
  }
}

}  // namespace
}  // namespace twindeck::tests
