// Oracles: spectra in closed form (one oscillator, a sum of dyads); a gain and a unitary change of channels.
#include "identification/efdd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace twindeck::identification {
namespace {

using Complex = std::complex<double>;

const Eigen::Vector2cd kLagging =
    Eigen::Vector2cd(Complex(0.6, 0.0), Complex(0.0, -0.8));  // the second channel a quarter turn behind

struct BellMode {
  double frequency_Hz, damping_ratio;
  Eigen::VectorXcd shape;
};

/// Displacements of oscillators under white forces: |H|² = 1/((f0² - f²)² + (2 zeta f0 f)²), each with its shape.
signal::CrossSpectra oscillators(const std::vector<BellMode>& modes, double line_Hz, Eigen::Index n) {
  signal::CrossSpectra spectra;
  spectra.frequency_Hz = Eigen::VectorXd::LinSpaced(n, 0.0, line_Hz * static_cast<double>(n - 1));
  for (const double f : spectra.frequency_Hz) {
    Eigen::MatrixXcd density = Eigen::MatrixXcd::Zero(modes.front().shape.size(), modes.front().shape.size());
    for (const BellMode& mode : modes) {
      const double f0 = mode.frequency_Hz, zeta = mode.damping_ratio;
      density += mode.shape * mode.shape.adjoint() / (std::pow(f0 * f0 - f * f, 2) + std::pow(2.0 * zeta * f0 * f, 2));
    }
    spectra.density.push_back(density);
  }
  return spectra;
}

// S = 5 u uᴴ + 2 w wᴴ of two orthonormal vectors: values 5 and 2, first vector u up to its phase, not conj(u).
TEST(SingularSpectra, AreThoseOfASumOfDyads) {
  const Eigen::Vector2cd u = kLagging, w(Complex(0.8, 0.0), Complex(0.0, 0.6));
  ASSERT_NEAR(std::abs(u.dot(w)), 0.0, 1e-15);
  signal::CrossSpectra spectra;
  spectra.frequency_Hz = Eigen::VectorXd::LinSpaced(1, 1.0, 1.0);
  spectra.density = {5.0 * u * u.adjoint() + 2.0 * w * w.adjoint()};
  const SingularSpectra singular = singular_spectra(spectra, 7);  // of two channels two values
  ASSERT_EQ(singular.values.cols(), 2);
  EXPECT_NEAR(singular.values(0, 0), 5.0, 1e-14);
  EXPECT_NEAR(singular.values(0, 1), 2.0, 1e-14);
  EXPECT_NEAR(std::abs(u.dot(singular.first_vectors.col(0))), 1.0, 1e-14);
  EXPECT_EQ(singular_spectra(spectra, 1).values.cols(), 1);
}

// Rounding may leave a negative eigenvalue of a matrix of rank one: a singular value is not negative.
TEST(SingularSpectra, AreNotNegative) {
  signal::CrossSpectra spectra;
  spectra.frequency_Hz = Eigen::VectorXd::LinSpaced(1, 1.0, 1.0);
  spectra.density = {Eigen::Vector2d(3.0, -1e-17).asDiagonal().toDenseMatrix().cast<std::complex<double>>()};
  EXPECT_EQ(singular_spectra(spectra, 2).values(0, 1), 0.0);
}

// y_2 is a quarter period behind y_1 of the same size: the first vector has the ratio -i.
TEST(SingularSpectra, AChannelThatLagsHasANegativePhase) {
  const double rate = 32.0;
  Eigen::MatrixXd data(4096, 2);
  for (Eigen::Index t = 0; t < data.rows(); ++t) {
    const double angle = 2.0 * 3.14159265358979 * 2.0 * static_cast<double>(t) / rate;
    data.row(t) << std::cos(angle), std::sin(angle);
  }
  const SingularSpectra singular = singular_spectra(signal::cross_spectra(data, rate, {256, 0.5}), 1);
  const Eigen::Vector2cd at = singular.first_vectors.col(16);  // 16 · 32/256 = 2 Hz
  EXPECT_LT(std::abs(at[1] / at[0] - std::complex<double>(0.0, -1.0)), 1e-6);
}

// The bell cut at a MAC is a little narrower than the whole, and the trapezoid rule has its lines: 0.1 % of the frequency, 5 %
// of the damping. For a single mode the whole spectrum is its bell.
TEST(Efdd, AnOscillatorHasItsFrequencyAndDamping) {
  for (const double zeta : {0.01, 0.02}) {
    for (const double f0 : {2.0, 2.013}) {  // on a line and off it
      const EfddMode mode = efdd(singular_spectra(oscillators({{f0, zeta, kLagging}}, 0.005, 1001), 1), 2.0);
      ASSERT_TRUE(mode.found);
      EXPECT_NEAR(mode.frequency_Hz / f0, 1.0, 1e-3);
      EXPECT_NEAR(mode.damping_ratio / zeta, 1.0, 0.05);
      EXPECT_NEAR(std::abs(mode.shape.dot(kLagging)), 1.0, 1e-12);
    }
  }
}

// A frequency axis that is stretched by s stretches the frequency and leaves the damping. A gain changes nothing.
TEST(Efdd, FollowsTheFrequencyAxisAndNoGain) {
  SingularSpectra spectra = singular_spectra(oscillators({{2.013, 0.02, kLagging}}, 0.005, 1001), 1);
  const EfddMode one = efdd(spectra, 2.0);
  spectra.frequency_Hz *= 3.0;
  spectra.values *= 1e6;
  const EfddMode stretched = efdd(spectra, 6.0);
  EXPECT_NEAR(stretched.frequency_Hz, 3.0 * one.frequency_Hz, 1e-9);
  EXPECT_NEAR(stretched.damping_ratio, one.damping_ratio, 1e-9);
}

// Two modes of orthogonal shapes: the bell of each ends where the other one's shape begins.
TEST(Efdd, EachOfTwoModesHasItsOwnBell) {
  const Eigen::Vector2cd other(Complex(0.8, 0.0), Complex(0.0, 0.6));
  const SingularSpectra spectra = singular_spectra(oscillators({{2.0, 0.01, kLagging}, {2.4, 0.02, other}}, 0.005, 1001), 2);
  const EfddMode lower = efdd(spectra, 2.01), upper = efdd(spectra, 2.39);
  ASSERT_TRUE(lower.found && upper.found);
  EXPECT_NEAR(lower.frequency_Hz, 2.0, 0.01);  // two lines
  EXPECT_NEAR(upper.frequency_Hz, 2.4, 0.01);
  EXPECT_GT(std::abs(lower.shape.dot(kLagging)), 0.999);
  EXPECT_GT(std::abs(upper.shape.dot(other)), 0.999);
  EXPECT_LT(lower.damping_ratio, upper.damping_ratio);
}

// The peak is sought within ±search alone: a stronger one beyond it is not taken.
TEST(Efdd, AStrongerPeakBeyondTheReachIsNotTaken) {
  const Eigen::Vector2cd other(Complex(0.8, 0.0), Complex(0.0, 0.6));
  const SingularSpectra spectra =
      singular_spectra(oscillators({{2.0, 0.01, kLagging}, {2.4, 0.01, 10.0 * other}}, 0.005, 1001), 1);
  EXPECT_NEAR(efdd(spectra, 2.0).frequency_Hz, 2.0, 0.01);
  EXPECT_NEAR(efdd(spectra, 2.0, 0.25).frequency_Hz, 2.4, 0.01);
}

TEST(Efdd, TooFewLinesOrNoPeakIsNotFound) {
  const SingularSpectra seven = singular_spectra(oscillators({{0.02, 0.01, kLagging}}, 0.005, 7), 1);
  EXPECT_FALSE(efdd(seven, 0.02).found);
  SingularSpectra spectra = singular_spectra(oscillators({{2.0, 0.01, kLagging}}, 0.005, 1001), 1);
  EXPECT_FALSE(efdd(spectra, 50.0).found);  // beyond the axis
  // Vectors that turn from line to line make no bell.
  for (Eigen::Index i = 0; i < spectra.first_vectors.cols(); ++i) spectra.first_vectors.col(i) = Eigen::Vector2cd::Unit(i % 2);
  EXPECT_FALSE(efdd(spectra, 2.0).found);
}

// An undamped line has no decay to fit within half the duration of the record.
TEST(Efdd, ASpectrumOfZerosIsNotFound) {
  SingularSpectra spectra = singular_spectra(oscillators({{2.0, 0.01, kLagging}}, 0.005, 1001), 1);
  spectra.values.setZero();
  EXPECT_FALSE(efdd(spectra, 2.0).found);
}

}  // namespace
}  // namespace twindeck::identification
