/// Oracles: exactness. Static shapes in the basis make the static answer exact; the modes that were put in come out; the full
/// chain's own answer to a harmonic load.
#include "transient/reduced_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "dynamics/eigenmodes.hpp"
#include "unit/dynamics/spring_chain.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using twindeck::tests::SpringChain;
using twindeck::transient::ReducedBasis;

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
  const ReducedBasis basis = twindeck::transient::reduced_basis(c.k, c.m, c.modes, c.factor.solve(c.patterns()));
  ASSERT_EQ(basis.vectors.cols(), 7);
  for (int j = 0; j < 4; ++j) EXPECT_NEAR(basis.omega_rad_s[j], std::sqrt(SpringChain{.n = 60}.eigenvalue(j + 1)), 1e-9);
  const MatrixXd mass = basis.vectors.transpose() * (c.m.selfadjointView<Eigen::Lower>() * basis.vectors);
  EXPECT_LT((mass - MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-9);
  const MatrixXd exact = c.factor.solve(c.patterns());
  const MatrixXd reduced =
      basis.vectors * basis.omega_rad_s.cwiseAbs2().cwiseInverse().asDiagonal() * (basis.vectors.transpose() * c.patterns());
  EXPECT_LT((exact - reduced).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ReducedBasis, CorrectionsHoldMostOfTheEnergyAndStandOffTheModes) {
  const Case c;
  const MatrixXd all = twindeck::transient::static_corrections(c.factor, c.m, c.modes, c.patterns(), 9);
  EXPECT_EQ(all.cols(), 3);
  EXPECT_LT((c.modes.transpose() * (c.m.selfadjointView<Eigen::Lower>() * all)).cwiseAbs().maxCoeff(), 1e-9);
  const auto missing = [&](int count) {
    const ReducedBasis basis = twindeck::transient::reduced_basis(
        c.k, c.m, c.modes, twindeck::transient::static_corrections(c.factor, c.m, c.modes, c.patterns(), count));
    const MatrixXd loads = basis.vectors.transpose() * c.patterns();
    return (c.patterns().transpose() * c.factor.solve(c.patterns())).trace() -
           (loads.transpose() * basis.omega_rad_s.cwiseAbs2().cwiseInverse().asDiagonal() * loads).trace();
  };
  EXPECT_GT(missing(0), missing(1));
  EXPECT_GT(missing(1), missing(2));
  EXPECT_NEAR(missing(3) / missing(0), 0.0, 1e-9);
}

TEST(ReducedBasis, APointsOwnShapeMakesItsSlowMotionExactUnderEveryLoad) {
  // By reciprocity: e' K^-1 P = (K^-1 e)' P, wherever the load acts. With g generations of shapes of the point on one side of
  // the transfer function, the error of the point's motion falls with omega^(2 g).
  const Case c;
  MatrixXd point = MatrixXd::Zero(60, 1), load = MatrixXd::Zero(60, 1);
  point(3, 0) = 1.0;
  load(11, 0) = 1.0;
  const auto error = [&](int generations, double omega) {
    const ReducedBasis basis = twindeck::transient::reduced_basis(
        c.k, c.m, c.modes, twindeck::transient::krylov_shapes(c.factor, c.m, point, generations));
    EXPECT_EQ(basis.vectors.cols(), 4 + generations);
    const VectorXd stiffness = basis.omega_rad_s.cwiseAbs2().array() - omega * omega;
    const double reduced =
        ((basis.vectors.transpose() * point).cwiseQuotient(stiffness).transpose() * (basis.vectors.transpose() * load))(0, 0);
    const MatrixXd lower = MatrixXd(c.k) - omega * omega * MatrixXd(c.m);
    const MatrixXd dynamic = lower.selfadjointView<Eigen::Lower>();
    const double exact = (point.transpose() * dynamic.lu().solve(load))(0, 0);
    return std::abs(reduced / exact - 1.0);
  };
  const double omega = 0.2 * std::sqrt(SpringChain{.n = 60}.eigenvalue(1));
  EXPECT_GT(error(0, omega), 1e-2);  // the modes alone
  EXPECT_LT(error(1, 1e-6 * omega), 1e-9);
  EXPECT_NEAR(error(1, omega) / error(1, 0.5 * omega), 4.0, 0.4);
  EXPECT_NEAR(error(2, omega) / error(2, 0.5 * omega), 16.0, 2.0);
}

TEST(ReducedBasis, APointOnASupportHasNoShape) {
  const Case c;
  MatrixXd patterns = MatrixXd::Zero(60, 2);
  EXPECT_EQ(twindeck::transient::krylov_shapes(c.factor, c.m, patterns, 2).cols(), 0);
  patterns(20, 1) = 1.0;
  EXPECT_EQ(twindeck::transient::krylov_shapes(c.factor, c.m, patterns, 2).cols(), 2);
}

TEST(ReducedBasis, DropsShapesThatAreThereAlready) {
  const Case c;
  MatrixXd shapes(60, 2);
  shapes << c.modes.col(1) + 2.0 * c.modes.col(3), c.factor.solve(c.patterns().col(0));
  EXPECT_EQ(twindeck::transient::reduced_basis(c.k, c.m, c.modes, shapes).vectors.cols(), 5);
}

}  // namespace
