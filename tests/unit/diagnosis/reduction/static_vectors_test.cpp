// Oracles: responses by dense matrices; orthonormality in K; the flexibility of springs in series.
#include "diagnosis/reduction/static_vectors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "dynamics/eigenmodes.hpp"
#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Place;
using diagnosis::StaticVectors;
using diagnosis::Symmetric;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRow = 40, kLowModes = 6;
constexpr double kOrthonormal = 1e-9;  // twice orthogonalised; K has a condition of some thousands

VectorXd unequal_springs() {
  VectorXd spring(kRow + 1);
  for (Index i = 0; i <= kRow; ++i) spring[i] = 2e6 * (1.0 + 0.3 * std::sin(1.7 * static_cast<double>(i)));
  return spring;
}

/// Forty masses in a row; the twelfth spring is a parameter.
class RowOfMasses {
 public:
  explicit RowOfMasses(bool with_parameter = false)
      : stiffness(springs_in_a_row(unequal_springs())),
        model(nodes_in_a_row(kRow), stiffness - (with_parameter ? twelfth() : MatrixXd::Zero(kRow, kRow)),
              1000.0 * MatrixXd::Identity(kRow, kRow), parts(with_parameter)) {
    statics.factorize(model.structure());
    dynamics::ModalSolver solver(*model.structure().system);
    modes = solver.solve(model.structure().theta, kLowModes);
  }
  void make_common(const diagnosis::Places& places = {}, const diagnosis::ReductionOptions& options = {}) {
    statics.make_common(model.structure(), places, modes, options);
  }
  static MatrixXd twelfth() {
    VectorXd one = VectorXd::Zero(kRow + 1);
    one[12] = unequal_springs()[12];
    return springs_in_a_row(one);
  }

  MatrixXd stiffness;
  MatrixModel model;
  StaticVectors statics;
  dynamics::EigenModes modes;

 private:
  static std::vector<MatrixModel::Part> parts(bool with_parameter) {
    if (!with_parameter) return {};
    return {{{"k12", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.8, 1.2}, twelfth()}};
  }
};

Place node(int dof) {
  Place place;
  place.directions.resize(kRow, 1);
  place.directions.insert(dof, 0) = 1.0;
  return place;
}

Place factor_on(const MatrixXd& part) {
  Place place;
  place.stiffness = Symmetric(part.sparseView());
  return place;
}

/// Part of vectors that others, orthonormal in K, do not span, in the norm of K.
double beyond(const MatrixXd& k, const MatrixXd& basis, const MatrixXd& x) {
  const MatrixXd rest = x - basis * (basis.transpose() * k * x);
  return std::sqrt((rest.transpose() * k * rest).trace() / (x.transpose() * k * x).trace());
}

MatrixXd beside(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd out(a.rows(), a.cols() + b.cols());
  out << a, b;
  return out;
}

TEST(StaticVectors, AreOrthonormalInTheStiffness) {
  RowOfMasses row;
  row.make_common();
  const MatrixXd all = beside(row.statics.common(), row.statics.own_vectors(node(17), 3));
  ASSERT_EQ(all.cols(), kLowModes + 1);
  EXPECT_LT((all.transpose() * row.stiffness * all - MatrixXd::Identity(all.cols(), all.cols())).norm(), kOrthonormal);
}

TEST(StaticVectors, HoldTheModes) {
  RowOfMasses row;
  row.make_common();
  EXPECT_LT(beyond(row.stiffness, row.statics.common(), row.modes.shapes), kOrthonormal);
}

TEST(StaticVectors, OfANodeHoldTheResponseToAForce) {
  RowOfMasses row;
  row.make_common();
  const MatrixXd response = row.stiffness.llt().solve(MatrixXd::Identity(kRow, kRow).col(17));
  EXPECT_GT(beyond(row.stiffness, row.statics.common(), response), 0.1);  // the modes alone do not
  EXPECT_LT(beyond(row.stiffness, beside(row.statics.common(), row.statics.own_vectors(node(17), 3)), response), kOrthonormal);
}

TEST(StaticVectors, OfMoreForcesThanAreAnsweredAtOnceHoldTheResponses) {
  RowOfMasses row;
  row.make_common();
  Place line;  // 600 unit forces, the last fifty elsewhere
  line.directions.resize(kRow, 600);
  for (int k = 0; k < 600; ++k) line.directions.insert(k < 550 ? 17 : 30, k) = 1.0;
  const MatrixXd own = row.statics.own_vectors(line, 3);
  EXPECT_EQ(own.cols(), 2);
  MatrixXd forces = MatrixXd::Zero(kRow, 2);
  forces(17, 0) = forces(30, 1) = 1.0;
  const MatrixXd response = row.stiffness.llt().solve(forces);
  EXPECT_LT(beyond(row.stiffness, beside(row.statics.common(), own), response), 1e-6);
}

TEST(StaticVectors, OfAFactorHoldTheResponseToItsForces) {
  // A spring has one force, whatever the number of modes; two springs have two.
  RowOfMasses row;
  row.make_common();
  VectorXd two = VectorXd::Zero(kRow + 1);
  two[5] = two[30] = 2e6;
  for (const auto& [part, count] : {std::pair<MatrixXd, Index>{RowOfMasses::twelfth(), 1}, {springs_in_a_row(two), 2}}) {
    const MatrixXd own = row.statics.own_vectors(factor_on(part), 3);
    EXPECT_EQ(own.cols(), count);
    const MatrixXd response = row.stiffness.llt().solve(part * row.modes.shapes);
    EXPECT_LT(beyond(row.stiffness, beside(row.statics.common(), own), response), 1e-6);  // a block's tolerance
  }
}

TEST(StaticVectors, AreAtMostAsManyAsAskedForAndTheStrongestFirst) {
  // One of three: no other vector beyond the common ones holds more of the responses.
  RowOfMasses row;
  row.make_common();
  VectorXd three = VectorXd::Zero(kRow + 1);
  three[5] = three[30] = three[22] = 2e6;
  const Place place = factor_on(springs_in_a_row(three));
  const MatrixXd one = row.statics.own_vectors(place, 1), all = row.statics.own_vectors(place, 3);
  ASSERT_EQ(one.cols(), 1);
  ASSERT_EQ(all.cols(), 3);
  const MatrixXd response = row.stiffness.llt().solve(springs_in_a_row(three) * row.modes.shapes);
  const MatrixXd in_all = all.transpose() * row.stiffness * response;  // (3 × modes)
  const double largest = in_all.jacobiSvd().singularValues()[0];
  EXPECT_NEAR((one.transpose() * row.stiffness * response).norm() / largest, 1.0, 1e-9);
}

TEST(StaticVectors, OfNoForcesAreNone) {
  RowOfMasses row;
  row.make_common();
  EXPECT_EQ(row.statics.own_vectors(node(3), 0).cols(), 0);
  EXPECT_EQ(row.statics.own_vectors(Place{}, 3).cols(), 0);
}

TEST(StaticVectors, CommonOnesHoldTheResponseToADamper) {
  diagnosis::Places places;
  places.sets["dampers"] = {node(20)};
  RowOfMasses row;
  row.make_common(places);
  EXPECT_EQ(row.statics.common().cols(), kLowModes + 1);
  const MatrixXd response = row.stiffness.llt().solve(MatrixXd::Identity(kRow, kRow).col(20));
  EXPECT_LT(beyond(row.stiffness, row.statics.common(), response), kOrthonormal);
}

TEST(StaticVectors, CommonOnesHoldWhatAParameterDoes) {
  // dK of a parameter that scales one spring is that spring.
  RowOfMasses row(true);
  row.make_common();
  EXPECT_EQ(row.statics.common().cols(), kLowModes + 1);
  const MatrixXd response = row.stiffness.llt().solve(RowOfMasses::twelfth() * row.modes.shapes);
  EXPECT_LT(beyond(row.stiffness, row.statics.common(), response), 1e-6);
  RowOfMasses without(true);
  diagnosis::ReductionOptions none;
  none.parameter_vectors = 0;
  without.make_common({}, none);
  EXPECT_EQ(without.statics.common().cols(), kLowModes);
}

TEST(StaticVectors, RecipeMakesTheSameVectors) {
  RowOfMasses row;
  row.make_common();
  const Place spring = factor_on(RowOfMasses::twelfth()), force = node(9);
  for (const Place* place : {&spring, &force}) {
    const MatrixXd own = row.statics.own_vectors(*place, 3), again = row.statics.recipe(*place, 3)();
    ASSERT_EQ(own.cols(), again.cols());
    EXPECT_LT((own - again).norm(), 1e-9 * own.norm());
  }
}

TEST(StaticVectors, DriveStiffnessIsThatOfTheSpringsOnEitherSide) {
  // To the left of a mass the springs are in series, to the right too; both sides add.
  const RowOfMasses row;
  const VectorXd flexible = unequal_springs().cwiseInverse();
  for (const int dof : {0, 13, kRow - 1}) {
    const double expected = 1.0 / flexible.head(dof + 1).sum() + 1.0 / flexible.tail(kRow - dof).sum();
    EXPECT_NEAR(row.statics.drive_stiffness(node(dof).directions) / expected, 1.0, 1e-10) << dof;
  }
  // Of two directions: the mean of their flexibilities.
  Eigen::SparseMatrix<double> both(kRow, 2);
  both.insert(0, 0) = both.insert(13, 1) = 1.0;
  const double mean =
      0.5 / row.statics.drive_stiffness(node(0).directions) + 0.5 / row.statics.drive_stiffness(node(13).directions);
  EXPECT_NEAR(row.statics.drive_stiffness(both) * mean, 1.0, 1e-10);
}

TEST(StaticVectors, OfAFreeStructureAreThoseOfAStiffnessThatIsShifted) {
  // K + shift M with a small shift: the rigid body's energy is that of the shift alone.
  VectorXd spring = VectorXd::Constant(7, 2e6);
  spring[0] = spring[6] = 0.0;
  const MatrixXd k = springs_in_a_row(spring), m = 1000.0 * MatrixXd::Identity(6, 6);
  const MatrixModel model(nodes_in_a_row(6), k, m);
  StaticVectors statics;
  statics.factorize(model.structure());
  const MatrixXd added = MatrixXd(statics.stiffness()) - k;
  const double shift = added(0, 0) / 1000.0;
  EXPECT_GT(shift, 0.0);
  EXPECT_LT(shift, 1e-3 * 2e6 / 1000.0);
  EXPECT_LT((added - shift * m).norm(), 1e-9 * k.norm());
}

TEST(StaticVectors, AStructureThatFallsIsRefused) {
  // A dof with neither stiffness nor mass is no rigid-body motion that a shift can hold.
  MatrixXd k = springs_in_a_row(VectorXd::Constant(5, 2e6)), m = 1000.0 * MatrixXd::Identity(4, 4);
  k.row(2).setZero();
  k.col(2).setZero();
  m(2, 2) = 0.0;
  const MatrixModel model(nodes_in_a_row(4), k, m);
  StaticVectors statics;
  EXPECT_THROW(statics.factorize(model.structure()), InputError);
}

}  // namespace
}  // namespace twindeck::tests
