// Oracles: axial forces by Hooke's law; K_G of a uniform stress on a linear displacement, uᵀ K_G u = V ∇u : (∇u σ); buckling of
// a plate and of a column, where a load of half the critical one leaves the frequency times sqrt(1/2).
#include "fe/static_stage.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/solid.hpp"
#include "fe/tetrahedron.hpp"

namespace twindeck::fe {
namespace {

/// Four beams along X with both ends held along X, hinged; E A = 2e9 N.
Model held_bar() {
  Model model = test::with_steel();
  for (int i = 0; i <= 4; ++i) test::add_node(model, 2.5 * i, 0.0, 0.0);
  for (int i = 0; i < 4; ++i) test::add_element(model, ElementType::beam, "bar", 0, 0, {i, i + 1});
  test::fix(model, 0, {true, true, true, true, false, false});
  test::fix(model, 4, {true, true, true, false, false, false});
  model.gravity_m_s2 = 0.0;
  model.prestress.rule = PullRule::given;
  model.prestress.load_case = "static";
  return model;
}

TEST(StaticStage, ForcesMovementsAndFreeStrainsGiveHookesForces) {
  Model model = held_bar();
  model.prestress.loads = {{2, 0, 4000.0, false}};  // in the middle: half to each side
  Eigen::VectorXd n = find_prestress(model, initial_parameters(model)).axial_force_N;
  EXPECT_NEAR(n[0], 2000.0, 1e-6);
  EXPECT_NEAR(n[3], -2000.0, 1e-6);
  model.prestress.loads = {{4, 0, 0.01, true}};  // 1/1000 of the length
  n = find_prestress(model, initial_parameters(model)).axial_force_N;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(n[i], 2e6, 1.0);
  model.prestress.loads.clear();
  for (Element& e : model.elements) e.free_strain = 1e-4;
  n = find_prestress(model, initial_parameters(model)).axial_force_N;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(n[i], -2e5, 1.0);
}

TEST(StaticStage, AMovementWithoutSupportIsRefused) {
  Model model = held_bar();
  model.prestress.loads = {{2, 1, 0.01, true}};
  EXPECT_THROW(static_cast<void>(find_prestress(model, initial_parameters(model))), InputError);
}

TEST(StaticStage, WeightFallsAlongTheDirectionOfGravity) {
  // Released along X at its end: the first beam carries 3.5 of four parts of the weight, A rho g = 800 N/m.
  Model model = held_bar();
  model.gravity_m_s2 = 10.0;
  model.gravity_direction = Eigen::Vector3d::UnitX();
  model.supports.back().fixed = {false, true, true, false, false, false};
  const Eigen::VectorXd n = find_prestress(model, initial_parameters(model)).axial_force_N;
  EXPECT_NEAR(n[0], 3.5 * 2.5 * 800.0, 1e-3);
  EXPECT_NEAR(n[3], 0.5 * 2.5 * 800.0, 1e-3);
}

const Eigen::Matrix3d gradient_of_test = (Eigen::Matrix3d() << 0.3, -0.2, 0.5, 0.1, 0.7, -0.4, 0.6, 0.2, -0.1).finished();
const SolidProperties unit_steel{210e9, 0.3};

template <std::size_t count>
Eigen::VectorXd linear_field(const std::array<Eigen::Vector3d, count>& x, const Eigen::Matrix3d& gradient) {
  Eigen::VectorXd u(3 * static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) u.segment<3>(3 * static_cast<Eigen::Index>(i)) = gradient * x[i];
  return u;
}

Eigen::Matrix3d stress_of(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const double nu = unit_steel.poisson_ratio, g = unit_steel.youngs_modulus_Pa / (2.0 * (1.0 + nu));
  return 2.0 * g * strain + 2.0 * g * nu / (1.0 - 2.0 * nu) * strain.trace() * Eigen::Matrix3d::Identity();
}

TEST(StaticStage, SolidsUnderUniformStressHaveTheExactGeometricEnergy) {
  const Eigen::Matrix3d straining = 1e-3 * (Eigen::Matrix3d() << 1.0, 0.4, -0.3, 0.2, -0.6, 0.5, 0.1, 0.3, 0.8).finished();
  const double energy = (gradient_of_test * stress_of(straining) * gradient_of_test.transpose()).trace();
  SolidGeometry box;  // a distorted hexahedron, as in a patch test
  const std::array<Eigen::Vector3d, 8> corners = {
      {{0, 0, 0}, {1, 0.1, 0}, {1.2, 1, 0.1}, {0, 1.1, 0}, {0.1, 0, 1}, {1, 0, 1.1}, {1, 1, 1}, {0, 0.9, 1.2}}};
  box.node_m = corners;
  const Eigen::VectorXd u = linear_field(corners, gradient_of_test);
  const MatrixSolid k = solid_geometric_stiffness(box, unit_steel, linear_field(corners, straining));
  // The stress is uniform; the volume is that of the 2 × 2 × 2 rule, exact for a hexahedron.
  EXPECT_NEAR(u.dot(k * u), solid_shape(box).volume_m3 * energy, 1e-6 * std::abs(energy));
  TetrahedronGeometry four;
  four.node_m = {{{0, 0, 0}, {1, 0.2, 0}, {0.1, 1, 0}, {0.2, 0.1, 1.3}}};
  const Eigen::VectorXd v = linear_field(four.node_m, gradient_of_test);
  const MatrixTetrahedron k4 = tetrahedron_geometric_stiffness(four, unit_steel, linear_field(four.node_m, straining));
  EXPECT_NEAR(v.dot(k4 * v), tetrahedron_volume(four) * energy, 1e-9 * std::abs(energy));
}

/// Lowest frequency [rad/s] under the loads of the stage, by inverse iteration: the next mode is twice as high and more.
double lowest(const Model& model) {
  const Eigen::VectorXd theta = initial_parameters(model);
  const ParametricSystem system = assemble(model, find_prestress(model, theta));
  const Eigen::MatrixXd k = test::full(system.stiffness(theta)), m = test::full(system.mass(theta));
  const Eigen::LDLT<Eigen::MatrixXd> factor(k);
  Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(k.rows(), 1.0, 2.0);
  for (int i = 0; i < 60; ++i) u = factor.solve(m * u).normalized();
  return std::sqrt(u.dot(k * u) / u.dot(m * u));
}

double ratio_under_load(Model model) {
  const double loaded = lowest(model);
  model.prestress.loads.clear();
  return loaded / lowest(model);
}

/// Square plate of 1 m, 10 mm, simply supported, pressed along X by half of its buckling load 4 π² D / b. `triangles`: each
/// quadrilateral cut in two.
Model pressed_plate(int n, bool triangles) {
  Model model = test::with_steel();
  Section plate;
  plate.name = "plate";
  plate.thickness_m = 0.01;
  model.sections.push_back(plate);
  model.materials[0].poisson_ratio = 0.25;  // which G = 80 GPa follows from
  const double h = 1.0 / n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) test::add_node(model, h * i, h * j, 0.0);
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::array<int, 4> q = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (!triangles) {
        test::add_element(model, ElementType::shell, "plate", 0, 1, {q[0], q[1], q[2], q[3]});
      } else {
        test::add_element(model, ElementType::shell, "plate", 0, 1, {q[0], q[1], q[2]});
        test::add_element(model, ElementType::shell, "plate", 0, 1, {q[0], q[2], q[3]});
      }
    }
  const double stiffness = 200e9 * 1e-6 / (12.0 * (1.0 - 0.0625));
  const double pressed_N = 0.5 * 4.0 * std::numbers::pi * std::numbers::pi * stiffness;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool left = i == 0, corner = left && j == 0, edge = i == 0 || i == n || j == 0 || j == n;
      if (edge) test::fix(model, at(i, j), {left, corner, true, false, false, false});
      if (i == n) model.prestress.loads.push_back({at(i, j), 0, -pressed_N * h * (j == 0 || j == n ? 0.5 : 1.0), false});
    }
  model.gravity_m_s2 = 0.0;
  model.prestress.rule = PullRule::given;
  model.prestress.load_case = "pressed";
  model.prestress.shells_and_solids = true;
  return model;
}

// Bilinear slopes miss (π h)²/12 of the geometric stiffness a direction: 1.3 % of half the load with 8 elements, 0.65 % of the
// frequency. Triangles likewise, and their membrane carries the load at its corners a little unevenly.
TEST(StaticStage, APlateAtHalfItsBucklingLoad) {
  EXPECT_NEAR(ratio_under_load(pressed_plate(8, false)), std::sqrt(0.5), 0.01 * std::sqrt(0.5));
  EXPECT_NEAR(ratio_under_load(pressed_plate(8, true)), std::sqrt(0.5), 0.015 * std::sqrt(0.5));
}

TEST(StaticStage, StressesOfShellsCountWhereTheyAreAskedFor) {
  Model model = pressed_plate(4, false);
  model.prestress.shells_and_solids = false;
  EXPECT_NEAR(ratio_under_load(model), 1.0, 1e-9);
}

/// Half of a hinged column of 2 m, 0.1 × 0.1 m, in hexahedra: symmetric at x = 0, carried by its middle line at x = 1 m.
Model pressed_column() {
  Model model = test::with_steel();
  model.materials[0].poisson_ratio = 0.25;
  constexpr int along = 10, up = 2;
  const auto at = [](int i, int j, int k) { return (i * 2 + j) * (up + 1) + k; };
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k <= up; ++k) test::add_node(model, 0.1 * i, 0.1 * j, 0.05 * k);
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < up; ++k)
      test::add_element(model, ElementType::solid, "column", 0, -1,
                        {at(i, 0, k), at(i + 1, 0, k), at(i + 1, 1, k), at(i, 1, k), at(i, 0, k + 1), at(i + 1, 0, k + 1),
                         at(i + 1, 1, k + 1), at(i, 1, k + 1)});
  const double euler_N = std::numbers::pi * std::numbers::pi * 200e9 * 1e-4 / 12.0 / 4.0;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k <= up; ++k) {
        const bool middle = i == 0, carried = i == along && k == 1, still = j == 0;
        if (middle || carried || still) test::fix(model, at(i, j, k), {middle, still, carried, false, false, false});
        if (i == along) model.prestress.loads.push_back({at(i, j, k), 0, -0.5 * euler_N * (k == 1 ? 0.25 : 0.125), false});
      }
  model.gravity_m_s2 = 0.0;
  model.prestress.rule = PullRule::given;
  model.prestress.load_case = "pressed";
  model.prestress.shells_and_solids = true;
  return model;
}

/// The same in quadratic hexahedra: linear in the loads, which stay at the corners of the end.
TEST(StaticStage, AColumnOfQuadraticSolidsAtHalfItsBucklingLoad) {
  Model model = pressed_column();
  const std::size_t corners = model.nodes.size();
  test::make_quadratic(model);
  for (std::size_t i = corners; i < model.nodes.size(); ++i) {
    const Eigen::Vector3d x = model.nodes[i].x_m;
    const bool middle = x.x()<1e-9, still = x.y() < 1e-9, carried = x.x()> 1.0 - 1e-9 && std::abs(x.z() - 0.05) < 1e-9;
    if (middle || carried || still) test::fix(model, static_cast<int>(i), {middle, still, carried, false, false, false});
  }
  EXPECT_NEAR(ratio_under_load(model), std::sqrt(0.5), 0.01 * std::sqrt(0.5));
}

// Shear lowers the buckling load by P/(G A_s) = 0.6 %, the mesh raises it by as much: 1 % in all.
TEST(StaticStage, AColumnOfSolidsAtHalfItsBucklingLoad) {
  EXPECT_NEAR(ratio_under_load(pressed_column()), std::sqrt(0.5), 0.01 * std::sqrt(0.5));
}

TEST(StaticStage, LargeDisplacementsOfACompressedPlateGiveTheSameFrequency) {
  Model model = pressed_plate(6, false);
  const double linear = lowest(model);
  model.prestress.displacements = Displacements::large;
  EXPECT_NEAR(lowest(model), linear, 2e-3 * linear);  // strains of the load are 4e-4
}

}  // namespace
}  // namespace twindeck::fe
