#include "linalg/generalized_eigen.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <vector>

#include "inertia.hpp"

namespace {

using twindeck::linalg::Cholesky;
using twindeck::linalg::EigenPairs;
using twindeck::linalg::lowest_eigenpairs;
using twindeck::linalg::SparseMatrix;

SparseMatrix from(int n, const std::vector<Eigen::Triplet<double>>& entries) {
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

SparseMatrix diagonal(const Eigen::VectorXd& d) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < d.size(); ++i) entries.emplace_back(i, i, d[i]);
  return from(static_cast<int>(d.size()), entries);
}

/// `copies` chains of n masses m between n + 1 springs k, fixed at both ends: lambda_j = 4 k/m sin²(j pi / (2 (n + 1))).
SparseMatrix chains(int n, int copies, double k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < copies; ++c) {
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(c * n + i, c * n + i, 2.0 * k);
      if (i > 0) entries.emplace_back(c * n + i, c * n + i - 1, -k);
    }
  }
  return from(n * copies, entries);
}

double chain_eigenvalue(int j, int n, double k, double m) {
  return 4.0 * k / m * std::pow(std::sin(j * std::numbers::pi / (2.0 * (n + 1))), 2);
}

void expect_residuals(const SparseMatrix& k, const SparseMatrix& m, const EigenPairs& pairs, double tolerance) {
  const Eigen::MatrixXd kx = k.selfadjointView<Eigen::Lower>() * pairs.vectors;
  const Eigen::MatrixXd mx = m.selfadjointView<Eigen::Lower>() * pairs.vectors;
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    EXPECT_LT((kx.col(i) - pairs.values[i] * mx.col(i)).norm(), tolerance * (pairs.values[i] * mx.col(i)).norm())
        << "pair " << i;
  }
  const Eigen::MatrixXd gram = pairs.vectors.transpose() * mx;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-10);
}

// Oracle: closed form of the chain, dense branch (n = 12) and Lanczos (n = 500).
TEST(LowestEigenpairs, MeetTheChainInClosedForm) {
  for (const int n : {12, 500}) {
    const SparseMatrix k = chains(n, 1, 3e4), m = diagonal(Eigen::VectorXd::Constant(n, 2.5));
    Cholesky factor;
    const EigenPairs pairs = lowest_eigenpairs(k, m, 10, 0.0, factor);
    ASSERT_TRUE(pairs.status.converged) << pairs.status.message;
    for (int j = 1; j <= 10; ++j) {
      EXPECT_NEAR(pairs.values[j - 1] / chain_eigenvalue(j, n, 3e4, 2.5), 1.0, 1e-11) << "n " << n << " mode " << j;
    }
    expect_residuals(k, m, pairs, 1e-7);
    for (Eigen::Index i = 0; i < 10; ++i)
      EXPECT_GT(pairs.vectors.col(i).maxCoeff(), (1.0 - 1e-9) * -pairs.vectors.col(i).minCoeff());
  }
}

// Oracle: closed form. A chain whose last mass is 1e9 times the others: that mass moves alone on the springs beside it, and the
// others are a chain of their own. Eigenvalues span ten decades, in the dense branch (n = 12).
TEST(LowestEigenpairs, SpanTenDecadesWhereMembersAreAllButMassless) {
  const int n = 12;
  const double k = 3e4, heavy = 2.5, light = 2.5e-9;
  Eigen::VectorXd masses = Eigen::VectorXd::Constant(n, light);
  masses[n - 1] = heavy;
  Cholesky factor;
  const EigenPairs pairs = lowest_eigenpairs(chains(n, 1, k), diagonal(masses), n, 0.0, factor);
  ASSERT_TRUE(pairs.status.converged) << pairs.status.message;
  EXPECT_NEAR(pairs.values[0] / ((k + k / n) / heavy), 1.0, 1e-6);
  for (int j = 1; j < n; ++j) EXPECT_NEAR(pairs.values[j] / chain_eigenvalue(j, n - 1, k, light), 1.0, 1e-5) << "mode " << j;
}

// Oracle: closed form. Three chains of 200: every eigenvalue three times, none may be passed over.
TEST(LowestEigenpairs, FindEveryCopyOfRepeatedEigenvalues) {
  const int n = 200;
  const SparseMatrix k = chains(n, 3, 1.0), m = diagonal(Eigen::VectorXd::Ones(3 * n));
  Cholesky factor;
  const EigenPairs pairs = lowest_eigenpairs(k, m, 12, 0.0, factor);
  ASSERT_TRUE(pairs.status.converged);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(pairs.values[i] / chain_eigenvalue(i / 3 + 1, n, 1.0, 1.0), 1.0, 1e-11);
  expect_residuals(k, m, pairs, 1e-7);
}

// Oracle: closed form. A hundred equal oscillators: the first block spans an invariant subspace and the rest needs new starts.
TEST(LowestEigenpairs, GoOnFromAnInvariantSubspace) {
  const SparseMatrix k = diagonal(Eigen::VectorXd::Constant(100, 9.0)), m = diagonal(Eigen::VectorXd::Ones(100));
  Cholesky factor;
  const EigenPairs pairs = lowest_eigenpairs(k, m, 10, 0.0, factor);
  ASSERT_TRUE(pairs.status.converged) << pairs.status.message;
  EXPECT_LT((pairs.values.array() - 9.0).abs().maxCoeff(), 1e-10);
  expect_residuals(k, m, pairs, 1e-9);
}

// Oracle: static condensation. A chain whose every second mass is nil is the chain of half as many masses on springs k/2.
TEST(LowestEigenpairs, AcceptDofsWithoutMass) {
  for (const int half : {10, 150}) {
    const int n = 2 * half + 1;
    Eigen::VectorXd masses = Eigen::VectorXd::Zero(n);
    for (int i = 1; i < n; i += 2) masses[i] = 2.0;
    const SparseMatrix k = chains(n, 1, 100.0), m = diagonal(masses);
    Cholesky factor;
    const EigenPairs pairs = lowest_eigenpairs(k, m, 6, 0.0, factor);
    ASSERT_TRUE(pairs.status.converged) << pairs.status.message;
    for (int j = 1; j <= 6; ++j) EXPECT_NEAR(pairs.values[j - 1] / chain_eigenvalue(j, half, 50.0, 2.0), 1.0, 1e-11);
    expect_residuals(k, m, pairs, 1e-7);
  }
}

// Oracle: by construction. Three masses on five dofs have three modes; asked for four, the solver says so and gives the three.
TEST(LowestEigenpairs, SayHowManyThereAre) {
  const SparseMatrix k = chains(5, 1, 1.0), m = diagonal((Eigen::VectorXd(5) << 1.0, 0.0, 1.0, 0.0, 1.0).finished());
  Cholesky factor;
  const EigenPairs pairs = lowest_eigenpairs(k, m, 4, 0.0, factor);
  EXPECT_FALSE(pairs.status.converged);
  EXPECT_EQ(pairs.values.size(), 3);
  EXPECT_NE(pairs.status.message.find("3 of 4"), std::string::npos) << pairs.status.message;
}

// Oracle: closed form. A free chain has a rigid mode at zero; with a negative shift it comes out with the others
// (free-free chain of n equal masses: lambda_j = 4 k/m sin²(j pi / (2 n)), j = 0, 1, ...).
TEST(LowestEigenpairs, FindRigidModesWithANegativeShift) {
  const int n = 300;
  SparseMatrix k = chains(n, 1, 8.0);
  k.coeffRef(0, 0) = k.coeffRef(n - 1, n - 1) = 8.0;
  const SparseMatrix m = diagonal(Eigen::VectorXd::Ones(n));
  Cholesky factor;
  EXPECT_FALSE(lowest_eigenpairs(k, m, 5, 0.0, factor).status.converged);
  const EigenPairs pairs = lowest_eigenpairs(k, m, 5, -1e-3, factor);
  ASSERT_TRUE(pairs.status.converged);
  for (int j = 0; j < 5; ++j) {
    EXPECT_NEAR(pairs.values[j], 32.0 * std::pow(std::sin(j * std::numbers::pi / (2.0 * n)), 2), 1e-12);
  }
}

/// K^-1 for Spectra, through Eigen's own Cholesky, so that the peer shares no code with ours.
struct PeerInverse {
  using Scalar = double;
  explicit PeerInverse(const SparseMatrix& k) : factor(k) {}
  Eigen::Index rows() const { return factor.rows(); }
  Eigen::Index cols() const { return factor.cols(); }
  void set_shift(const double&) {}
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()) = factor.solve(Eigen::Map<const Eigen::VectorXd>(x, rows()));
  }
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factor;
};
struct PeerMass {
  using Scalar = double;
  explicit PeerMass(const SparseMatrix& m) : matrix(m) {}
  Eigen::Index rows() const { return matrix.rows(); }
  Eigen::Index cols() const { return matrix.cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()) =
        matrix.selfadjointView<Eigen::Lower>() * Eigen::Map<const Eigen::VectorXd>(x, rows());
  }
  const SparseMatrix& matrix;
};

/// Membrane of m × m/2 points with uneven stiffness and a mass that couples neighbours.
std::pair<SparseMatrix, SparseMatrix> membrane(int m) {
  std::vector<Eigen::Triplet<double>> k, mass;
  const int rows = m / 2;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < m; ++j) {
      const int at = i * m + j;
      const double s = 1.0 + 0.5 * std::sin(0.37 * i + 0.11 * j);
      k.emplace_back(at, at, 4.0 * s + 0.5);
      mass.emplace_back(at, at, 1.0 + 0.2 * std::cos(0.3 * j));
      if (j > 0) k.emplace_back(at, at - 1, -0.5 * s), mass.emplace_back(at, at - 1, 0.1);
      if (i > 0) k.emplace_back(at, at - m, -0.5 * s), mass.emplace_back(at, at - m, 0.1);
    }
  }
  return {from(m * rows, k), from(m * rows, mass)};
}

// Oracle: Spectra 1.0, an independent implementation, and Sylvester's law of inertia.
TEST(LowestEigenpairs, AgreeWithSpectraAndWithTheInertia) {
  const auto [k, m] = membrane(60);
  Cholesky factor;
  const EigenPairs ours = lowest_eigenpairs(k, m, 12, 0.0, factor);
  ASSERT_TRUE(ours.status.converged);
  PeerInverse inverse(k);
  PeerMass mass(m);
  Spectra::SymGEigsShiftSolver<PeerInverse, PeerMass, Spectra::GEigsMode::ShiftInvert> peer(inverse, mass, 12, 30, 0.0);
  peer.init();
  ASSERT_EQ(peer.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge), 12);
  EXPECT_LT(((ours.values - peer.eigenvalues()).array() / peer.eigenvalues().array()).abs().maxCoeff(), 1e-10);
  EXPECT_EQ(count_eigenvalues_below(k, m, 0.5 * (ours.values[10] + ours.values[11])), 11);
  expect_residuals(k, m, ours, 1e-7);
}

// Oracle: closed form of the chain.
TEST(CountEigenvaluesBelow, CountsTheChain) {
  const int n = 80;
  const SparseMatrix k = chains(n, 2, 1.0), m = diagonal(Eigen::VectorXd::Ones(2 * n));
  for (const int j : {1, 7, 40}) {
    const double between = 0.5 * (chain_eigenvalue(j, n, 1.0, 1.0) + chain_eigenvalue(j + 1, n, 1.0, 1.0));
    EXPECT_EQ(count_eigenvalues_below(k, m, between), 2 * j);
  }
}

// Oracle: a diagonal pencil, whose eigenvalues are its quotients; without mass there are none.
TEST(CountEigenvaluesBelow, RefusesAnEigenvalueItself) {
  const SparseMatrix k = diagonal(Eigen::Vector3d(2.0, 8.0, 18.0)), m = diagonal(Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(count_eigenvalues_below(k, m, 3.9), 1);
  EXPECT_EQ(count_eigenvalues_below(k, m, 4.1), 2);
  EXPECT_THROW((void)count_eigenvalues_below(k, m, 4.0), std::domain_error);
}

TEST(LowestEigenpairs, SayWhereNothingCarriesMass) {
  Cholesky factor;
  const EigenPairs pairs = lowest_eigenpairs(chains(5, 1, 1.0), SparseMatrix(5, 5), 2, 0.0, factor);
  EXPECT_FALSE(pairs.status.converged);
  EXPECT_NE(pairs.status.message.find("carries mass"), std::string::npos) << pairs.status.message;
  EXPECT_EQ(pairs.values.size(), 0);
}

}  // namespace
