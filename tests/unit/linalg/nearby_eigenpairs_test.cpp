#include "linalg/nearby_eigenpairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linalg/generalized_eigen.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using twindeck::linalg::Cholesky;
using twindeck::linalg::EigenPairs;
using twindeck::linalg::lowest_eigenpairs;
using twindeck::linalg::nearby_eigenpairs;
using twindeck::linalg::NearbyEigenpairs;
using twindeck::linalg::SparseMatrix;
using twindeck::linalg::SymmetricProduct;

constexpr int kWanted = 10;

/// Stiffness and mass of slender beams side by side, `elements` Hermite elements each, clamped at one end; half of the
/// rotations without mass. Spectra as structures have them: widely spread, stiffness over twelve decades.
struct Beams {
  SparseMatrix stiffness, mass;
};

/// @param bending  of each beam @param uneven  what the bending stiffness of each third element differs by
Beams beams(int elements, const std::vector<double>& bending, double uneven = 0.0) {
  std::vector<Eigen::Triplet<double>> k, m;
  const double l = 1.0 / elements;
  for (std::size_t beam = 0; beam < bending.size(); ++beam) {
    for (int e = 0; e < elements; ++e) {
      const double ei = bending[beam] * (e % 3 == 0 ? 1.0 + uneven : 1.0);
      Eigen::Matrix4d ke, me;
      ke << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l,
          4 * l * l;
      ke *= ei / (l * l * l);
      me.setZero();
      me(0, 0) = me(2, 2) = 0.5 * l;
      if (e % 2 == 0) me(1, 1) = l * l * l / 24.0;
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j <= i; ++j) {
          const int row = 2 * e + i - 2, column = 2 * e + j - 2;  // the clamped node is left out
          if (column < 0) continue;
          const int first = static_cast<int>(beam) * 2 * elements;
          k.emplace_back(first + row, first + column, ke(i, j));
          m.emplace_back(first + row, first + column, me(i, j));
        }
      }
    }
  }
  const auto n = static_cast<int>(bending.size()) * 2 * elements;
  Beams out{SparseMatrix(n, n), SparseMatrix(n, n)};
  out.stiffness.setFromTriplets(k.begin(), k.end());
  out.mass.setFromTriplets(m.begin(), m.end());
  return out;
}

EigenPairs cold(const Beams& b, int n = kWanted) {
  Cholesky factor;
  return lowest_eigenpairs(b.stiffness, b.mass, n, 0.0, factor, MatrixXd(0, 0));
}

NearbyEigenpairs from(const MatrixXd& known, const Beams& b) {
  Cholesky factor;
  EXPECT_TRUE(factor.factorize(b.stiffness).converged);
  VectorXd further(known.rows());
  for (Eigen::Index i = 0; i < further.size(); ++i) further[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i * i % 977));
  return nearby_eigenpairs(b.stiffness, SymmetricProduct(b.mass), factor, kWanted, known, further);
}

/// Largest sine between a vector and the one of the same number, in the norm of M.
double largest_angle(const Beams& b, const MatrixXd& found, const MatrixXd& expected) {
  const MatrixXd cosine = expected.transpose() * (b.mass.selfadjointView<Eigen::Lower>() * found);
  return (1.0 - cosine.diagonal().array().square()).cwiseMax(0.0).sqrt().maxCoeff();
}

// Oracle: the solution without a neighbour, to what a stiffness of condition 1e11 lets either know. Changes from rounding to
// one that takes the spectrum elsewhere; known vectors with further ones beside them, and without.
TEST(NearbyEigenpairs, AreThoseFoundAfresh) {
  const Beams before = beams(400, {1.0, 1.7, 0.6});
  const EigenPairs known = cold(before);
  ASSERT_TRUE(known.status.converged);
  ASSERT_GT(known.space.cols(), kWanted);
  int last = 0;
  for (const double change : {0.0, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.3}) {
    const Beams after = beams(400, {1.0 + change, 1.7 * (1.0 - change), 0.6 * (1.0 + 0.5 * change)}, change);
    const EigenPairs expected = cold(after);
    for (const MatrixXd* start : {&known.space, &known.vectors}) {
      const NearbyEigenpairs found = from(*start, after);
      ASSERT_TRUE(found.converged) << change << ", " << start->cols() << " known";
      EXPECT_LT((found.values.array() / expected.values.array() - 1.0).abs().maxCoeff(), 1e-8) << change;
      EXPECT_LT(largest_angle(after, found.space.leftCols(kWanted), expected.vectors), 1e-5) << change;
      const MatrixXd x = found.space.leftCols(kWanted);
      const MatrixXd gram = x.transpose() * (after.mass.selfadjointView<Eigen::Lower>() * x);
      EXPECT_LT((gram - MatrixXd::Identity(kWanted, kWanted)).cwiseAbs().maxCoeff(), 1e-9) << change;
      if (start == &known.space) {
        EXPECT_GE(found.operations, last) << change;
        last = found.operations;
      }
    }
    if (change <= 0.01) {
      EXPECT_LT(from(known.space, after).operations, expected.operations) << change;
    }
  }
}

// Oracle: the solution without a neighbour, step after step from the space that the last one left.
TEST(NearbyEigenpairs, GoOnFromTheirOwnSpace) {
  MatrixXd space = cold(beams(300, {1.0, 1.4})).space;
  for (int step = 1; step <= 12; ++step) {
    const Beams now = beams(300, {1.0 + 0.02 * step, 1.4 - 0.03 * step}, 0.01 * step);
    const NearbyEigenpairs found = from(space, now);
    ASSERT_TRUE(found.converged) << step;
    EXPECT_LT((found.values.array() / cold(now).values.array() - 1.0).abs().maxCoeff(), 1e-8) << step;
    space = found.space;
  }
}

// Oracle: the solution without a neighbour. The second beam was so stiff that none of its modes was known, nothing couples it
// to the first, and it grows soft: its modes are found by the fixed vector, or it is said that the neighbour is too far.
TEST(NearbyEigenpairs, FindModesThatNobodyKnew) {
  const Beams before = beams(300, {1.0, 1e7});
  MatrixXd space = cold(before).space;
  space.bottomRows(space.rows() / 2).setZero();
  for (const double soft : {0.01, 0.5, 3.0, 40.0}) {
    const Beams after = beams(300, {1.01, soft});
    const EigenPairs expected = cold(after);
    const NearbyEigenpairs found = from(space, after);
    if (found.converged) {
      EXPECT_LT((found.values.array() / expected.values.array() - 1.0).abs().maxCoeff(), 1e-8) << soft;
    }
    Cholesky factor;
    const EigenPairs whole = lowest_eigenpairs(after.stiffness, after.mass, kWanted, 0.0, factor, space);
    ASSERT_TRUE(whole.status.converged) << soft;
    EXPECT_LT((whole.values.array() / expected.values.array() - 1.0).abs().maxCoeff(), 1e-8) << soft;
  }
}

// Oracle: by construction. Known vectors that are no neighbour's are given up, not waited for.
TEST(NearbyEigenpairs, GiveUpWhereNothingIsNear) {
  const Beams b = beams(400, {1.0, 1.7, 0.6});
  MatrixXd known(b.stiffness.rows(), kWanted);
  for (Eigen::Index i = 0; i < known.rows(); ++i)
    for (Eigen::Index j = 0; j < known.cols(); ++j) known(i, j) = std::cos(static_cast<double>((i * 7919 + j * 104729) % 6151));
  const NearbyEigenpairs found = from(known, b);
  if (found.converged) {
    EXPECT_LT((found.values.array() / cold(b).values.array() - 1.0).abs().maxCoeff(), 1e-8);
  } else {
    EXPECT_LE(found.operations, 11 + 8 * 9);
  }
}

}  // namespace
