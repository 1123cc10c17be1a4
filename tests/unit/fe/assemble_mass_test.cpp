// Oracles: masses by hand, and how they go with density, area and thickness.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly_models.hpp"
#include "fe/assembly_plans.hpp"

namespace twindeck::fe {
namespace {

Eigen::MatrixXd mass_at(const Model& model, const Eigen::VectorXd& factors) {
  const ParametricSystem system = assemble(model, {});
  return test::full(system.mass(system.initial().cwiseProduct(factors)));
}

/// Mass that moves in one direction when all free nodes do.
double moving_mass(const Model& model, const Eigen::VectorXd& factors, int direction) {
  const ParametricSystem system = assemble(model, {});
  const Eigen::MatrixXd m = test::full(system.mass(system.initial().cwiseProduct(factors)));
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.rows());
  for (std::size_t i = 0; i < system.dofs.size(); ++i) u[static_cast<Eigen::Index>(i)] = system.dofs[i].direction == direction;
  return u.dot(m * u);
}

void add_parameter(Model& model, Target target, const char* of, double initial) {
  model.parameters.push_back({"p" + std::to_string(model.parameters.size()), target, {of}, "", initial, initial, initial});
}

/// A beam of 2 m (160 kg) held at its left end.
Model one_beam(bool rotary) {
  Model model = test::with_steel();
  model.formulation.beam_rotary_inertia = rotary;
  test::add_node(model, 0.0, 0.0, 0.0);
  test::add_node(model, 2.0, 0.0, 0.0);
  test::add_element(model, ElementType::beam, "girder", 0, 0, {0, 1});
  test::fix(model, 0);
  return model;
}

// Oracle: the area scales ρ A L alone: 156/420, 4 L²/420, 1/3. The section's own inertia ρ I stays: 6/5 ρ I/L, 2/15 ρ I L and
// the polar one. Density scales all.
TEST(AssembleMass, AreaOfABeamLeavesItsRotaryInertia) {
  Model model = one_beam(true);
  add_parameter(model, Target::area, "girder", 0.01);
  add_parameter(model, Target::density, "steel", 8000.0);
  for (const double area : {1.0, 3.0})
    for (const double density : {1.0, 0.5}) {
      const Eigen::VectorXd m = mass_at(model, Eigen::Vector2d(area, density)).diagonal();
      EXPECT_NEAR(m[0], density * area * 160.0 / 3.0, 1e-9);
      EXPECT_NEAR(m[1], density * (area * 160.0 * 156.0 / 420.0 + 1.2 * 8000.0 * 1e-5 / 2.0), 1e-9);
      EXPECT_NEAR(m[2], density * (area * 160.0 * 156.0 / 420.0 + 1.2 * 8000.0 * 4e-5 / 2.0), 1e-9);
      EXPECT_NEAR(m[3], density * 8000.0 * 5e-5 * 2.0 / 3.0, 1e-9);
      EXPECT_NEAR(m[4], density * (area * 160.0 * 16.0 / 420.0 + 2.0 / 15.0 * 8000.0 * 4e-5 * 2.0), 1e-9);
    }
}

// Oracle: a beam with both ends free along its axis still has all of its mass when its section is a parameter.
TEST(AssembleMass, AxialReleaseAndAreaTogether) {
  Model model = one_beam(true);
  model.elements[0].releases = 1U << 10 | 1U << 11;
  const Eigen::MatrixXd plain = mass_at(model, Eigen::VectorXd(0));
  add_parameter(model, Target::area, "girder", 0.01);
  EXPECT_LT((mass_at(model, Eigen::VectorXd::Ones(1)) - plain).norm(), 1e-12 * plain.norm());
}

// Oracle: slabs weigh ρ t, their rotary inertia ρ t³/12; a quarter of 4 m2 · 300 kg/m2 moves at each lumped corner.
TEST(AssembleMass, ThicknessOfAShell) {
  Model model = test::with_steel();
  Section slab;
  slab.name = "slab";
  slab.thickness_m = 0.3;
  model.sections.push_back(slab);
  model.materials[0].density_kg_m3 = 1000.0;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}) test::add_node(model, x, y, 0.0);
  test::add_element(model, ElementType::shell, "deck", 0, 1, {0, 1, 2, 3});
  test::fix(model, 0);
  add_parameter(model, Target::thickness, "slab", 0.3);
  model.formulation.lumped_mass = true;
  for (const double t : {1.0, 2.0}) {
    const Eigen::VectorXd m = mass_at(model, Eigen::VectorXd::Constant(1, t)).diagonal();
    EXPECT_NEAR(m[0], 300.0 * t, 1e-9);
    EXPECT_NEAR(m[2], 300.0 * t, 1e-9);
    EXPECT_NEAR(m[3], 1000.0 * 0.027 / 12.0 * t * t * t, 1e-9);
    EXPECT_NEAR(m[5], 0.0, 1e-12);
  }
  model.formulation.shell_rotary_inertia = false;
  EXPECT_NEAR(mass_at(model, Eigen::VectorXd::Ones(1))(3, 3), 0.0, 1e-12);
}

// Oracle: groups of point masses go with their own factor, each with its inertia.
TEST(AssembleMass, PointMassesGoWithTheirGroup) {
  Model model = one_beam(false);
  model.materials[0].density_kg_m3 = 0.0;
  model.masses.push_back({"railing", 1, 300.0, Eigen::Vector3d(5.0, 6.0, 7.0)});
  model.masses.push_back({"lamp", 1, 20.0, Eigen::Vector3d::Zero()});
  model.masses.push_back({"railing", 1, 100.0, Eigen::Vector3d(1.0, 1.0, 1.0)});
  add_parameter(model, Target::point_mass, "railing", 1.0);
  const Eigen::VectorXd m = mass_at(model, Eigen::VectorXd::Constant(1, 2.0)).diagonal();
  Eigen::VectorXd expected(6);
  expected << 820.0, 820.0, 820.0, 12.0, 14.0, 16.0;
  EXPECT_LT((m - expected).norm(), 1e-12);
}

// Oracle: half of a stay and a third of a bar move with their free end, ρ A L = 8000·0.01·2 each; a slave's mass rides on its
// master.
TEST(AssembleMass, StaysBarsAndLinks) {
  Model model = one_beam(false);
  model.elements[0].type = ElementType::stay;
  add_parameter(model, Target::area, "girder", 0.01);
  model.elements[0].name = "S1";
  Spring hold;
  hold.name = hold.group = "hold";
  hold.node = 1;
  hold.stiffness = 1e3;
  model.springs.push_back(hold);
  for (const int direction : {0, 2}) EXPECT_NEAR(moving_mass(model, Eigen::VectorXd::Constant(1, 3.0), direction), 240.0, 1e-9);
  model.elements[0].type = ElementType::bar;
  EXPECT_NEAR(moving_mass(model, Eigen::VectorXd::Constant(1, 3.0), 2), 160.0, 1e-9);
  Model linked = one_beam(false);
  linked.materials[0].density_kg_m3 = 0.0;
  const int rider = test::add_node(linked, 2.0, 0.0, 0.5);
  linked.links.push_back({"arm", 1, rider});
  linked.masses.push_back({"rider", rider, 40.0, Eigen::Vector3d::Zero()});
  const Eigen::MatrixXd m = mass_at(linked, Eigen::VectorXd(0));
  EXPECT_NEAR(m(4, 4), 40.0 * 0.25, 1e-12);  // m h² about y
  EXPECT_NEAR(m(0, 4), 40.0 * 0.5, 1e-12);   // +ry moves it along +x
  EXPECT_NEAR(m(1, 3), -40.0 * 0.5, 1e-12);
}

// Oracle: a parameter at its initial value changes nothing, and names of groups and sections are free: beams, bars and shells
// that share them keep their own mass.
TEST(AssembleMass, SharedNamesDoNotMixElements) {
  Model model = one_beam(true);
  const auto add_bar = [](Model& m) { test::add_element(m, ElementType::bar, "girder", 0, 0, {0, 1}); };
  add_bar(model);
  std::swap(model.elements[0], model.elements[1]);
  const Eigen::MatrixXd plain = mass_at(model, Eigen::VectorXd(0));
  add_parameter(model, Target::area, "girder", 0.01);
  EXPECT_LT((mass_at(model, Eigen::VectorXd::Ones(1)) - plain).norm(), 1e-12 * plain.norm());
  Model deck = test::one_of_everything();
  deck.parameters.erase(deck.parameters.begin() + 6);  // the area of the girder
  for (Element& e : deck.elements)
    if (e.type == ElementType::beam) e.material = 1;
  std::stable_partition(deck.elements.begin(), deck.elements.end(),
                        [](const Element& e) { return e.type == ElementType::beam; });
  Eigen::VectorXd thicker = Eigen::VectorXd::Ones(8);
  thicker[4] = 2.0;
  const Eigen::MatrixXd apart = mass_at(deck, thicker);
  for (Element& e : deck.elements)
    if (e.type == ElementType::beam) e.group = "slab";  // the shells' section
  EXPECT_LT((mass_at(deck, thicker) - apart).norm(), 1e-12 * apart.norm());
}

}  // namespace
}  // namespace twindeck::fe
