// Oracles: a straight line detrends to nothing; a sine in the passband keeps amplitude and phase, one above the new Nyquist
// frequency is gone; the inverse transform undoes the transform.
#include "signal/condition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "noise.hpp"
#include "signal/fft.hpp"

namespace twindeck::signal {
namespace {

Eigen::MatrixXd sine(Eigen::Index n, double cycles_per_sample) {
  Eigen::MatrixXd data(n, 1);
  for (Eigen::Index t = 0; t < n; ++t)
    data(t, 0) = std::sin(2.0 * std::numbers::pi * cycles_per_sample * static_cast<double>(t) + 0.3);
  return data;
}

TEST(Detrend, ALineLeavesNothing) {
  Eigen::MatrixXd data(1000, 2);
  data.col(0) = Eigen::VectorXd::LinSpaced(1000, -4.0, 11.0);
  data.col(1).setConstant(5.0);
  EXPECT_LT(detrended(data).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Decimate, KeepsAmplitudeAndPhaseInThePassband) {
  for (const Eigen::Index factor : {2, 5, 8}) {
    const double cycles = 0.75 * 0.5 / static_cast<double>(factor);
    const Eigen::MatrixXd x = sine(20000, cycles), y = decimated(x, factor);
    ASSERT_EQ(y.rows(), (x.rows() + factor - 1) / factor);
    double worst = 0.0;
    for (Eigen::Index k = 100; k + 100 < y.rows(); ++k) worst = std::max(worst, std::abs(y(k, 0) - x(k * factor, 0)));
    EXPECT_LT(worst, 3e-4);
  }
}

TEST(Decimate, TakesOutWhatWouldFold) {
  for (const Eigen::Index factor : {2, 5, 8}) {
    const Eigen::MatrixXd y = decimated(sine(20000, 1.02 * 0.5 / static_cast<double>(factor)), factor);
    EXPECT_LT(y.middleRows(100, y.rows() - 200).cwiseAbs().maxCoeff(), 3e-4);
  }
}

TEST(Decimate, PassesALineAndRefusesAShortRecord) {
  Eigen::MatrixXd line(2000, 1);
  line.col(0) = Eigen::VectorXd::LinSpaced(2000, 0.0, 1999.0);
  const Eigen::MatrixXd y = decimated(line, 4);
  for (Eigen::Index k = 0; k < y.rows(); ++k) EXPECT_NEAR(y(k, 0), 4.0 * static_cast<double>(k), 1e-9);
  EXPECT_THROW(static_cast<void>(decimated(line.topRows(60), 4)), InputError);
  // Kaiser: (80 - 8) / (2.285 · 0.2 pi / 4) / 2 = 100.3 samples to either side.
  EXPECT_THROW(static_cast<void>(decimated(line.topRows(101), 4)), InputError);
  EXPECT_EQ(decimated(line.topRows(102), 4).rows(), 26);
}

TEST(Fft, InverseUndoesForwardAtAnyLength) {
  test::Noise noise(2);
  for (const Eigen::Index n : {1, 7, 64, 243}) {
    Eigen::VectorXd x(n);
    for (double& v : x) v = noise();
    RealFft fft(n);
    EXPECT_LT((fft.inverse(fft.forward(x)) - x).norm(), 1e-13 * static_cast<double>(n));
  }
  EXPECT_EQ(fast_fft_size(7), 8);
  EXPECT_EQ(fast_fft_size(361), 375);  // 3 · 5³
}

}  // namespace
}  // namespace twindeck::signal
