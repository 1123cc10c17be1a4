/// Oracles: what the rule says, and that vectors turned at random within their cluster come back the same.
#include "linalg/canonical_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

namespace twindeck::linalg {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd orthonormal(Eigen::Index rows, Eigen::Index columns) {
  std::srand(7);  // Eigen's Random
  return Eigen::HouseholderQR<MatrixXd>(MatrixXd::Random(rows, columns)).householderQ() * MatrixXd::Identity(rows, columns);
}

TEST(CanonicalBasis, TheFirstOfEqualEntriesLeadsWhateverTheirLastDigit) {
  for (const double last_digit : {-1e-12, 0.0, 1e-12}) {
    const VectorXd magnitudes{{0.2, 0.9, 0.5, 0.9 + last_digit}};
    EXPECT_EQ(leading_entry(magnitudes), 1);
  }
  EXPECT_EQ(leading_entry(VectorXd{{0.9, 0.9001}}), 1);
}

TEST(CanonicalBasis, SignsDoNotHangOnTheLastDigit) {
  const VectorXd values{{1.0, 2.0}};
  for (const double last_digit : {-1e-12, 1e-12}) {
    MatrixXd vectors(3, 2);
    vectors << -0.5, 0.1, 0.5 + last_digit, 0.2, 0.1, -0.7;
    choose_basis(values, vectors);
    EXPECT_EQ(vectors(0, 0), 0.5);
    EXPECT_EQ(vectors(2, 1), 0.7);
  }
}

TEST(CanonicalBasis, TurnedVectorsOfOneValueComeBack) {
  const VectorXd values{{1.0, 4.0, 4.0 * (1.0 + 1e-10), 4.0 * (1.0 + 2e-10), 9.0}};
  MatrixXd wanted = orthonormal(12, 5);
  choose_basis(values, wanted);
  EXPECT_LT((wanted.transpose() * wanted - MatrixXd::Identity(5, 5)).norm(), 1e-14);
  MatrixXd turned = wanted;
  turned.middleCols(1, 3) = (turned.middleCols(1, 3) * orthonormal(3, 3)).eval();
  turned.col(4) *= -1.0;
  ASSERT_GT((turned - wanted).norm(), 0.5);
  choose_basis(values, turned);
  EXPECT_LT((turned - wanted).norm(), 1e-13);
}

TEST(CanonicalBasis, CloseModesThatAreNotEqualAreLeft) {
  const VectorXd values{{4.0, 4.0 * (1.0 + 1e-6)}};
  MatrixXd vectors = orthonormal(8, 2);
  const MatrixXd before = vectors.cwiseAbs();
  choose_basis(values, vectors);
  EXPECT_EQ((vectors.cwiseAbs() - before).norm(), 0.0);
}

}  // namespace
}  // namespace twindeck::linalg
