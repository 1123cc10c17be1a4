// Oracles: (1) central differences of K(theta), M(theta); (2) the model rewritten with the parameter values and assembled anew,
// which must give the same matrices as the terms scaled by their coefficients; (3) Ernst's formula by hand.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly_models.hpp"
#include "fe/assembly.hpp"

namespace twindeck::fe {
namespace {

Eigen::VectorXd somewhere(const ParametricSystem& system) {
  Eigen::VectorXd theta = system.initial();
  for (Eigen::Index i = 0; i < theta.size(); ++i) theta[i] *= 1.0 + 0.07 * static_cast<double>(i % 4) - 0.1;
  return theta;
}

class OneOfEverything : public ::testing::Test {
 protected:
  Model model = test::one_of_everything();
  PrestressState state = find_prestress(model, initial_parameters(model));
  ParametricSystem system = assemble(model, state);
};

TEST_F(OneOfEverything, DerivativesAgreeWithCentralDifferences) {
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

TEST_F(OneOfEverything, ScaledTermsEqualTheModelAssembledAnew) {
  const Eigen::VectorXd theta0 = system.initial();
  for (Eigen::Index p = 0; p < theta0.size(); ++p) {
    const std::string& name = system.parameters[static_cast<std::size_t>(p)].name;
    Eigen::VectorXd theta = theta0;
    theta[p] *= 1.3;
    const ParametricSystem anew = assemble(with_parameters(model, theta), state);
    EXPECT_LT((anew.initial() - theta).norm(), 1e-12 * theta.norm());
    const Eigen::MatrixXd k = test::full(anew.stiffness(anew.initial())), m = test::full(anew.mass(anew.initial()));
    EXPECT_LT((test::full(system.stiffness(theta)) - k).norm(), 1e-12 * k.norm()) << name;
    EXPECT_LT((test::full(system.mass(theta)) - m).norm(), 1e-12 * m.norm()) << name;
  }
}

TEST_F(OneOfEverything, ProductWithVectorsEqualsTheDenseProduct) {
  const Eigen::VectorXd theta = somewhere(system);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(system.size(), system.size());
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(system.size(), 3);
  const Eigen::MatrixXd dk = system.stiffness_derivative_times(theta, 0, identity);
  EXPECT_LT((system.stiffness_derivative_times(theta, 0, x) - dk * x).norm(), 1e-12 * (dk * x).norm());
  EXPECT_LT((dk - dk.transpose()).norm(), 1e-14 * dk.norm());
}

TEST(Parametric, ErnstModulusAndItsDerivative) {
  // gamma l = 4.8e6 N/m2, sigma = 100 MPa: q = (gamma l)²/(12 sigma³) = 1.92e-12 1/Pa, E_eq = E/(1 + qE), dE_eq/dE = 1/(1 +
  // qE)².
  const Dischinger sag{80e3, 60.0, 100e6};
  EXPECT_NEAR(sag.modulus(200e9), 200e9 / 1.384, 1.0);
  EXPECT_NEAR(sag.modulus_derivative(200e9), 1.0 / (1.384 * 1.384), 1e-12);
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
