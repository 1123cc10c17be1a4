// Oracles: E A/L, 12 E I/L³, plate stiffness and Ernst's modulus by hand, and how they go with their parameters.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "assembly_models.hpp"
#include "fe/assembly_plans.hpp"

namespace twindeck::fe {
namespace {

Eigen::MatrixXd stiffness_at(const Model& model, const Eigen::VectorXd& factors, const PrestressState& state = {}) {
  const ParametricSystem system = assemble(model, state);
  return test::full(system.stiffness(system.initial().cwiseProduct(factors)));
}

void scale_by(Model& model, Target target, const char* of, double initial) {
  model.parameters.push_back({"q" + std::to_string(model.parameters.size()), target, {of}, "", initial, initial, initial});
}

/// One beam of 2 m along X, held at its left end: E A/L = 1e9, 12 E I/L³ = 12e6 (z) and 3e6 (y), G J/L = 1.2e6.
Model steel_beam() {
  Model model = test::with_steel();
  test::add_node(model, 0.0, 0.0, 0.0);
  test::add_node(model, 2.0, 0.0, 0.0);
  test::add_element(model, ElementType::beam, "girder", 0, 0, {0, 1});
  test::fix(model, 0);
  return model;
}

// Oracle: the area moves E A/L alone; the modulus moves all, G J/L included.
TEST(AssembleStiffness, AreaOfABeamIsAxial) {
  Model model = steel_beam();
  scale_by(model, Target::area, "girder", 0.01);
  scale_by(model, Target::youngs_modulus, "steel", 200e9);
  for (const double area : {1.0, 3.0})
    for (const double modulus : {1.0, 0.5}) {
      Eigen::VectorXd expected(6);
      expected << area * 1e9, 3e6, 12e6, 1.2e6, 16e6, 4e6;
      EXPECT_LT((stiffness_at(model, Eigen::Vector2d(area, modulus)).diagonal() - modulus * expected).norm(), 1e-3);
    }
}

// Oracle: with a parameter on its area a beam is the same beam, its hinges too (a hinge: 3 E I/L³; an axial release: none).
TEST(AssembleStiffness, AreaKeepsReleases) {
  Model model = steel_beam();
  test::add_node(model, 4.0, 0.0, 0.0);
  test::add_element(model, ElementType::beam, "girder", 0, 0, {1, 2});
  test::fix(model, 2);
  model.elements[0].releases = 1U << 10;
  model.elements[1].releases = 1U << 0;
  const Eigen::MatrixXd plain = stiffness_at(model, Eigen::VectorXd(0));
  EXPECT_NEAR(plain(0, 0), 1e9, 1e-3);
  EXPECT_NEAR(plain(2, 2), 3e6 + 12e6, 1e-3);
  scale_by(model, Target::area, "girder", 0.01);
  EXPECT_LT((stiffness_at(model, Eigen::VectorXd::Ones(1)) - plain).norm(), 1e-12 * plain.norm());
}

// Oracle: bars go with E A; a spring with its group's factor. What is not fitted, or has a dashpot in series, carries nothing.
TEST(AssembleStiffness, BarsAndSprings) {
  Model model = steel_beam();
  model.elements[0].type = ElementType::bar;
  Spring spring;
  spring.name = spring.group = "bearings";
  spring.node = 1;
  spring.stiffness = 5e3;
  for (const Eigen::Vector3d& d : {Eigen::Vector3d(0.0, 2.0, 0.0), Eigen::Vector3d(0.0, 0.0, 3.0)}) {
    spring.direction = d;
    model.springs.push_back(spring);
  }
  spring.active = false;
  model.springs.push_back(spring);
  spring.active = true, spring.series = true;
  model.springs.push_back(spring);
  scale_by(model, Target::area, "girder", 0.01);
  scale_by(model, Target::spring_stiffness, "bearings", 1.0);
  const Eigen::MatrixXd k = stiffness_at(model, Eigen::Vector2d(2.0, 7.0));
  ASSERT_EQ(k.rows(), 3);
  EXPECT_LT((k.diagonal() - Eigen::Vector3d(2e9, 35e3, 35e3)).norm(), 1e-3);
}

// Oracle: a square plate of thickness t: membrane ~ E t, bending ~ E t³ RMI. Uniform tension of the right side by f0 for u = 1.
TEST(AssembleStiffness, ShellsGoWithThicknessAndItsCube) {
  Model model = test::with_steel();
  Section slab;
  slab.name = "slab";
  slab.thickness_m = 0.1;
  model.sections.push_back(slab);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}) test::add_node(model, x, y, 0.0);
  test::add_element(model, ElementType::shell, "deck", 0, 1, {0, 1, 2, 3});
  test::fix(model, 0);
  scale_by(model, Target::thickness, "slab", 0.1);
  scale_by(model, Target::bending_inertia_ratio, "slab", 1.0);
  scale_by(model, Target::youngs_modulus, "steel", 200e9);
  const Eigen::VectorXd once = stiffness_at(model, Eigen::Vector3d::Ones()).diagonal();
  const Eigen::VectorXd scaled = stiffness_at(model, Eigen::Vector3d(2.0, 5.0, 3.0)).diagonal();
  for (const int membrane : {0, 1, 5}) EXPECT_NEAR(scaled[membrane] / once[membrane], 3.0 * 2.0, 1e-9);
  for (const int bending : {2, 3, 4}) EXPECT_NEAR(scaled[bending] / once[bending], 3.0 * 8.0 * 5.0, 1e-9);
}

// Oracle: Ernst's modulus at 3-4-5: l = 1.2 m of 2 m, gamma = 8000·10 N/m3, sigma = 2e4/0.01 Pa; along the chord E_eq A/L, and
// the string T/L across it (geometric). Without a force the whole E A/L. The force alone is frozen:
// sigma goes with 1/A and gamma with the density.
TEST(AssembleStiffness, StaysHaveErnstsModulus) {
  Model model = steel_beam();
  model.nodes[1].x_m = Eigen::Vector3d(1.2, 0.0, 1.6);
  model.elements[0].type = ElementType::stay;
  model.elements[0].name = "S1";
  model.prestress.geometric_stiffness = false;
  scale_by(model, Target::youngs_modulus, "steel", 200e9);
  scale_by(model, Target::area, "girder", 0.01);
  scale_by(model, Target::density, "steel", 8000.0);
  PrestressState state;
  state.stay_pull_N = Eigen::VectorXd::Constant(1, 2e4);
  state.axial_force_N = Eigen::VectorXd::Zero(1);
  const Eigen::Vector3d along(0.6, 0.0, 0.8);
  const double q = std::pow(8e4 * 1.2, 2) / (12.0 * std::pow(2e6, 3));
  for (const double e : {1.0, 2.0})
    for (const double area : {1.0, 1.5})
      for (const double density : {1.0, 0.7}) {
        const double sag = q * 200e9 * e * density * density * area * area * area;
        const double expected = area * 0.01 / 2.0 * 200e9 * e / (1.0 + sag);
        const Eigen::Matrix3d k = stiffness_at(model, Eigen::Vector3d(e, area, density), state);
        EXPECT_LT((k - expected * along * along.transpose()).norm(), 1e-9 * expected);
      }
  EXPECT_GT(q * 200e9, 10.0);  // else the sag would not show
  const Eigen::Matrix3d taut = stiffness_at(model, Eigen::Vector3d::Ones());
  EXPECT_LT((taut - 1e9 * along * along.transpose()).norm(), 1.0);
  model.prestress.geometric_stiffness = true;
  const Eigen::Matrix3d with = stiffness_at(model, Eigen::Vector3d::Ones(), state);
  EXPECT_NEAR(with(1, 1), 1e4, 1e-6);
}

}  // namespace
}  // namespace twindeck::fe
