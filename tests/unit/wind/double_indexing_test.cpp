/// Deodatis' double-indexed frequencies. Oracles: his sum, wave by wave; the ergodicity that he proves: over the whole period
/// each sample has the mean and the covariances of the target.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "core/parallel.hpp"
#include "signal/fft.hpp"
#include "two_arcs.hpp"
#include "wind/simulation.hpp"

namespace twindeck::wind {
namespace {

using Eigen::Index;

constexpr double kShort_s = 20.0;

FieldDefinition four_points() {
  FieldDefinition field = test::two_arcs(Component::along, 2);
  field.sigma_m_s[2] *= 1.5;  // another kind of turbulence on the way
  return field;
}
Simulator double_indexed(int anchors, double duration_s = kShort_s) {
  return {four_points(),
          {.duration_s = duration_s, .cutoff_Hz = 3.0, .anchors = anchors, .frequencies = Frequencies::double_indexed}};
}
/// A whole period, n T.
Eigen::MatrixXd period(const Simulator& simulator, std::uint64_t seed) {
  return simulator.sample(seed, (simulator.field().size() - 1) * simulator.n_samples());
}

TEST(DoubleIndexing, EachWaveIsThatOfDeodatis) {
  const Simulator simulator = double_indexed(0);
  const FieldDefinition& field = simulator.field();
  const Index n = field.size(), b = (n - 1) * simulator.n_samples();
  const Eigen::MatrixXd v = period(simulator, 5);
  signal::RealFft fft(v.rows());
  const double df = 1.0 / kShort_s;
  for (Index j = 0; j < n; ++j) {
    const Eigen::VectorXcd spectrum = fft.forward(v.col(j));
    for (Index m = 0; m < n; ++m) {
      for (const Index l : {1, 2, 17, 59}) {
        const Index line = (l - 1) * n + m + 1;
        const double f = (static_cast<double>(l) - 1.0 + (static_cast<double>(m) + 1.0) / static_cast<double>(n)) * df;
        double real[kLanes], imaginary[kLanes];
        random_waves(5, static_cast<std::uint64_t>(field.component) << 32 | static_cast<std::uint64_t>(m), l, false, real,
                     imaginary);
        std::complex<double> expected = 0.0;
        if (m <= j)
          expected = std::sqrt(2.0 * df * spectra(field, f)[j]) * coherence_factor(field, f)(j, m) * drift(field, f)[j] *
                     std::complex<double>(real[0], imaginary[0]);
        // The period begins b samples before t = 0.
        const auto turn = std::polar(1.0, 2.0 * 3.14159265358979323846 * static_cast<double>(line) * static_cast<double>(b) /
                                              static_cast<double>(v.rows()));
        const std::complex<double> found = 2.0 / static_cast<double>(v.rows()) * spectrum[line] * turn;
        EXPECT_LT(std::abs(found - expected), 1e-10) << "point " << j << ", stream " << m << ", l " << l;
      }
    }
    // no wave at or above the cutoff
    EXPECT_LT(spectrum.tail(spectrum.size() - 60 * n).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(DoubleIndexing, EverySampleHasTheTargetsMeanAndCovariances) {
  const double duration = 600.0;
  const Simulator simulator = double_indexed(0, duration);
  const FieldDefinition& field = simulator.field();
  const Index n = field.size();
  const double df = 1.0 / duration;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n), target = sum;  // over the waves; of the cross-spectra, on a finer grid
  const auto cross = [&](double f, const Eigen::MatrixXd& part) {
    const Eigen::VectorXcd point = spectra(field, f).cwiseSqrt().cwiseProduct(drift(field, f));
    return (point.asDiagonal() * part * point.conjugate().asDiagonal()).real().eval();
  };
  for (Index line = 1; line <= simulator.n_waves() * n; ++line) {
    const double f = static_cast<double>(line) * df / static_cast<double>(n);
    const Eigen::VectorXd stream = coherence_factor(field, f).col((line - 1) % n);
    sum += df * cross(f, stream * stream.transpose());
    target += df / static_cast<double>(n) * cross(f, coherence(field, f));
  }
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Eigen::MatrixXd v = period(simulator, seed);
    EXPECT_LT(v.colwise().mean().cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::MatrixXd covariance = v.transpose() * v / static_cast<double>(v.rows());
    EXPECT_LT((covariance - sum).cwiseAbs().maxCoeff() / sum.maxCoeff(), 1e-12) << seed;
    // A stream has its own frequencies: each sum differs from the integral by half of df S(0) = 4 df L / V sigma² at most.
    EXPECT_LT((covariance - target).cwiseAbs().maxCoeff() / target.maxCoeff(), 2.0 * df * 103.0 / 19.1) << seed;
  }
}

TEST(DoubleIndexing, AnchorsAndThreadsChangeLittleAndNothing) {
  const Eigen::MatrixXd exact = double_indexed(0).sample(9), few = double_indexed(20).sample(9);
  EXPECT_LT((exact - few).cwiseAbs().maxCoeff(), 0.02 * exact.cwiseAbs().maxCoeff());
  const int before = thread_count();
  set_thread_count(1);
  const Eigen::MatrixXd one = double_indexed(20).sample(9);
  set_thread_count(before);
  EXPECT_EQ((one - few).cwiseAbs().maxCoeff(), 0.0);
}

TEST(DoubleIndexing, WhatComesBeforeIsThePeriodsEnd) {
  for (const Frequencies frequencies : {Frequencies::single, Frequencies::double_indexed}) {
    const Simulator simulator(four_points(), {.duration_s = kShort_s, .cutoff_Hz = 3.0, .frequencies = frequencies});
    const Index lap = frequencies == Frequencies::single ? simulator.n_samples() : 4 * simulator.n_samples();
    const Eigen::MatrixXd plain = simulator.sample(4), with = simulator.sample(4, 50), again = simulator.sample(4, lap + 50);
    EXPECT_EQ((with.bottomRows(plain.rows()) - plain).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ((again.topRows(50) - with.topRows(50)).cwiseAbs().maxCoeff(), 0.0);
  }
}

}  // namespace
}  // namespace twindeck::wind
