// Oracles: the rank of a matrix of columns that is written down; a coordinate without stiffness and mass; a soft mode, whose
// frequency is a low one but a real one.
#include "diagnosis/reduction/independent_coordinates.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>

namespace twindeck::tests {
namespace {

using diagnosis::independent_coordinates;
using Eigen::Index;
using Eigen::MatrixXd;

/// Stiffness and mass of a structure of six degrees of freedom in some columns.
struct InColumns {
  explicit InColumns(const MatrixXd& of) : columns(of) {
    const MatrixXd k0 = Eigen::VectorXd::LinSpaced(6, 1.0, 6.0).asDiagonal();
    stiffness = of.transpose() * k0 * of;
    mass = 0.01 * of.transpose() * of;
  }
  [[nodiscard]] Index rank_of(const std::vector<Index>& kept) const {
    return Eigen::ColPivHouseholderQR<MatrixXd>(columns(Eigen::all, kept)).rank();
  }
  MatrixXd columns, stiffness, mass;
};

MatrixXd first_columns(Index n) { return MatrixXd::Identity(6, n); }

TEST(IndependentCoordinates, AllStayWhereNoneDependsOnOthers) {
  MatrixXd v = first_columns(4);
  v.col(3) += 0.9 * v.col(0) + 0.5 * v.col(1);
  const InColumns here(v);
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2), (std::vector<Index>{0, 1, 2, 3}));
}

TEST(IndependentCoordinates, WhatStaysSpansTheOthers) {
  MatrixXd v(6, 7);
  v << first_columns(4), MatrixXd::Zero(6, 3);
  v.col(4) = v.col(2) - 2.0 * v.col(3);               // of two own ones
  v.col(5) = v.col(0) + v.col(1);                     // of common ones
  v.col(6) = Eigen::VectorXd::Unit(6, 5) + v.col(2);  // brings a motion of its own
  const InColumns here(v);
  const std::vector<Index> kept = independent_coordinates(here.stiffness, here.mass, 2);
  EXPECT_EQ(kept.size(), 5u);
  EXPECT_EQ(here.rank_of(kept), 5);
  EXPECT_EQ(kept[0], 0);
  EXPECT_EQ(kept[1], 1);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 5), 0);
}

/// Each of the columns depends on the others to one part in a hundred only, all of them together do wholly.
TEST(IndependentCoordinates, ColumnsThatAreNearlyAlikeAreNotTakenForMoreThanTheySpan) {
  MatrixXd v(6, 8);
  v << first_columns(2), MatrixXd::Zero(6, 6);
  for (Index k = 2; k < 8; ++k) {
    const auto x = static_cast<double>(k - 2);
    v.col(k) << 0.0, 0.0, 1.0, 0.01 * x, 1e-4 * x * x, 1e-6 * x * x * x;
  }
  const InColumns here(v);
  const std::vector<Index> kept = independent_coordinates(here.stiffness, here.mass, 2);
  // The last direction has one part in 1e12 of the energy: it is none that these matrices could tell.
  EXPECT_GE(kept.size(), 4u);
  EXPECT_LE(kept.size(), 5u);
}

TEST(IndependentCoordinates, MotionThatNothingHoldsAndThatHasNoMassIsLeftOut) {
  InColumns here(first_columns(5));
  here.stiffness.row(3).setZero();
  here.stiffness.col(3).setZero();
  here.mass.row(3).setZero();
  here.mass.col(3).setZero();
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2), (std::vector<Index>{0, 1, 2, 4}));
}

TEST(IndependentCoordinates, ASoftModeStays) {
  InColumns here(first_columns(5));
  here.stiffness(3, 3) = 1e-12;
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2).size(), 5u);
  here.stiffness(3, 3) = 0.0;  // and motion that is free
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2).size(), 5u);
}

TEST(IndependentCoordinates, AllStayWhereTheStiffnessIsNegative) {
  MatrixXd v(6, 5);
  v << first_columns(4), MatrixXd::Zero(6, 1);
  v.col(4) = v.col(3);
  InColumns here(v);
  here.stiffness(2, 2) = -30.0;
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2).size(), 5u);
  here = InColumns(v);
  here.stiffness(1, 1) = -30.0;  // among the common ones
  EXPECT_EQ(independent_coordinates(here.stiffness, here.mass, 2).size(), 5u);
}

}  // namespace
}  // namespace twindeck::tests
