#include "sensors/blind_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace twindeck::sensors {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A short test: 1600 s at 32 samples/s, in four frames of three orders. A mode has to recur six times.
LayoutSettings short_test() {
  LayoutSettings settings;
  settings.blind_setups = {"all"};
  settings.duration_s = 1600.0;
  settings.rate_Hz = 32.0;
  settings.damping_ratio = 0.02;
  settings.warm_up_s = 30.0;
  settings.downsample = 1;
  settings.frames = 4;
  settings.minimum_order = 6;
  settings.maximum_order = 10;
  settings.block_rows = 12;
  settings.welch_segment = 256;
  return settings;
}

ScoredSetup of_rows(const std::string& name, std::vector<Index> rows) {
  ScoredSetup setup;
  setup.name = name;
  setup.rows = std::move(rows);
  return setup;
}

MatrixXd four_channels() { return (MatrixXd(4, 2) << 1.0, 1.0, 2.0, 0.5, 2.0, -0.5, 1.0, -1.0).finished(); }

// Oracle: the truth that made the records, w' = 2/dt atan(w dt/2) under the trapezoidal rule. With time T frequency and damping
// scatter by sqrt(zeta/(4 pi f T)) f and sqrt(zeta/(2 pi f T)) (Gersch 1974); the bands are four deviations.
TEST(BlindTest, FindsTheModesOfTheModel) {
  const LayoutSettings settings = short_test();
  const Eigen::Vector2d f(1.0, 2.5);
  const BlindTestResult result = blind_test(settings, f, {of_rows("all", {0, 1, 2, 3})}, four_channels(), 5);
  ASSERT_EQ(result.tests.size(), 1U);
  EXPECT_EQ(result.tests[0].setup, "all");
  for (Index mode = 0; mode < 2; ++mode) {
    const double w_dt = 2.0 * std::numbers::pi * f[mode] / settings.rate_Hz;
    const double shifted = f[mode] * (2.0 / w_dt) * std::atan(0.5 * w_dt);
    const double scatter = std::sqrt(0.02 / (4.0 * std::numbers::pi * f[mode] * settings.duration_s)) * f[mode];
    const identification::Cluster* nearest = nullptr;
    for (const identification::Cluster& cluster : result.tests[0].modes)
      if (nearest == nullptr || std::abs(cluster.frequency_Hz - shifted) < std::abs(nearest->frequency_Hz - shifted))
        nearest = &cluster;
    ASSERT_NE(nearest, nullptr);
    EXPECT_NEAR(nearest->frequency_Hz, shifted, 4.0 * scatter) << mode;
    EXPECT_NEAR(nearest->damping_ratio, 0.02, 4.0 * std::numbers::sqrt2 * scatter / f[mode]) << mode;
    const VectorXd truth = four_channels().col(mode);
    const double mac = std::norm(nearest->shape.dot(truth.cast<std::complex<double>>())) /
                       (nearest->shape.squaredNorm() * truth.squaredNorm());
    EXPECT_GT(mac, 0.98) << mode;
  }
}

// Oracle: the header. The poles of frame k carry the orders 1000 k + (6, 8, 10).
TEST(BlindTest, KeepsTheOrdersOfFramesApart) {
  const BlindTestResult result =
      blind_test(short_test(), Eigen::Vector2d(1.0, 2.5), {of_rows("all", {0, 1, 2, 3})}, four_channels(), 5);
  std::set<int> orders;
  for (const identification::DiagramPole& pole : result.tests[0].diagram) orders.insert(pole.pole.order);
  EXPECT_EQ(orders, (std::set<int>{6, 8, 10, 1006, 1008, 1010, 2006, 2008, 2010, 3006, 3008, 3010}));
}

// Oracle: closed form. Independent loads of density d² at all candidates give the modal forces d² Phi'Phi; d² = n/|Phi|² makes
// their mean 1 (N²/kg)/Hz. Well above the modes acceleration is force over mass, so that channel c shows d² phi_c Phi'Phi
// phi_c' (phi_c² for a single mode). With 399 half-overlapping segments a value scatters by sqrt(11/(9 · 399)) = 6 %, the mean
// of 72 values by some 1 %; the band is four deviations and 2 (f0/f)², below 1.4 %, of the resonances.
TEST(BlindTest, HasTheDensityOfItsLoads) {
  const MatrixXd two = (MatrixXd(3, 2) << 0.5, 1.0, -2.0, 0.3, 1.0, 0.8).finished();
  for (const MatrixXd& phi : {MatrixXd(two.leftCols(1)), two}) {
    const VectorXd below = VectorXd::LinSpaced(phi.cols(), 0.4, 0.5);
    const BlindTestResult result = blind_test(short_test(), below, {of_rows("all", {0, 1, 2})}, phi, 5);
    const VectorXd& f = result.psd_frequency_Hz;
    ASSERT_EQ(f.size(), 129);
    EXPECT_NEAR(f[1], 0.125, 1e-12);
    EXPECT_NEAR(f[128], 16.0, 1e-12);
    ASSERT_EQ(result.psd_m2_s3.size(), 1U);
    const MatrixXd forces = static_cast<double>(phi.cols()) / phi.squaredNorm() * phi.transpose() * phi;
    for (Index c = 0; c < 3; ++c) {
      const double high = result.psd_m2_s3[0].col(c).segment(48, 72).mean();  // 6 to 15 Hz
      EXPECT_NEAR(high / phi.row(c).dot(phi.row(c) * forces), 1.0, 0.06) << phi.cols() << " modes, channel " << c;
    }
  }
}

// Oracle: linearity. A setup shows rows of the shapes: twice the row is four times the density; the setups are those that the
// configuration names, in its order. The frequencies come at the reduced rate.
TEST(BlindTest, ShowsTheRowsOfItsSetups) {
  LayoutSettings settings = short_test();
  settings.blind_setups = {"late", "early"};
  settings.downsample = 2;
  MatrixXd phi(4, 2);
  phi << 1.0, 0.4, 2.0, 0.8, -1.0, 0.3, -3.0, 0.9;
  const BlindTestResult result = blind_test(
      settings, Eigen::Vector2d(1.0, 2.5), {of_rows("early", {0, 1}), of_rows("unused", {0}), of_rows("late", {3, 2})}, phi, 5);
  ASSERT_EQ(result.tests.size(), 2U);
  EXPECT_EQ(result.tests[0].setup, "late");
  EXPECT_EQ(result.tests[1].setup, "early");
  EXPECT_NEAR(result.psd_frequency_Hz[128], 8.0, 1e-12);
  EXPECT_LT((result.psd_m2_s3[1].col(1) - 4.0 * result.psd_m2_s3[1].col(0)).norm(), 1e-12 * result.psd_m2_s3[1].norm());
  EXPECT_LT((result.psd_m2_s3[0].col(0) - 9.0 * result.psd_m2_s3[0].col(1)).norm(), 1e-12 * result.psd_m2_s3[0].norm());
}

}  // namespace
}  // namespace twindeck::sensors
