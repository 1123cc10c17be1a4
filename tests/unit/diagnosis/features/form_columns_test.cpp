// Columns of the form error. Oracles: an eigenproblem whose stiffness is perturbed, by central differences; what the columns
// are said to be, entry by entry.
#include "diagnosis/features/form_columns.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace twindeck::tests {
namespace {

using diagnosis::FormColumns;
using diagnosis::ModelModes;
using diagnosis::PairedMode;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Eigenmodes {
  VectorXd omega;
  MatrixXd shapes;  // mass-normalised
};

Eigenmodes modes_of(const MatrixXd& k, const MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(k, m);
  return {eigen.eigenvalues().cwiseSqrt(), eigen.eigenvectors()};
}

/// Six masses in a row with uneven springs; modes well apart.
struct Small {
  MatrixXd k, m;
  Small() {
    constexpr int n = 6;
    m = VectorXd::LinSpaced(n, 1.0, 2.0).asDiagonal();
    k = MatrixXd::Zero(n, n);
    for (int s = 0; s <= n; ++s) {
      VectorXd b = VectorXd::Zero(n);
      if (s > 0) b[s - 1] = -1.0;
      if (s < n) b[s] = 1.0;
      k += (1.0 + 0.3 * s) * b * b.transpose();
    }
  }
};

TEST(FormColumns, ShapesAreDerivativesOfAPerturbedEigenproblem) {
  const Small s;
  const Eigenmodes base = modes_of(s.k, s.m);
  const std::vector<int> channels = {0, 2, 3, 5};
  const ModelModes model{base.omega, base.shapes(channels, Eigen::all), MatrixXd::Identity(6, 6)};
  // Modes 1 and 3 measured at all channels, in two conditions, mode 1 with another sign and size.
  std::vector<PairedMode> paired;
  VectorXd predicted(18);
  const std::vector<double> size = {1.0, 1.0, -2.5, 0.7};
  for (int i = 0; i < 4; ++i) {
    PairedMode mode{i % 2 == 0 ? 0 : 2, i / 2, i == 0 ? 16 : i == 1 ? 17 : -1, {}, {}, 0, i % 2 == 0 ? 0 : 2};
    for (int c = 0; c < 4; ++c) {
      mode.shape_rows.push_back(4 * i + c);
      mode.shape_channels.push_back(c);
      predicted[4 * i + c] = size[static_cast<std::size_t>(i)] * model.shapes(c, mode.model_mode);
    }
    paired.push_back(mode);
  }
  predicted.tail(2) << std::log(base.omega[0]), std::log(base.omega[2]);
  const FormColumns form = diagnosis::form_columns({model}, paired, predicted);
  EXPECT_EQ(form.shape.cols(), 9);  // 5 + 5 pairs, the pair (1, 3) once
  ASSERT_EQ(form.frequency.cols(), 2);
  EXPECT_EQ(form.frequency.col(0), VectorXd::Unit(18, 16));
  EXPECT_EQ(form.frequency.col(1), VectorXd::Unit(18, 17));
  // dK = M Phi A Phi' M with A = w_i w_j in one pair: shapes by central differences, signs kept.
  int found = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      MatrixXd a = MatrixXd::Zero(6, 6);
      a(i, j) = a(j, i) = base.omega[i] * base.omega[j];
      const MatrixXd change = s.m * base.shapes * a * base.shapes.transpose() * s.m;
      constexpr double step = 1e-5;
      Eigenmodes up = modes_of(s.k + step * change, s.m), down = modes_of(s.k - step * change, s.m);
      for (Eigenmodes* moved : {&up, &down})
        for (int k = 0; k < 6; ++k)
          if (moved->shapes.col(k).dot(s.m * base.shapes.col(k)) < 0.0) moved->shapes.col(k) *= -1.0;
      const MatrixXd slope = ((up.shapes - down.shapes) / (2.0 * step))(channels, Eigen::all);
      VectorXd rows = VectorXd::Zero(18);
      for (std::size_t m = 0; m < 4; ++m)
        for (int c = 0; c < 4; ++c) rows[4 * static_cast<Index>(m) + c] = size[m] * slope(c, paired[m].model_mode);
      if (rows.norm() < 1e-6) continue;
      // Every such derivative is one of the columns.
      double nearest = 1e300;
      for (Index column = 0; column < 9; ++column)
        nearest = std::min(nearest, (form.shape.col(column) - rows).norm() / rows.norm());
      EXPECT_LT(nearest, 1e-6) << i << ' ' << j;
      ++found;
    }
  }
  EXPECT_EQ(found, 9);
}

TEST(FormColumns, AreThoseOfOneStiffnessInEveryState) {
  // In the second state the row has lost half of one spring and has a mass more, so that its modes are others. Oracle: the same
  // change of stiffness in that state's own eigenproblem, by central differences.
  const Small s;
  Small other;
  VectorXd spring = VectorXd::Zero(6);
  spring[1] = -1.0;
  spring[2] = 1.0;
  other.k -= 0.8 * spring * spring.transpose();
  other.m(4, 4) += 1.5;
  const Eigenmodes base = modes_of(s.k, s.m), changed = modes_of(other.k, other.m);
  const std::vector<ModelModes> structures = {{base.omega, base.shapes, MatrixXd::Identity(6, 6)},
                                              {changed.omega, changed.shapes, base.shapes.transpose() * s.m * changed.shapes}};
  std::vector<PairedMode> paired;
  VectorXd predicted = VectorXd::Zero(84);  // six modes in two states: a frequency and six channels each
  for (int i = 0; i < 12; ++i) {
    PairedMode mode{i % 6, i / 6, 7 * i, {}, {}, i / 6, i % 6};
    for (int c = 0; c < 6; ++c) {
      mode.shape_rows.push_back(7 * i + 1 + c);
      mode.shape_channels.push_back(c);
      predicted[7 * i + 1 + c] = structures[static_cast<std::size_t>(i / 6)].shapes(c, i % 6);
    }
    paired.push_back(mode);
  }
  const FormColumns form = diagnosis::form_columns(structures, paired, predicted);
  ASSERT_EQ(form.frequency.cols(), 6);
  ASSERT_EQ(form.shape.cols(), 15);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) {
      MatrixXd a = MatrixXd::Zero(6, 6);
      a(i, j) += base.omega[i] * base.omega[j];
      a(j, i) += base.omega[i] * base.omega[j];
      const MatrixXd change = s.m * base.shapes * a * base.shapes.transpose() * s.m;
      constexpr double step = 1e-6;
      VectorXd rows(84);
      for (int state = 0; state < 2; ++state) {
        const Small& of = state == 0 ? s : other;
        const Eigenmodes& at = state == 0 ? base : changed;
        Eigenmodes up = modes_of(of.k + step * change, of.m), down = modes_of(of.k - step * change, of.m);
        for (int k = 0; k < 6; ++k) {
          for (Eigenmodes* moved : {&up, &down})
            if (moved->shapes.col(k).dot(of.m * at.shapes.col(k)) < 0.0) moved->shapes.col(k) *= -1.0;
          rows[7 * (6 * state + k)] = std::log(up.omega[k] / down.omega[k]) / (2.0 * step);
          rows.segment(7 * (6 * state + k) + 1, 6) = (up.shapes.col(k) - down.shapes.col(k)) / (2.0 * step);
        }
      }
      double nearest = 1e300;
      const MatrixXd& columns = i == j ? form.frequency : form.shape;
      for (Index column = 0; column < columns.cols(); ++column)
        nearest = std::min(nearest, (columns.col(column) - rows).norm() / rows.norm());
      EXPECT_LT(nearest, 1e-6) << i << ' ' << j;
    }
}

TEST(FormColumns, NearerModesTurnNoFurtherThanAtFivePerCent) {
  ModelModes model{Eigen::Vector3d(10.0, 10.1, 30.0), MatrixXd::Identity(3, 3), MatrixXd::Identity(3, 3)};
  const PairedMode mode{0, 0, -1, {0, 1, 2}, {0, 1, 2}};
  const VectorXd predicted = Eigen::Vector3d(1.0, 0.0, 0.0);
  const double held = diagnosis::form_columns({model}, {mode}, predicted).shape.col(0).norm();
  model.omega_rad_s[1] = 10.0 * (1.0 + 0.05 + 0.00125);  // a relative gap of 5 % of the geometric mean
  EXPECT_NEAR(diagnosis::form_columns({model}, {mode}, predicted).shape.col(0).norm(), held, 0.01 * held);
  EXPECT_NEAR(held, 1.0 / (0.05 * 2.0), 0.01 * held);
}

TEST(FormColumns, KinksAreSharedByConditionsAndAsLargeAsTheShape) {
  const ModelModes model{Eigen::Vector2d(1.0, 2.0), MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2)};
  const std::vector<PairedMode> paired = {{0, 0, -1, {0, 1}, {0, 1}}, {0, 1, -1, {2, 3}, {0, 1}}, {1, 1, -1, {4}, {1}, 0, 1}};
  VectorXd predicted(5);
  predicted << 3.0, 4.0, 0.6, 0.8, 2.0;
  const MatrixXd kinks = diagnosis::form_columns({model}, paired, predicted).kinks;
  MatrixXd expected(5, 3);
  expected << 1.25, 0, 0, 0, 1.25, 0, 0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.5;
  EXPECT_LT((kinks - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Contrast, RunsFromZeroToOneAtTheExtreme) {
  const auto amplitude = diagnosis::contrast_of("amplitude_m", {0.001, std::nullopt, 0.004});
  ASSERT_TRUE(amplitude);
  EXPECT_EQ(amplitude->weight, Eigen::Vector3d(0.25, 0.0, 1.0));
  const auto temperature = diagnosis::contrast_of("temperature_C", {-5.0, 15.0, -5.0});
  ASSERT_TRUE(temperature);
  EXPECT_EQ(temperature->weight, Eigen::Vector3d(-1.0, 1.0, -1.0));
  EXPECT_FALSE(diagnosis::contrast_of("people", {10.0, 10.0, std::nullopt}));
}

TEST(CloseRotations, CoverGapsBetweenSixAndTwelvePerCentOfOneCondition) {
  const std::vector<PairedMode> paired = {{0, 0, -1, {0, 1}, {0, 1}}, {1, 0, -1, {2, 3}, {0, 1}}, {1, 1, -1, {4, 5}, {0, 1}}};
  VectorXd values(6);
  values << 1, 0, 0, 2, 0, 1;
  EXPECT_EQ(diagnosis::close_rotations(paired, {1.0, 1.05, 1.1}, values).cols(), 0);
  EXPECT_EQ(diagnosis::close_rotations(paired, {1.0, 1.13, 1.1}, values).cols(), 0);
  const MatrixXd one = diagnosis::close_rotations(paired, {1.0, 1.1, 1.1}, values);
  ASSERT_EQ(one.cols(), 1);
  VectorXd expected(6);
  expected << 0, 1, -2, 0, 0, 0;  // each shape gains the other at its own size
  EXPECT_LT((one.col(0) - 0.12 * expected).cwiseAbs().maxCoeff(), 1e-12);
}

// Oracle: the rows of the second shape in another order give the same columns in that order.
TEST(CloseRotations, PairRowsByChannel) {
  const std::vector<double> hertz = {1.0, 1.1};
  VectorXd values(6), moved(6);
  values << 1.0, 0.5, -0.2, 0.3, 2.0, 0.7;
  moved << 1.0, 0.5, -0.2, 0.7, 0.3, 2.0;
  const MatrixXd sorted =
      diagnosis::close_rotations({{0, 0, -1, {0, 1, 2}, {0, 1, 2}}, {1, 0, -1, {3, 4, 5}, {0, 1, 2}}}, hertz, values);
  const MatrixXd shuffled =
      diagnosis::close_rotations({{0, 0, -1, {0, 1, 2}, {0, 1, 2}}, {1, 0, -1, {3, 4, 5}, {2, 0, 1}}}, hertz, moved);
  ASSERT_EQ(sorted.cols(), 1);
  ASSERT_EQ(shuffled.cols(), 1);
  const std::vector<int> order = {0, 1, 2, 5, 3, 4};
  EXPECT_LT((shuffled - sorted(order, Eigen::all)).cwiseAbs().maxCoeff(), 1e-14);
}

// Oracle: a row whose channel the other shape lacks has a column of its own, as large as its shape is on average.
TEST(CloseRotations, GiveAChannelOfOneShapeAloneItsOwnColumn) {
  VectorXd values(7);
  values << 3.0, 4.0, 5.0, 2.0, 1.0, 2.0, 6.0;
  const MatrixXd columns = diagnosis::close_rotations(
      {{0, 0, -1, {0, 1, 2, 3}, {0, 1, 2, 3}}, {1, 0, -1, {4, 5, 6}, {2, 0, 3}}}, {1.0, 1.1}, values);
  ASSERT_EQ(columns.cols(), 2);
  const double ratio = std::sqrt((9.0 + 25.0 + 4.0) / (1.0 + 4.0 + 36.0));
  VectorXd together(7);
  together << 2.0 * ratio, 0.0, 1.0 * ratio, 6.0 * ratio, -5.0 / ratio, -3.0 / ratio, -2.0 / ratio;
  EXPECT_LT((columns.col(0) - 0.12 * together).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((columns.col(1) - 0.12 * std::sqrt(54.0 / 4.0) * VectorXd::Unit(7, 1)).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace twindeck::tests
