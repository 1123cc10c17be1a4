// Oracles: (1) central differences of K(theta), M(theta); (2) the model rewritten with the parameter values and assembled anew,
// which must give the same matrices as the terms scaled by their coefficients.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <set>

#include "assembly_models.hpp"
#include "fe/assembly.hpp"

namespace twindeck::fe {
namespace {

Eigen::VectorXd somewhere(const ParametricSystem& system) {
  Eigen::VectorXd theta = system.initial();
  for (Eigen::Index i = 0; i < theta.size(); ++i) theta[i] *= 1.0 + 0.07 * static_cast<double>(i % 4) - 0.1;
  return theta;
}

/// Adds to one_of_everything what scales in a way of its own: a second stay of another strand that shares the parameters of the
/// first, a tapered beam with offsets and a release, a tensioned bar, a block and a tetrahedron on the ground.
void add_the_rest(Model& model, bool quadratic_solids) {
  model.materials.push_back({"spiral", 150e9, 60e9, 0.25, 9100.0});
  Section toe = model.sections[0], rope = model.sections[2];
  toe.name = "toe", rope.name = "rope";
  toe.area_m2 *= 0.6, toe.inertia_y_m4 *= 0.4, toe.inertia_z_m4 *= 0.3, toe.inertia_yz_m4 = 2e-6;
  rope.area_m2 = 1.9e-3;
  model.sections.push_back(toe);
  model.sections.push_back(rope);
  Element& stay = test::add_element(model, ElementType::stay, "stays", 3, 4, {5, 7});
  stay.name = "N2";
  stay.pull_N = 80e3;
  Element& beam = test::add_element(model, ElementType::beam, "outrigger", 0, 0, {5, test::add_node(model, 6.0, 4.0, 0.4)});
  beam.section2 = 3;
  beam.offset_m = {Eigen::Vector3d(0.0, 0.1, -0.2), Eigen::Vector3d(0.05, 0.0, -0.1)};
  beam.releases = 1U << 4;
  test::add_element(model, ElementType::bar, "prop", 2, 2, {3, 9}).pull_N = 5e3;
  std::vector<int> corners;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      corners.push_back(test::add_node(model, 20.0 + x, y, z));
  for (std::size_t i = 0; i < 4; ++i) test::fix(model, corners[i]);
  test::add_element(model, ElementType::solid, "block", 1, -1, corners);
  test::add_element(model, ElementType::solid, "block", 1, -1,
                    {corners[4], corners[5], corners[6], test::add_node(model, 20.5, 0.5, 2.0)});
  if (quadratic_solids) test::make_quadratic(model);
}

/// Parameters of each kind on it; those of one_of_everything name the new parts too.
void add_the_other_parameters(Model& model) {
  model.parameters[2].of = {"cable", "spiral"};
  model.parameters[6].of = {"girder", "toe"};
  const auto parameter = [&](const char* name, Target target, const std::vector<std::string>& of, double initial) {
    model.parameters.push_back({name, target, of, "", initial, 0.5 * initial, 2.0 * initial});
  };
  parameter("rho_s", Target::density, {"steel"}, 8000.0);
  parameter("rho_stay", Target::density, {"cable", "spiral"}, 8289.0);
  parameter("A_stay", Target::area, {"strand", "rope"}, 1.3e-3);
}

/// With consistent masses and the drilling penalty, or (true) with lumped masses, diagonal drilling and quadratic solids.
class OneOfEverything : public ::testing::TestWithParam<bool> {
 protected:
  OneOfEverything() {
    add_the_rest(model, GetParam());
    add_the_other_parameters(model);
    model.formulation.lumped_mass = GetParam();
    if (GetParam()) model.formulation.drilling = Formulation::Drilling::diagonal;
    state = find_prestress(model, initial_parameters(model));
    EXPECT_TRUE(state.status.converged) << state.status.message;
    system = assemble(model, state);
  }
  Model model = test::one_of_everything();
  PrestressState state;
  ParametricSystem system;
};

INSTANTIATE_TEST_SUITE_P(Both, OneOfEverything, ::testing::Bool());

TEST_P(OneOfEverything, HasEveryKindOfParameter) {
  std::set<Target> kinds;
  for (const Parameter& parameter : model.parameters) kinds.insert(parameter.target);
  EXPECT_EQ(kinds.size(), 7U);  // all but those of matrix models
  int sagging = 0;
  for (const Term& term : system.stiffness_terms)
    if (term.coefficient.stay) sagging += term.coefficient.base < 0.9 ? 1 : 0;
  EXPECT_EQ(sagging, 2);  // else the sag of the stays would not show
}

TEST_P(OneOfEverything, DerivativesAgreeWithCentralDifferences) {
  const Eigen::VectorXd theta = somewhere(system);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(system.size(), system.size());
  for (int p = 0; p < static_cast<int>(system.parameters.size()); ++p) {
    const double h = 1e-5 * theta[p];
    Eigen::VectorXd up = theta, down = theta;
    up[p] += h, down[p] -= h;
    const Eigen::MatrixXd dk = (test::full(system.stiffness(up)) - test::full(system.stiffness(down))) / (2.0 * h);
    const Eigen::MatrixXd dm = (test::full(system.mass(up)) - test::full(system.mass(down))) / (2.0 * h);
    // Rounding of the difference: 1e-16 |K| / h.
    const double k_rounding = 1e-15 * test::full(system.stiffness(theta)).norm() / h;
    const double m_rounding = 1e-15 * test::full(system.mass(theta)).norm() / h;
    const std::string& name = system.parameters[static_cast<std::size_t>(p)].name;
    EXPECT_LT((system.stiffness_derivative_times(theta, p, identity) - dk).norm(), 1e-8 * dk.norm() + k_rounding) << name;
    EXPECT_LT((system.mass_derivative_times(theta, p, identity) - dm).norm(), 1e-8 * dm.norm() + m_rounding) << name;
    EXPECT_GT(dk.norm() + dm.norm(), 10.0 * std::min(k_rounding, m_rounding)) << name << " changes nothing";
  }
}

TEST_P(OneOfEverything, ScaledTermsEqualTheModelAssembledAnew) {
  const Eigen::VectorXd theta0 = system.initial();
  for (Eigen::Index p = 0; p <= theta0.size(); ++p) {
    const bool all = p == theta0.size();
    const std::string& name = all ? "all" : system.parameters[static_cast<std::size_t>(p)].name;
    Eigen::VectorXd theta = all ? somewhere(system) : theta0;
    if (!all) theta[p] *= 1.3;
    const ParametricSystem anew = assemble(with_parameters(model, theta), state);
    EXPECT_LT((anew.initial() - theta).norm(), 1e-12 * theta.norm());
    const Eigen::MatrixXd k = test::full(anew.stiffness(anew.initial())), m = test::full(anew.mass(anew.initial()));
    EXPECT_LT((test::full(system.stiffness(theta)) - k).norm(), 1e-12 * k.norm()) << name;
    EXPECT_LT((test::full(system.mass(theta)) - m).norm(), 1e-12 * m.norm()) << name;
  }
}

TEST_P(OneOfEverything, ProductWithVectorsEqualsTheDenseProduct) {
  const Eigen::VectorXd theta = somewhere(system);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(system.size(), system.size());
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(system.size(), 3);
  const Eigen::MatrixXd dk = system.stiffness_derivative_times(theta, 0, identity);
  EXPECT_LT((system.stiffness_derivative_times(theta, 0, x) - dk * x).norm(), 1e-12 * (dk * x).norm());
  EXPECT_LT((dk - dk.transpose()).norm(), 1e-14 * dk.norm());
}

TEST(Parametric, ThicknessStandsOnceInMembraneAndCubedInBending) {
  const Model model = test::one_of_everything();
  const ParametricSystem system = assemble(model, {});
  Eigen::VectorXd theta = system.initial();
  theta[4] *= 2.0;  // t
  int seen = 0;
  const auto expect = [&](const std::vector<Term>& terms, const std::string& label, double scale) {
    for (const Term& term : terms) {
      if (term.label != label) continue;
      EXPECT_NEAR(term.coefficient.value(theta), scale, 1e-12) << label;
      ++seen;
    }
  };
  expect(system.stiffness_terms, "slab of concrete membrane", 2.0);
  expect(system.stiffness_terms, "slab of concrete bending", 8.0);
  expect(system.mass_terms, "slab of concrete rotary mass", 8.0);
  EXPECT_EQ(seen, 3);
}

TEST(Parametric, MatrixModelExpandsToItself) {
  ParametricSystem system;
  system.pattern = linalg::SparseMatrix(2, 2);
  const Eigen::Vector2d x(1.0, 2.0);
  EXPECT_EQ(system.expand(x), x);
}

}  // namespace
}  // namespace twindeck::fe
