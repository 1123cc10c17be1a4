/// Oracles: the sums that Eq. (15) implies, statistics with their theoretical scatter, sameness over
/// threads.
#include "wind/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "signal/fft.hpp"
#include "signal/welch.hpp"
#include "two_arcs.hpp"
#include "wind/spectrum.hpp"
#include "wind/wave_sums.hpp"

namespace twindeck::wind {
namespace {

using Eigen::Index;

TEST(Simulation, UnitWavesAreThoseOfTheLibrary) {
  for (int i = 0; i < 100000; ++i) {
    const double u = 3.7 * i / 100000.0;
    double c = 0.0, s = 0.0;
    unit_wave(u, c, s);
    ASSERT_NEAR(c, std::cos(2.0 * std::numbers::pi * u), 4e-15) << u;  // the library's argument is itself rounded to 4e-15
    ASSERT_NEAR(s, std::sin(2.0 * std::numbers::pi * u), 4e-15) << u;
    ASSERT_NEAR(c * c + s * s, 1.0, 5e-16);
  }
}

/// |H_jm(f_l)| of Eq. (15) as a sample has it: the factor of the coherence interpolated between the anchors beside f, rows of
/// length one, times the root of each point's spectrum. @param anchors  0: at every wave (n × n)
Eigen::MatrixXd amplitude_factor(const Simulator& simulator, int anchors, Index l) {
  const FieldDefinition& field = simulator.field();
  const double lowest = simulator.spacing_Hz(), f = lowest * static_cast<double>(l);
  Eigen::MatrixXd factor = coherence_factor(field, f);
  if (anchors > 0) {
    const double highest = lowest * static_cast<double>(simulator.n_waves());
    const auto at = [&](int a) { return lowest * std::pow(highest / lowest, static_cast<double>(a) / (anchors - 1)); };
    int above = 1;
    while (above + 1 < anchors && at(above) <= f * (1.0 + 1e-12)) ++above;
    const double share = std::clamp(std::log(f / at(above - 1)) / std::log(at(above) / at(above - 1)), 0.0, 1.0);
    factor = (1.0 - share) * coherence_factor(field, at(above - 1)) + share * coherence_factor(field, at(above));
    factor.rowwise().normalize();
  }
  return spectra(field, f).cwiseSqrt().asDiagonal() * factor;
}

TEST(Simulation, FirstPointHasExactlyItsSpectrum) {
  // With fixed amplitudes the first point is the sum of its own waves alone: amplitude²/2 = S df, exactly, at every line.
  const FieldDefinition field = test::two_arcs(Component::along, 3);
  const Simulator simulator(field, {.duration_s = 60.0});
  const Eigen::MatrixXd v = simulator.sample(7);
  signal::RealFft fft(v.rows());
  const Eigen::VectorXcd spectrum = fft.forward(v.col(0));
  for (const Index l : {1, 5, 100, 400}) {
    const double f = simulator.spacing_Hz() * static_cast<double>(l);
    const double amplitude = 2.0 * std::abs(spectrum[l]) / static_cast<double>(v.rows());
    EXPECT_NEAR(0.5 * amplitude * amplitude / simulator.spacing_Hz() / spectra(field, f)[0], 1.0, 1e-10);
  }
  EXPECT_NEAR(std::abs(spectrum[0]) / static_cast<double>(v.rows()), 0.0, 1e-12);
}

TEST(Simulation, EachWaveOfEachPointIsTheSumOfEq15) {
  // sqrt(2 df) drift_j sum_m H_jm exp(i phi_ml), point by point: factors of whole rows, without the kernel's pieces and
  // left-out entries. Waves at both ends of a piece, the first and the last.
  for (const int anchors : {0, 3, 40}) {
    FieldDefinition field = test::two_arcs(Component::vertical, 12);
    field.frozen = true;
    field.sigma_m_s[7] *= 1.5;  // another kind of turbulence on the way
    const Simulator simulator(field, {.duration_s = 60.0, .cutoff_Hz = 7.9, .anchors = anchors});
    const Eigen::MatrixXd v = simulator.sample(3);
    signal::RealFft fft(v.rows());
    for (const Index l : {Index{1}, Index{2}, Index{8}, Index{9}, Index{200}, simulator.n_waves()}) {
      Eigen::VectorXcd wave(field.size());
      for (Index m = 0; m < wave.size(); ++m) {
        double real[kLanes], imaginary[kLanes];
        random_waves(3, static_cast<std::uint64_t>(field.component) << 32 | static_cast<std::uint64_t>(m), l, false, real,
                     imaginary);
        wave[m] = {real[0], imaginary[0]};
      }
      const double f = simulator.spacing_Hz() * static_cast<double>(l);
      const Eigen::VectorXcd expected = std::sqrt(2.0 * simulator.spacing_Hz()) *
                                        drift(field, f).cwiseProduct(amplitude_factor(simulator, anchors, l) * wave);
      for (Index j = 0; j < field.size(); ++j) {
        const std::complex<double> found = 2.0 / static_cast<double>(v.rows()) * fft.forward(v.col(j))[l];
        EXPECT_LT(std::abs(found - expected[j]), 1e-12) << anchors << " anchors, wave " << l << ", point " << j;
      }
    }
  }
}

TEST(Simulation, InterpolatedFactorKeepsTheCoherence) {
  // 40 anchors against the factor itself: the error a prototype found was 0.003 at most.
  const FieldDefinition field = test::two_arcs(Component::along);
  const Simulator simulator(field, {.anchors = 40});
  for (Index l = 1; l <= simulator.n_waves(); l += l < 50 ? 7 : 211) {
    const double f = simulator.spacing_Hz() * static_cast<double>(l);
    const Eigen::MatrixXd h = amplitude_factor(simulator, 40, l);
    const Eigen::MatrixXd error = h * h.transpose() / spectra(field, f)[0] - coherence(field, f);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.005) << f;
  }
}

TEST(Simulation, IsTheSameWhateverTheThreads) {
  const Simulator simulator(test::two_arcs(Component::across, 8), {.duration_s = 60.0});
  const int before = thread_count();
  set_thread_count(1);
  const Eigen::MatrixXd one = simulator.sample(11);
  set_thread_count(3);
  const Eigen::MatrixXd three = simulator.sample(11);
  set_thread_count(before);
  EXPECT_EQ((one - three).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT((one - simulator.sample(12)).cwiseAbs().maxCoeff(), 0.1);
}

/// RMS, spectrum and coherence of 20 samples of 600 s at 60 points against their targets. Scatter of one RMS: v 6.3, u 3.6,
/// w 2.3 % (sqrt(∫S² df / T) / (2 sigma²)); the mean of 20 has a fifth of it, and 5, 3, 2 % are three to four standard
/// deviations.
struct Statistics {
  double rms = 0.0, psd = 0.0, coherence = 0.0;  ///< worst point; root mean square over frequencies; over pairs and frequencies
};
Statistics statistics(Component component) {
  const FieldDefinition field = test::two_arcs(component);
  const Simulator simulator(field, {});
  const Index n = field.size(), segment = 1024;
  const std::vector<Index> chosen = {0, 1, 2, 4, 8, 15, 30, 45};  // for pairs
  Eigen::VectorXd mean_square = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd psd = Eigen::VectorXd::Zero(segment / 2 + 1), f;
  std::vector<Eigen::MatrixXcd> cross;
  const int seeds = 20;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Eigen::MatrixXd v = simulator.sample(static_cast<std::uint64_t>(seed));
    mean_square += v.colwise().squaredNorm().transpose() / static_cast<double>(v.rows()) / seeds;
    const signal::PowerSpectra power = signal::power_spectra(v, 16.0, {.segment = segment});
    f = power.frequency_Hz;
    psd += power.density.rowwise().mean() / seeds;
    const signal::CrossSpectra pairs = signal::cross_spectra(v(Eigen::all, chosen), 16.0, {.segment = segment});
    if (cross.empty()) cross.assign(pairs.density.size(), Eigen::MatrixXcd::Zero(8, 8));
    for (std::size_t i = 0; i < cross.size(); ++i) cross[i] += pairs.density[i];
  }
  Statistics found;
  double band = 0.0;
  for (Index l = 1; l <= simulator.n_waves(); ++l) band += spectra(field, simulator.spacing_Hz() * static_cast<double>(l))[0];
  band *= simulator.spacing_Hz();
  found.rms = ((mean_square / band).cwiseSqrt().array() - 1.0).abs().maxCoeff();
  // The window smears the steep first bins; the last holds the cutoff.
  const Index first = 4, last = segment / 2 - 2;
  double psd_sum = 0.0, coherence_sum = 0.0;
  Index pairs = 0;
  for (Index i = first; i <= last; ++i) {
    psd_sum += std::pow(psd[i] / spectra(field, f[i])[0] - 1.0, 2) / static_cast<double>(last - first + 1);
    const Eigen::MatrixXd gamma = coherence(field, f[i]);
    const Eigen::VectorXcd phase = drift(field, f[i]);
    const Eigen::MatrixXcd& s = cross[static_cast<std::size_t>(i)];
    for (Index a = 0; a < 8; ++a) {
      for (Index b = 0; b < a; ++b) {
        const Index j = chosen[static_cast<std::size_t>(a)], k = chosen[static_cast<std::size_t>(b)];
        const double in_phase = (s(a, b) * std::conj(phase[j]) * phase[k]).real() / std::sqrt(s(a, a).real() * s(b, b).real());
        coherence_sum += std::pow(in_phase - gamma(j, k), 2);
        ++pairs;
      }
    }
  }
  found.psd = std::sqrt(psd_sum);
  found.coherence = std::sqrt(coherence_sum / static_cast<double>(pairs));
  return found;
}

TEST(Simulation, TwentySamplesHaveTheTargetsStatistics) {
  const PerComponent rms_limit = {0.05, 0.03, 0.02};
  for (const Component c : components) {
    const Statistics found = statistics(c);
    std::printf("  %s: worst RMS %.2f %%, PSD %.2f %% rms, coherence %.3f rms\n", paper_letter(c).c_str(), 100.0 * found.rms,
                100.0 * found.psd, found.coherence);
    EXPECT_LT(found.rms, of(rms_limit, c));
    EXPECT_LT(found.psd, 0.015);
    EXPECT_LT(found.coherence, 0.05);
  }
}

TEST(Simulation, GaussianAmplitudesScatterAlikeAtAllPoints) {
  // Fixed amplitudes: no scatter at all at the first point. Gaussian ones: that of theory, ∫S² df / T, everywhere.
  const FieldDefinition field = test::two_arcs(Component::vertical, 4);
  for (const Amplitudes amplitudes : {Amplitudes::fixed, Amplitudes::gaussian}) {
    const Simulator simulator(field, {.duration_s = 60.0, .amplitudes = amplitudes});
    Eigen::VectorXd variance(200);
    for (int s = 0; s < 200; ++s) {
      variance[s] =
          simulator.sample(static_cast<std::uint64_t>(s)).col(0).squaredNorm() / static_cast<double>(simulator.n_samples());
    }
    const double deviation = std::sqrt((variance.array() - variance.mean()).square().mean());
    double theory = 0.0;
    for (Index l = 1; l <= simulator.n_waves(); ++l) {
      theory += std::pow(spectra(field, simulator.spacing_Hz() * static_cast<double>(l))[0] * simulator.spacing_Hz(), 2);
    }
    if (amplitudes == Amplitudes::fixed) {
      EXPECT_LT(deviation, 1e-12);
    } else {
      EXPECT_NEAR(deviation / std::sqrt(theory), 1.0, 0.2);  // a deviation from 200 samples has a scatter of 5 %
    }
  }
}

TEST(Simulation, RefusesWhatLeavesNoWave) {
  const FieldDefinition field = test::two_arcs(Component::vertical, 2);
  EXPECT_THROW(Simulator(field, {.duration_s = 0.1, .rate_Hz = 16.0}), InputError);
  EXPECT_THROW(Simulator(field, {.cutoff_Hz = 9.0}), InputError);
  EXPECT_THROW(Simulator(field, {.anchors = 1}), InputError);
}

}  // namespace
}  // namespace twindeck::wind
