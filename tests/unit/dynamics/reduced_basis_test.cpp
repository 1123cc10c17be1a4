/// Oracles: exactness. Static shapes in the basis make the static answer exact; the modes that were put in come out; the full chain's
/// own answer to a harmonic load.
#include "dynamics/reduced_basis.hpp"

#include <gtest/gtest.h>

#include "dynamics/eigenmodes.hpp"
#include "spring_chain.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using twindeck::dynamics::ReducedBasis;
using twindeck::tests::SpringChain;

struct Case {
  twindeck::fe::ParametricSystem system = SpringChain{.n = 60}.system();
  twindeck::linalg::SparseMatrix k = system.stiffness(system.initial()), m = system.mass(system.initial());
  twindeck::linalg::Cholesky factor;
  MatrixXd modes;
  Case() {
    EXPECT_TRUE(factor.factorize(k).converged);
    modes = twindeck::dynamics::ModalSolver(system).solve(system.initial(), 4).shapes;
  }
  [[nodiscard]] MatrixXd patterns() const {
    MatrixXd p = MatrixXd::Zero(60, 3);
    p(7, 0) = p(30, 1) = 1.0;
    p(52, 2) = 3.0;
    return p;
  }
};

TEST(ReducedBasis, KeepsTheModesAndMakesStaticAnswersExact) {
  const Case c;
  const ReducedBasis basis = twindeck::dynamics::reduced_basis(c.k, c.m, c.modes, c.factor.solve(c.patterns()));
  ASSERT_EQ(basis.vectors.cols(), 7);
  for (int j = 0; j < 4; ++j) EXPECT_NEAR(basis.omega_rad_s[j], std::sqrt(SpringChain{.n = 60}.eigenvalue(j + 1)), 1e-9);
  const MatrixXd mass = basis.vectors.transpose() * (c.m.selfadjointView<Eigen::Lower>() * basis.vectors);
  EXPECT_LT((mass - MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-9);
  const MatrixXd exact = c.factor.solve(c.patterns());
  const MatrixXd reduced = basis.vectors * basis.omega_rad_s.cwiseAbs2().cwiseInverse().asDiagonal() *
                           (basis.vectors.transpose() * c.patterns());
  EXPECT_LT((exact - reduced).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ReducedBasis, CorrectionsHoldMostOfTheEnergyAndStandOffTheModes) {
  const Case c;
  const MatrixXd all = twindeck::dynamics::static_corrections(c.factor, c.m, c.modes, c.patterns(), 9);
  EXPECT_EQ(all.cols(), 3);
  EXPECT_LT((c.modes.transpose() * (c.m.selfadjointView<Eigen::Lower>() * all)).cwiseAbs().maxCoeff(), 1e-9);
  const auto missing = [&](int count) {
    const ReducedBasis basis = twindeck::dynamics::reduced_basis(
        c.k, c.m, c.modes, twindeck::dynamics::static_corrections(c.factor, c.m, c.modes, c.patterns(), count));
    const MatrixXd loads = basis.vectors.transpose() * c.patterns();
    return (c.patterns().transpose() * c.factor.solve(c.patterns())).trace() -
           (loads.transpose() * basis.omega_rad_s.cwiseAbs2().cwiseInverse().asDiagonal() * loads).trace();
  };
  EXPECT_GT(missing(0), missing(1));
  EXPECT_GT(missing(1), missing(2));
  EXPECT_NEAR(missing(3) / missing(0), 0.0, 1e-9);
}

TEST(ReducedBasis, DropsShapesThatAreThereAlready) {
  const Case c;
  MatrixXd shapes(60, 2);
  shapes << c.modes.col(1) + 2.0 * c.modes.col(3), c.factor.solve(c.patterns().col(0));
  EXPECT_EQ(twindeck::dynamics::reduced_basis(c.k, c.m, c.modes, shapes).vectors.cols(), 5);
}

}  // namespace
