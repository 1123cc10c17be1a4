// Projection on a fixed basis. Oracles: the full square basis, on which nothing is lost; central differences of Eigen's dense
// eigenvalues and shapes; closed forms of two springs; invariances of an orthonormal basis.
#include <gtest/gtest.h>

#include <cmath>

#include "chain.hpp"
#include "updating/surrogate.hpp"

namespace twindeck::updating {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Four masses without symmetry: parameter 0 scales two springs, parameter 1 two masses.
std::shared_ptr<const fe::ParametricSystem> four_masses(double fixed_spring = 50.0) {
  SmallSystem small(4);
  const int k = small.parameter("k", 1.0, 0.5, 2.0), m = small.parameter("m", 1.0, 0.5, 2.0);
  small.stiffness(30.0 * spring(4, 0, -1) + 20.0 * spring(4, 1, 2), k)
      .stiffness(fixed_spring * spring(4, 0, 1) + 45.0 * spring(4, 2, 3) + 70.0 * spring(4, 3, -1))
      .mass(Eigen::Vector4d(1.0, 0.0, 0.6, 0.0).asDiagonal().toDenseMatrix(), m)
      .mass(Eigen::Vector4d(1.0, 2.0, 1.5, 1.0).asDiagonal().toDenseMatrix());
  return std::make_shared<const fe::ParametricSystem>(small.system());
}

struct ReducedModes {
  VectorXd lambda;
  MatrixXd z;
};

/// ReducedModes of dense matrices by Eigen, each with its largest entry of `like` positive.
ReducedModes reduced_modes(const ReducedSystem& reduced, const VectorXd& theta, const MatrixXd* like = nullptr) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eig(reduced.stiffness(theta), reduced.mass(theta));
  ReducedModes out{eig.eigenvalues(), eig.eigenvectors()};
  for (Eigen::Index j = 0; like != nullptr && j < out.z.cols(); ++j)
    if (out.z.col(j).dot(like->col(j)) < 0.0) out.z.col(j) *= -1.0;
  return out;
}

std::shared_ptr<const MatrixXd> square_basis() {
  return std::make_shared<const MatrixXd>((MatrixXd(4, 4) << 1, 2, 0, 1, 0, 1, 3, -1, 2, 0, 1, 1, 1, -1, 0, 2).finished());
}

// Galerkin on the whole space: the eigenvalues are those of the system.
TEST(ReducedSystemOnTheWholeSpace, KeepsTheFrequencies) {
  const auto system = four_masses();
  const ReducedSystem reduced(system, square_basis(), nullptr);
  const VectorXd theta = Eigen::Vector2d(1.3, 0.7), exact = dense_frequencies(*system, theta);
  const ReducedModes modes = reduced_modes(reduced, theta);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::sqrt(modes.lambda(i)) / (2.0 * std::numbers::pi) / exact(i), 1.0, 1e-12);
}

// Rayleigh and Ritz: on fewer vectors no eigenvalue falls below the exact one of its place.
TEST(ReducedSystem, BoundsTheEigenvaluesFromAbove) {
  const auto system = four_masses();
  const auto basis = std::make_shared<const MatrixXd>(square_basis()->leftCols(2));
  const VectorXd theta = system->initial(), exact = dense_frequencies(*system, theta);
  const ReducedModes modes = reduced_modes(ReducedSystem(system, basis, nullptr), theta);
  for (int i = 0; i < 2; ++i) EXPECT_GE(std::sqrt(modes.lambda(i)) / (2.0 * std::numbers::pi), exact(i) * (1.0 - 1e-12));
}

// The error of the central difference is h²/6 of the third derivative, below 1e-7 of the value here.
TEST(ReducedSystem, DerivativesOfEigenvaluesAreThoseOfTheEigenvalues) {
  const ReducedSystem reduced(four_masses(), square_basis(), nullptr);
  const VectorXd theta = Eigen::Vector2d(1.2, 0.9);
  const ReducedModes at = reduced_modes(reduced, theta);
  const MatrixXd slope = reduced.eigenvalue_derivatives(theta, {1, 0}, at.lambda, at.z);  // in the order that was asked for
  for (int p = 0; p < 2; ++p) {
    const VectorXd h = 1e-4 * VectorXd::Unit(2, p);
    const VectorXd difference = (reduced_modes(reduced, theta + h).lambda - reduced_modes(reduced, theta - h).lambda) / 2e-4;
    EXPECT_LT((slope.col(1 - p) - difference).norm(), 1e-6 * difference.norm()) << p;
  }
}

TEST(ReducedSystem, DerivativesOfShapesAreThoseOfTheShapes) {
  const ReducedSystem reduced(four_masses(), square_basis(), nullptr);
  const VectorXd theta = Eigen::Vector2d(1.2, 0.9);
  const ReducedModes at = reduced_modes(reduced, theta);
  for (int p = 0; p < 2; ++p) {
    const VectorXd h = 1e-4 * VectorXd::Unit(2, p);
    const MatrixXd difference =
        (reduced_modes(reduced, theta + h, &at.z).z - reduced_modes(reduced, theta - h, &at.z).z) / 2e-4;
    const MatrixXd slope = reduced.shape_derivatives(theta, p, at.lambda, at.z, 3);
    ASSERT_EQ(slope.cols(), 3);
    EXPECT_LT((slope - difference.leftCols(3)).norm(), 1e-6 * difference.norm()) << p;
  }
}

// Closed form: if all masses grow by a factor, shapes fall with its root, z = z0 / sqrt(m), also those of equal eigenvalues.
TEST(ReducedSystem, ShapesFallWithTheRootOfAllMasses) {
  SmallSystem small(3);
  const int m = small.parameter("m", 1.0, 0.5, 2.0);
  small.stiffness(Eigen::Vector3d(8.0, 8.0, 20.0).asDiagonal().toDenseMatrix()).mass(2.0 * MatrixXd::Identity(3, 3), m);
  const auto system = std::make_shared<const fe::ParametricSystem>(small.system());
  const ReducedSystem reduced(system, std::make_shared<const MatrixXd>(MatrixXd::Identity(3, 3)), nullptr);
  const VectorXd one = VectorXd::Ones(1), lambda = Eigen::Vector3d(4.0, 4.0, 10.0);
  const MatrixXd z = MatrixXd::Identity(3, 3) / std::sqrt(2.0);
  EXPECT_LT((reduced.shape_derivatives(one, 0, lambda, z, 3) + 0.5 * z).norm(), 1e-14);
  // lambda = k / m.
  EXPECT_LT((reduced.eigenvalue_derivatives(one, {0}, lambda, z).col(0) + lambda).norm(), 1e-13);
}

// A parameter without a say has no derivative.
TEST(ReducedSystem, DerivativesOfAParameterWithoutTermsVanish) {
  SmallSystem small(2);
  (void)small.parameter("idle", 1.0, 0.5, 2.0);
  small.stiffness(Eigen::Vector2d(3.0, 5.0).asDiagonal().toDenseMatrix()).mass(MatrixXd::Identity(2, 2));
  const ReducedSystem reduced(std::make_shared<const fe::ParametricSystem>(small.system()),
                              std::make_shared<const MatrixXd>(MatrixXd::Identity(2, 2)), nullptr);
  const VectorXd lambda = Eigen::Vector2d(3.0, 5.0);
  EXPECT_EQ(reduced.eigenvalue_derivatives(VectorXd::Ones(1), {0}, lambda, MatrixXd::Identity(2, 2)).norm(), 0.0);
  EXPECT_EQ(reduced.shape_derivatives(VectorXd::Ones(1), 0, lambda, MatrixXd::Identity(2, 2), 2).norm(), 0.0);
}

// Terms that differ from those of the projection to take over are projected anew.
TEST(ReducedSystem, TakesOverEqualTermsAlone) {
  const auto basis = square_basis();
  const ReducedSystem first(four_masses(50.0), basis, nullptr);
  const ReducedSystem second(four_masses(80.0), basis, &first), fresh(four_masses(80.0), basis, nullptr);
  const VectorXd theta = Eigen::Vector2d(1.1, 0.8);
  EXPECT_EQ(second.stiffness(theta), fresh.stiffness(theta));
  EXPECT_EQ(second.mass(theta), fresh.mass(theta));
  // The spring that grew by 30 N/m, in closed form.
  const MatrixXd more = 30.0 * basis->transpose() * spring(4, 0, 1) * *basis;
  EXPECT_LT((second.stiffness(theta) - first.stiffness(theta) - more).norm(), 1e-11);
}

// Property: Q'MQ = 1, and the vectors lie in the span of Q. A vector twice, and one of nothing but rounding, add no direction.
TEST(OrthonormalBasis, SpansTheVectorsOnce) {
  const auto system = four_masses();
  const linalg::SparseMatrix mass = system->mass(system->initial());
  const MatrixXd m = MatrixXd(mass).selfadjointView<Eigen::Lower>();
  MatrixXd vectors(4, 4);
  vectors.leftCols(2) = square_basis()->leftCols(2);
  vectors.col(2) = 3.0 * vectors.col(0);
  vectors.col(3) = vectors.col(1) + 1e-9 * VectorXd::Ones(4);
  const MatrixXd q = orthonormal_basis(vectors, mass, 1e-6);
  ASSERT_EQ(q.cols(), 2);
  EXPECT_LT((q.transpose() * m * q - MatrixXd::Identity(2, 2)).norm(), 1e-12);
  EXPECT_LT((vectors - q * (q.transpose() * m * vectors)).norm(), 1e-7);  // the dropped part is 1e-9 of the vectors
}

}  // namespace
}  // namespace twindeck::updating
