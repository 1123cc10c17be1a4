// Oracles: rows of two measured modes in hand-made orders; two uncoupled masses whose frequencies are 1 % apart.
#include "updating/weighing.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "measured_chain.hpp"

namespace twindeck::updating {
namespace {

UpdatingSettings weighing(bool shapes) {
  UpdatingSettings settings;
  settings.weights = "covariance";
  if (shapes) settings.residuals = {"frequency", "shape"};
  return settings;
}

matching::Pairing crossed() {  // the first measured mode is the second computed one
  matching::Pairing pairing;
  pairing.pairs = {{0, 1, 1.0, false}, {1, 0, 1.0, false}};
  return pairing;
}

TEST(WeighedRows, AreNotGivenForRelativeFrequencies) {
  const dynamics::LoadedModel model = loaded(two_masses());
  const matching::Measured measured = measured_frequencies(Eigen::Vector2d(3.0, 4.0), 0.01);
  EXPECT_FALSE(weighed_rows({}, measured, crossed(), model, modes_of(model)).given());
}

// A covariance between the two frequencies, whose rows stand in the other order, goes with them; the model's own error is 2 %
// of each frequency.
TEST(WeighedRows, TakeTheCovarianceInTheOrderOfThePairs) {
  const dynamics::LoadedModel model = loaded(two_masses());
  matching::Measured measured = measured_frequencies(Eigen::Vector2d(3.0, 4.0), 0.01);
  std::swap(measured.rows[0], measured.rows[1]);
  measured.covariance << 4e-4, 1e-4, 1e-4, 9e-4;  // of 4 Hz, then of 3 Hz
  UpdatingSettings settings = weighing(false);
  settings.frequency_model_error = 0.02;
  const MeasuredRows rows = weighed_rows(settings, measured, crossed(), model, modes_of(model));
  const Eigen::Matrix2d expected = (Eigen::Matrix2d() << 9e-4 + 0.06 * 0.06, 1e-4, 1e-4, 4e-4 + 0.08 * 0.08).finished();
  EXPECT_LT((rows.covariance - expected).norm(), 1e-17);
  EXPECT_TRUE(rows.shape.empty());
}

TEST(WeighedRows, LeaveOutModesWithoutAPartner) {
  const dynamics::LoadedModel model = loaded(two_masses());
  matching::Measured measured = measured_modes(Eigen::Vector3d(1.0, 3.0, 4.0), 0.01, Eigen::MatrixXd::Ones(2, 3), 0.1);
  measured.covariance(1, 1) = 0.25;
  matching::Pairing pairing;
  pairing.pairs = {{1, 0, 1.0, false}};
  const MeasuredRows rows = weighed_rows(weighing(true), measured, pairing, model, modes_of(model));
  ASSERT_EQ(rows.covariance.rows(), 3);  // the frequency and the two components of one shape
  EXPECT_EQ(rows.covariance(0, 0), 0.25);
  ASSERT_EQ(rows.shape.size(), 2U);
  EXPECT_EQ(rows.shape[1].target, 0);
  EXPECT_EQ(rows.shape[1].channel, 1);
}

// The model's own error of a shape is 10 % of its largest component, 4, whatever the component's sign; a component that was not
// measured counts for nothing.
TEST(WeighedRows, AddTheErrorOfShapesRelativeToTheLargestComponent) {
  const dynamics::LoadedModel model = loaded(two_masses());
  Eigen::MatrixXd shapes(2, 1);
  shapes << 1.0, -4.0;
  matching::Measured measured = measured_modes(Eigen::VectorXd::Constant(1, 3.0), 0.01, shapes, 0.3);
  matching::Pairing pairing;
  pairing.pairs = {{0, 0, 1.0, false}};
  UpdatingSettings settings = weighing(true);
  settings.shape_model_error = 0.1;
  const MeasuredRows rows = weighed_rows(settings, measured, pairing, model, modes_of(model));
  EXPECT_NEAR(rows.covariance(1, 1), 0.09 + 0.16, 1e-15);
  EXPECT_NEAR(rows.covariance(2, 2), 0.09 + 0.16, 1e-15);
  EXPECT_EQ(rows.shape[1].value, -4.0);
  EXPECT_LT((rows.channels - Eigen::MatrixXd::Identity(2, 2)).norm(), 1e-15);  // each channel reads its own mass
}

// Three uncoupled masses: f2 is 1 % above f1, f3 twice f1. With a gap of 2 % the first two span each other's shapes.
TEST(WeighedRows, LetCloseModesSpanAShapeTogether) {
  SmallSystem small(3);
  small.stiffness(100.0 * spring(3, 0, -1) + 102.0 * spring(3, 1, -1) + 400.0 * spring(3, 2, -1));
  const dynamics::LoadedModel model = loaded(small.mass(Eigen::MatrixXd::Identity(3, 3)));
  const dynamics::EigenModes modes = modes_of(model);
  const matching::Measured measured = measured_modes(modes.frequency_Hz, 0.01, Eigen::MatrixXd::Identity(3, 3), 0.1);
  matching::Pairing pairing;
  pairing.pairs = {{0, 0, 1.0, false}, {1, 1, 1.0, false}, {2, 2, 1.0, false}};
  UpdatingSettings settings = weighing(true);
  settings.cluster_gap = 0.02;
  EXPECT_EQ(weighed_rows(settings, measured, pairing, model, modes).span, (std::vector<std::vector<int>>{{0, 1}, {1, 0}, {2}}));
  settings.cluster_gap = 0.005;
  EXPECT_EQ(weighed_rows(settings, measured, pairing, model, modes).span, (std::vector<std::vector<int>>{{0}, {1}, {2}}));
}

TEST(WeighedRows, RefuseShapesThatCannotBeWeighed) {
  matching::Measured measured = measured_frequencies(Eigen::Vector2d(3.0, 4.0), 0.01);
  EXPECT_THROW(refuse_unweighable_shapes(measured), InputError);  // no shape
  measured = measured_modes(Eigen::Vector2d(3.0, 4.0), 0.01, Eigen::Matrix2d::Identity(), 0.1);
  EXPECT_NO_THROW(refuse_unweighable_shapes(measured));
  measured.rows.resize(2);
  EXPECT_THROW(refuse_unweighable_shapes(measured), InputError);  // no standard deviation
}

}  // namespace
}  // namespace twindeck::updating
