#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <vector>

#include "wind/field.hpp"
#include "wind/wave_sums.hpp"

namespace twindeck::wind {

/// Amplitudes of the waves.
enum class Amplitudes {
  fixed,    ///< as Eq. (15): only phases are random. The first point has the same variance in every sample, that of the last
            ///< varies
  gaussian  ///< complex normal: exactly Gaussian, all points have the same law
};

/// Frequencies of the waves of stream m, with df = 1/T.
enum class Frequencies {
  single,         ///< f_l = l df for all m: a sample is periodic in T
  double_indexed  ///< f_ml = (l - 1) df + m df / n, Deodatis' own (1996): a sample is periodic in n T, and over that period its
                  ///< mean is zero and its covariances are the target's, sample by sample (ergodic), with fixed amplitudes
};

struct SimulationOptions {
  double duration_s = 600.0;  ///< T
  double rate_Hz = 16.0;      ///< samples a second; T times it is rounded to a whole number of samples
  double cutoff_Hz = 0.0;     ///< no wave at or above; 0 means half the rate
  /// Frequencies, evenly spaced on a logarithmic scale, at which the coherence is factorised; in between the factor is
  /// interpolated and its rows are scaled to length one, so that every point keeps its exact spectrum. 0: at every frequency.
  int anchors = 40;
  Amplitudes amplitudes = Amplitudes::fixed;
  Frequencies frequencies = Frequencies::single;
};

/// Deodatis' simulation of one component of the wind (paper Eq. 14-15), prepared once for any number of samples:
///
///     v_j(t) = sum_m sum_l sqrt(2 df) |H_jm(f)| cos(2 pi f t + theta_jm + phi_ml),   m <= j,   l >= 1,   l df < cutoff,
///
/// with f of `Frequencies`. Spectra are one-sided in Hz; Eq. (15) is two-sided in rad/s, S2(omega) = S1(f) / (4 pi). Phases
/// phi_ml are pure functions of seed, component, m and l, so a sample does not depend on the number of threads. Reference:
/// Deodatis (1996), J. Eng. Mech. 122, 778-787.
class Simulator {
 public:
  /// @throws InputError  as `check` and `coherence_factor`; for a duration, rate or cutoff without any wave
  Simulator(FieldDefinition field, const SimulationOptions& options);

  /// One sample. @return [m/s] at t = 0, 1/rate, … over T: (n_samples × n_points)
  [[nodiscard]] Eigen::MatrixXd sample(std::uint64_t seed) const { return sample(seed, 0); }
  /// @param before  samples before t = 0 as well, which come first @return (before + n_samples × n_points)
  [[nodiscard]] Eigen::MatrixXd sample(std::uint64_t seed, Eigen::Index before) const;

  [[nodiscard]] const FieldDefinition& field() const { return field_; }
  [[nodiscard]] Eigen::Index n_samples() const { return n_samples_; }
  [[nodiscard]] double spacing_Hz() const { return df_; }
  /// Number of waves l = 1 … n_waves a point.
  [[nodiscard]] Eigen::Index n_waves() const { return n_waves_; }

 private:
  struct Bracket {
    Eigen::Index lower;  ///< anchor at or below
    double share;        ///< of the anchor above it, in [0, 1]
  };
  [[nodiscard]] Bracket bracket(double f_Hz) const;
  /// Waves [real, imaginary] of stream m, l = first, first + 1, … first + kLanes - 1.
  void waves(std::uint64_t seed, Eigen::Index m, Eigen::Index first, double* real, double* imaginary) const;
  void put_waves(std::uint64_t seed, Eigen::MatrixXd& velocity) const;
  /// Half the amplitudes of a point's waves on the lines k df / n, k = (l - 1) n + m.
  void put_double_indexed(std::uint64_t seed, Eigen::Index j, std::complex<double>* lines) const;
  [[nodiscard]] Eigen::MatrixXd double_indexed_sample(std::uint64_t seed, Eigen::Index before) const;

  FieldDefinition field_;
  SimulationOptions options_;
  Eigen::Index n_samples_ = 0, n_waves_ = 0;
  Eigen::Index n_lines_ = 0;  ///< n_waves, or n times as many
  double df_ = 0.0, line_Hz_ = 0.0;
  std::vector<double> anchor_Hz_;        ///< ascending
  std::vector<Eigen::MatrixXd> factor_;  ///< L at the anchors
  // Deterministic data of the waves of a sample.
  struct Stretch {
    std::size_t pair;           ///< of anchors
    Eigen::Index first, count;  ///< waves, at most kLanes
  };
  std::vector<FactorPair> pair_;     ///< of anchors a and a + 1; empty with an anchor at every wave
  std::vector<Stretch> stretch_;     ///< all waves in order, the costliest first
  Eigen::VectorXd share_;            ///< (n_lines) of the anchor above
  std::vector<Eigen::Index> lower_;  ///< (n_lines) anchor at or below, with double indexing
  std::vector<Eigen::Index> kind_;   ///< column of amplitude_ for each point
  Eigen::MatrixXd amplitude_;        ///< (n_lines × kinds of turbulence) sqrt(2 df S(f))
};

}  // namespace twindeck::wind
