#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <vector>

/// The sums over m of Eq. (15), a few waves at a time. They are the largest cost of a simulation.
namespace twindeck::wind {

/// Number of waves that are processed together (SIMD).
inline constexpr int kLanes = 8;

/// The rows of the factors of two neighbouring anchors, without negligible entries (rows have length one). If gusts are shorter
/// than the distance of points, most entries are negligible.
class FactorPair {
 public:
  /// @param low, high  (n × n) lower triangular, rows of length one
  FactorPair(const Eigen::MatrixXd& low, const Eigen::MatrixXd& high);

  struct Entry {
    int column;
    double low, high;
  };
  [[nodiscard]] Eigen::Index size() const { return std::ssize(apart_); }
  [[nodiscard]] const Entry* row(Eigen::Index j) const { return entries_.data() + begin_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] int entries(Eigen::Index j) const {
    return static_cast<int>(begin_[static_cast<std::size_t>(j) + 1] - begin_[static_cast<std::size_t>(j)]);
  }
  /// 1 - cosine of the angle between the two rows.
  [[nodiscard]] double apart(Eigen::Index j) const { return apart_[static_cast<std::size_t>(j)]; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::size_t> begin_;
  std::vector<double> apart_;
};

/// Random waves exp(i phi), or complex normal numbers of unit mean square, of kLanes positions of a stream from `first` on:
/// pure functions of seed, stream and position. @param real, imaginary  kLanes numbers each
void random_waves(std::uint64_t seed, std::uint64_t stream, Eigen::Index first, bool normal, double* real, double* imaginary);

/// Interpolation data of the waves of one call.
struct WaveLanes {
  double share[kLanes];      ///< of the anchor above, in [0, 1]
  double amplitude[kLanes];  ///< of the waves
};

/// exp(-2 pi i turns) of kLanes waves.
struct Drift {
  double real[kLanes], imaginary[kLanes];
};
/// @param turns  kLanes numbers of either sign
void drifts(const double* turns, double* real, double* imaginary);

/// For the point of row j and the waves l of the lanes:  z_l = amplitude_l first lane_l sum_m L_jm(f_l) wave_ml,  L_j the two
/// rows interpolated by share and scaled to length one.
/// @param wave   [m][real, imaginary][lane]
/// @param first, lane  factors of unit size: of all waves, of each (the drift to the point)
/// @param out    [lane][real, imaginary]
void wave_sums(const FactorPair& factor, Eigen::Index j, const double* wave, const WaveLanes& lanes, std::complex<double> first,
               const Drift& lane, double* out);

/// exp(2 pi i u) without a library call, so that the compiler can vectorise it. The simulation spends most of its time here.
/// Agrees with std::cos and std::sin of 2 pi u to 2e-16.
/// @param turns  u >= 0, below 2³⁰
inline void unit_wave(double turns, double& cosine, double& sine) {
  const int quarter = static_cast<int>(4.0 * turns + 0.5);  // nearest quarter turn
  const double x = (turns - 0.25 * quarter) * 6.283185307179586476925;
  const double z = x * x;
  // Taylor's series on [-pi/4, pi/4]; the first term left out is below 1e-17
  const double s =
      x * (1.0 + z * (-1.0 / 6 +
                      z * (1.0 / 120 + z * (-1.0 / 5040 +
                                            z * (1.0 / 362880 + z * (-1.0 / 39916800 + z * (1.0 / 6227020800.0 +
                                                                                            z * (-1.0 / 1307674368000.0))))))));
  const double c =
      1.0 +
      z * (-0.5 + z * (1.0 / 24 +
                       z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800 + z * (1.0 / 479001600.0 +
                                                                                       z * (-1.0 / 87178291200.0 +
                                                                                            z * (1.0 / 20922789888000.0))))))));
  const bool odd = (quarter & 1) != 0, half = (quarter & 2) != 0;
  const double a = odd ? -s : c, b = odd ? c : s;
  cosine = half ? -a : a;
  sine = half ? -b : b;
}

}  // namespace twindeck::wind
