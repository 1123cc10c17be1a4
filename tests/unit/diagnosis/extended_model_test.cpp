// Causes put into a model of elements. Oracle: frequencies of hand-written matrices that have the cause in them, by a dense
// solve.
#include "diagnosis/extended_model.hpp"

#include <gtest/gtest.h>

#include "fe/assembly_parameters.hpp"
#include "fe/validate.hpp"
#include "unit/diagnosis/found_causes.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::DiagnosedModel;
using diagnosis::ExtendedModel;
using diagnosis::Place;
using diagnosis::Places;
using diagnosis::ReducedPlace;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Two masses in a row on x behind a wall: node 30 (wall), bar 7 (group "left"), node 20, bar 8 (group "right") beside the
/// buffer, node 10, which the pier holds. Lumped masses. Ids fall along the line, so that no id is a position.
struct Line {
  static constexpr double kArea = 2e-3, kModulus = 2e11, kDensity = 7800.0, kLeft = 2.0, kRight = 4.0;
  double left = kModulus * kArea / kLeft, right = kModulus * kArea / kRight, buffer = 3e7, pier = 5e7;  // [N/m]
  double left_kg = kDensity * kArea * kLeft, right_kg = kDensity * kArea * kRight;
  double near = 900.0, far = 400.0;     // [kg] at nodes 20 and 10
  double near_ground = 0.0, tie = 0.0;  // [N/m] node 20 to the ground, and to node 10

  [[nodiscard]] fe::Model model() const {
    fe::Model m;
    m.source = "line";
    m.formulation.lumped_mass = true;
    m.nodes = {{30, {0.0, 0.0, 0.0}}, {20, {kLeft, 0.0, 0.0}}, {10, {kLeft + kRight, 0.0, 0.0}}};
    m.materials = {{"steel", kModulus, kModulus / 2.6, 0.3, kDensity}};
    fe::Section section;
    section.name = "rod";
    section.area_m2 = kArea;
    m.sections = {section};
    for (int e = 0; e < 2; ++e) {
      fe::Element bar;
      bar.id = 7 + e;
      bar.type = fe::ElementType::bar;
      bar.group = e == 0 ? "left" : "right";
      bar.material = bar.section = 0;
      bar.nodes = {e, e + 1};
      m.elements.push_back(bar);
    }
    m.masses = {{"near", 1, near, Vector3d::Zero()}, {"far", 2, far, Vector3d::Zero()}};
    m.springs = {spring("stop", "buffer", 1, 2, buffer), spring("shoe", "pier", 2, -1, pier)};
    m.supports = {{"wall", 0, {true, true, true, true, true, true}},
                  {"rail_20", 1, {false, true, true, true, true, true}},
                  {"rail_10", 2, {false, true, true, true, true, true}}};
    return m;
  }
  [[nodiscard]] VectorXd hertz() const {
    const double between = right + buffer + tie;
    Eigen::Matrix2d k, m;
    k << left + between + near_ground, -between, -between, between + pier;
    m << near + 0.5 * (left_kg + right_kg), 0.0, 0.0, far + 0.5 * right_kg;
    return dense_hertz(k, m);
  }
};

/// The line with causes in it; its frequencies are those of `expected`.
class InTheLine {
 public:
  explicit InTheLine(fe::Model model = Line().model(), const diagnosis::PlaceOptions& options = {})
      : prepared(ready(std::move(model))), places(diagnosis::find_places(prepared.structure(), options)) {}
  ExtendedModel with(const std::vector<const At*>& causes, const VectorXd& theta = {}) const {
    return diagnosis::extended_model(prepared, places, diagnosis_with(causes, theta));
  }
  void expect(const At& cause, const Line& expected) const {
    const ExtendedModel out = with({&cause});
    ASSERT_EQ(out.holds, std::vector<bool>{true});
    ASSERT_TRUE(out.elements.has_value());
    expect_close(model_hertz(*out.elements, 2), expected.hertz());
  }
  DiagnosedModel prepared;
  Places places;
};

TEST(ExtendedModel, WithoutCausesIsTheModel) {
  const ExtendedModel out = InTheLine().with({});
  EXPECT_TRUE(out.holds.empty());
  expect_close(model_hertz(*out.elements, 2), Line().hertz());
}

TEST(ExtendedModel, AnElementIsSoftOrHeavyAlone) {
  const InTheLine line;
  Line soft;
  soft.right *= 0.4;
  line.expect(At("scale.stiffness", {{"factor", 0.4}}, "elements", "element:8"), soft);
  Line heavy;
  heavy.left_kg *= 30.0;
  line.expect(At("scale.mass", {{"factor", 30.0}}, "elements", "element:7"), heavy);
}

TEST(ExtendedModel, ElementsOfACauseShareOneMaterialOfTheirOwn) {
  InTheLine line;
  line.places.sets["elements"] = {Place{"element:8", Vector3d::Zero(), {}, {}, {}, {}, {0, 1}}};
  const At soft("scale.stiffness", {{"factor", 0.5}}, "elements", "element:8");
  const ExtendedModel out = line.with({&soft});
  ASSERT_EQ(out.elements->materials.size(), 2U);
  EXPECT_EQ(out.elements->materials[1].name, "steel_h_8");
  EXPECT_EQ(out.elements->materials[0].youngs_modulus_Pa, Line::kModulus);
  EXPECT_EQ(out.elements->materials[1].shear_modulus_Pa, 0.5 * Line::kModulus / 2.6);
  EXPECT_EQ(out.elements->materials[1].density_kg_m3, Line::kDensity);
  Line both;
  both.left *= 0.5;
  both.right *= 0.5;
  expect_close(model_hertz(*out.elements, 2), both.hertz());
}

TEST(ExtendedModel, AGroupIsItsElementsAndTheSpringsBetweenNodes) {
  fe::Model model = Line().model();
  for (fe::Spring& s : model.springs) s.group = "right";  // the shoe to the ground is a support, not of the group
  const InTheLine line(std::move(model));
  Line soft;
  soft.right *= 0.3;
  soft.buffer *= 0.3;
  line.expect(At("scale.stiffness", {{"factor", 0.3}}, "groups", "group:right"), soft);
  Line heavy;
  heavy.right_kg *= 20.0;
  line.expect(At("scale.mass", {{"factor", 20.0}}, "groups", "group:right"), heavy);
}

fe::Model with_modulus(fe::Model model) {
  model.parameters = {
      {"E", fe::Target::youngs_modulus, {"steel"}, "Pa", Line::kModulus, 0.9 * Line::kModulus, 1.1 * Line::kModulus}};
  return model;
}

TEST(ExtendedModel, AGroupOfAParameterIsItsValue) {
  // The fit has 5 % more than the model, the cause 40 % less than the fit.
  const InTheLine line(with_modulus(Line().model()));
  const At soft("scale.stiffness", {{"factor", 0.6}}, "groups", "group:E");
  const ExtendedModel out = line.with({&soft}, VectorXd::Constant(1, 1.05 * Line::kModulus));
  Line expected;
  expected.left *= 0.6 * 1.05;
  expected.right *= 0.6 * 1.05;
  expect_close(model_hertz(*out.elements, 2), expected.hertz());
  const fe::Parameter& e = out.elements->parameters.at(0);
  EXPECT_NEAR(e.initial, 0.63 * Line::kModulus, 1.0);
  EXPECT_EQ(e.lower, e.initial);  // bounds hold it
  EXPECT_EQ(e.upper, 1.1 * Line::kModulus);
  const At stiff("scale.stiffness", {{"factor", 2.0}}, "groups", "group:E");
  const fe::Parameter high = line.with({&stiff}).elements->parameters.at(0);
  EXPECT_EQ(high.upper, 2.0 * Line::kModulus);
  EXPECT_EQ(high.lower, 0.9 * Line::kModulus);
}

TEST(ExtendedModel, TheFitIsInTheModelWithoutACauseToo) {
  const InTheLine line(with_modulus(Line().model()));
  Line expected;
  expected.left *= 1.05;
  expected.right *= 1.05;
  expect_close(model_hertz(*line.with({}, VectorXd::Constant(1, 1.05 * Line::kModulus)).elements, 2), expected.hertz());
}

TEST(ExtendedModel, AParameterAndAnElementOfItAreBothInIt) {
  // In whatever order they were found: the soft element is of the softer material.
  const InTheLine line(with_modulus(Line().model()));
  const At all("scale.stiffness", {{"factor", 0.6}}, "groups", "group:E"),
      one("scale.stiffness", {{"factor", 0.5}}, "elements", "element:8");
  Line expected;
  expected.left *= 0.6;
  expected.right *= 0.6 * 0.5;
  expect_close(model_hertz(*line.with({&all, &one}).elements, 2), expected.hertz());
  expect_close(model_hertz(*line.with({&one, &all}).elements, 2), expected.hertz());
}

TEST(ExtendedModel, AMaterialOfACauseGoesOnWithItsParameters) {
  // Whoever updates the extended model moves the soft element with the rest of its steel.
  fe::Model model = with_modulus(Line().model());
  model.parameters.push_back({"rho", fe::Target::density, {"steel"}, "kg/m3", Line::kDensity, 7000.0, 8500.0});
  const InTheLine line(std::move(model));
  const At soft("scale.stiffness", {{"factor", 0.5}}, "elements", "element:8");
  const ExtendedModel out = line.with({&soft});
  for (const fe::Parameter& parameter : out.elements->parameters)
    EXPECT_EQ(parameter.of, (std::vector<std::string>{"steel", "steel_h_8"})) << parameter.name;
  Line expected;
  expected.left *= 1.05;
  expected.right *= 1.05 * 0.5;
  const fe::Model updated = fe::with_parameters(*out.elements, Eigen::Vector2d(1.05 * Line::kModulus, Line::kDensity));
  expect_close(model_hertz(updated, 2), expected.hertz());
}

TEST(ExtendedModel, AnAreaHasMassToo) {
  // The stiffness of a part cannot be said by a parameter that its mass follows.
  fe::Model model = Line().model();
  model.parameters = {{"A", fe::Target::area, {"rod"}, "m2", Line::kArea, 0.9 * Line::kArea, 1.1 * Line::kArea}};
  const InTheLine line(std::move(model));
  const At soft("scale.stiffness", {{"factor", 0.6}}, "groups", "group:A");
  const ExtendedModel out = line.with({&soft});
  EXPECT_EQ(out.holds, std::vector<bool>{false});
}

TEST(ExtendedModel, ASupportIsItsSpringsToTheGround) {
  fe::Model model = Line().model();
  model.springs[0].group = "pier";  // between nodes: not of the support
  const InTheLine line(std::move(model));
  Line soft;
  soft.pier *= 0.2;
  line.expect(At("scale.stiffness", {{"factor", 0.2}}, "supports", "support:pier"), soft);
}

TEST(ExtendedModel, ASupportWithoutAGroupHasItsSpringsName) {
  fe::Model model = Line().model();
  model.springs[1].group = "";
  const InTheLine line(std::move(model));
  Line soft;
  soft.pier *= 0.2;
  line.expect(At("scale.stiffness", {{"factor", 0.2}}, "supports", "support:shoe"), soft);
}

TEST(ExtendedModel, OneOfSeveralBearingsIsTheSpringsOfItsNode) {
  fe::Model model = Line().model();
  model.springs.push_back(spring("shoe_20", "pier", 1, -1, 3e7));
  const InTheLine line(std::move(model));
  Line soft;
  soft.near_ground = 3e7;
  soft.pier *= 0.2;
  line.expect(At("scale.stiffness", {{"factor", 0.2}}, "supports", "support:pier at node 10"), soft);
}

TEST(ExtendedModel, ADamperBesideASupportIsNoneOfIt) {
  fe::Model model = Line().model();
  fe::Spring damper = spring("D", "pier", 1, -1, 4e7);
  damper.damping = 1e4;
  model.springs.push_back(damper);
  const InTheLine line(std::move(model));
  Line soft;
  soft.near_ground = 4e7;
  soft.pier *= 0.2;
  line.expect(At("scale.stiffness", {{"factor", 0.2}}, "supports", "support:pier"), soft);
}

TEST(ExtendedModel, AStayIsSoftByItsMaterial) {
  fe::Model model = Line().model();
  model.elements[1].type = fe::ElementType::stay;
  model.elements[1].name = "S1";
  const InTheLine line(std::move(model));
  Line soft;
  soft.right *= 0.7;
  line.expect(At("scale.stiffness", {{"factor", 0.7}}, "stays", "stay:S1"), soft);
}

fe::Model with_dampers() {
  fe::Model model = Line().model();
  for (const char* name : {"D1", "D11", "D2"}) {
    fe::Spring damper = spring(name, "make", 1, -1, 0.0);
    damper.damping = 1000.0;
    model.springs.push_back(damper);
  }
  return model;
}

TEST(ExtendedModel, DampersHaveTheirOtherLaw) {
  const InTheLine line(with_dampers());
  const auto dampers = [&](const At& cause) {
    const ExtendedModel out = line.with({&cause});
    EXPECT_EQ(out.holds, std::vector<bool>{true});
    std::map<std::string, fe::Spring> named;
    for (const fe::Spring& s : out.elements->springs) named[s.name] = s;
    EXPECT_EQ(named.size(), out.elements->springs.size());
    return named;
  };
  auto now = dampers(At("damper.damping", {{"factor", 0.25}}, "damper_types", "dampers:D1,D2"));
  EXPECT_EQ(now.at("D1").damping, 250.0);
  EXPECT_EQ(now.at("D2").damping, 250.0);
  EXPECT_EQ(now.at("D11").damping, 1000.0);  // a longer name
  now = dampers(At("damper.series", {{"stiffness", 6e6}}, "dampers", "damper:D2"));
  EXPECT_TRUE(now.at("D2").series);
  EXPECT_EQ(now.at("D2").stiffness, 6e6);
  EXPECT_EQ(now.at("D2").damping, 1000.0);
  EXPECT_EQ(now.at("D2").friction_N, 0.0);
  EXPECT_FALSE(now.at("D1").series);
  now = dampers(At("damper.friction", {{"stiffness", 6e6}, {"threshold", 800.0}}, "dampers", "damper:D1"));
  EXPECT_TRUE(now.at("D1").series);
  EXPECT_EQ(now.at("D1").stiffness, 6e6);
  EXPECT_EQ(now.at("D1").friction_N, 800.0);
  EXPECT_EQ(now.at("D11").friction_N, 0.0);
  now = dampers(At("damper.absent", {}, "dampers", "damper:D1"));
  EXPECT_FALSE(now.contains("D1"));
  EXPECT_EQ(now.size(), 4U);  // the stop, the shoe and two dampers
}

// A folder with a parameter of nothing would not be read.
TEST(ExtendedModel, ParametersOfAbsentDampersGoWithThem) {
  fe::Model model = with_dampers();
  for (fe::Spring& s : model.springs)
    if (s.name.starts_with("D")) s.group = "make_" + s.name;
  const auto parameter = [](const char* name, std::vector<std::string> of) {
    return fe::Parameter{name, fe::Target::spring_stiffness, std::move(of), "-", 1.0, 0.5, 2.0};
  };
  model.parameters = {parameter("k_D11", {"make_D11"}), parameter("k_both", {"make_D1", "make_D2"}),
                      parameter("k_pier", {"pier"})};
  const InTheLine line(std::move(model));
  const At first("damper.absent", {}, "dampers", "damper:D1"), other("damper.absent", {}, "dampers", "damper:D11");
  const ExtendedModel out = line.with({&first, &other}, Eigen::Vector3d(1.1, 1.2, 1.3));
  ASSERT_EQ(out.elements->parameters.size(), 2U);
  EXPECT_EQ(out.elements->parameters[0].of, std::vector<std::string>{"make_D2"});
  EXPECT_EQ(out.elements->parameters[0].initial, 1.2);
  EXPECT_EQ(out.elements->parameters[1].name, "k_pier");
  EXPECT_EQ(out.elements->parameters[1].initial, 1.3);
  EXPECT_NO_THROW(fe::validate(*out.elements));
}

TEST(ExtendedModel, DampersStandAtTheirOtherPlace) {
  // D2 goes beside node 10, D1 beside the wall.
  diagnosis::PlaceOptions options;
  options.moves = {{"foot", {"D2", "D1"}, {{5.8, 0.1, 0.0}, {0.2, 0.0, 0.0}}}};
  const InTheLine line(with_dampers(), options);
  ReducedPlace first, second, to;
  first.id = "damper:D2";
  second.id = "damper:D1";
  const At cause("damper.move", {}, "damper_moves", "dampers:D2,D1@foot", {&first, &second, &to});
  const ExtendedModel out = line.with({&cause});
  EXPECT_EQ(out.holds, std::vector<bool>{true});
  std::map<std::string, int> node;
  for (const fe::Spring& s : out.elements->springs) node[s.name] = s.node;
  EXPECT_EQ(node, (std::map<std::string, int>{{"stop", 1}, {"shoe", 2}, {"D1", 0}, {"D2", 2}, {"D11", 1}}));
}

// Node 20 cannot move vertically: the fit then uses the directions in which it can.
TEST(ExtendedModel, AVerticalPropWhereNothingMovesVerticallyActsAsInTheFit) {
  const InTheLine line;
  ReducedPlace node;
  Eigen::SparseMatrix<double> along_x(2, 3);  // nodes 20 and 10 move along x alone
  along_x.insert(0, 0) = 1.0;
  node.directions = diagnosis::ReducedDirections(
      along_x, std::make_shared<const diagnosis::ReducedBasis>(Eigen::MatrixXd::Identity(2, 2)), false);
  At prop("element.spring", {{"stiffness", 4e6}}, "nodes", "node:20", {&node});
  prop.with_text("direction", "vertical");
  Line propped;
  propped.near_ground = 4e6;
  line.expect(prop, propped);
}

TEST(ExtendedModel, ASupportStandsAtTheNearestNodeOfItsLine) {
  InTheLine line;
  Place place{"support:pier", Vector3d::Zero(), {}, {}, {}, {}, {}};
  place.attributes = {{"stations", 3.0}, {"x_0", 0.0},    {"x_1", 2.0},   {"x_2", 6.0},
                      {"node_0", 0.0},   {"node_1", 1.0}, {"node_2", 2.0}};
  line.places.sets["support_moves"] = {place};
  Line moved;
  moved.near_ground = moved.pier;
  moved.pier = 0.0;
  line.expect(At("support.move", {{"position", 3.9}}, "support_moves", "support:pier"), moved);
  line.expect(At("support.move", {{"position", 1.2}}, "support_moves", "support:pier"), moved);
  line.expect(At("support.move", {{"position", 4.1}}, "support_moves", "support:pier"), Line());
}

TEST(ExtendedModel, WhatAModelCannotSayIsNotHeld) {
  const InTheLine line;
  for (const At& cause :
       {At("scale.stiffness", {{"factor", 0.5}}, "global", "global"), At("wind.drag", {{"factor", 0.5}}, "global", "global"),
        At("element.string", {{"mass", 5.0}, {"frequency", 2.0}}, "stays", "stay:S1")}) {
    const ExtendedModel out = line.with({&cause});
    EXPECT_EQ(out.holds, std::vector<bool>{false}) << cause.hypothesis.id;
    expect_close(model_hertz(*out.elements, 2), Line().hertz());
  }
}

TEST(ExtendedModel, ACauseThatIsHeldInPartIsNotHeldButInTheModel) {
  const InTheLine line;
  At both("wind.drag", {{"factor", 2.0}}, "nodes", "node:20");
  both.hypothesis.actions.push_back({diagnosis::Primitive::mass_add, {}, {{"mass", {50.0, "", 0}}}, 0});
  const At mass("mass.add", {{"mass", 70.0}}, "nodes", "node:10");
  const ExtendedModel out = line.with({&both, &mass});
  EXPECT_EQ(out.holds, (std::vector<bool>{false, true}));
  Line heavy;
  heavy.near += 50.0;
  heavy.far += 70.0;
  expect_close(model_hertz(*out.elements, 2), heavy.hertz());
}

TEST(ExtendedModel, ANodeThatIsNotThereIsNamed) {
  const InTheLine line;
  const At mass("mass.add", {{"mass", 70.0}}, "nodes", "node:11");
  try {
    (void)line.with({&mass});
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "line: 11: is no node of the model");
  }
}

}  // namespace
}  // namespace twindeck::tests
