#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <vector>

/// The sums over m of Eq. (15), a few waves at a time: most of what a simulation costs.
namespace twindeck::wind {

/// Waves that are worked on together.
inline constexpr int kLanes = 8;

/// The rows of two neighbouring anchors' factors, without entries that are nothing beside a row's length of one: where gusts
/// are shorter than the distance of points, that is most of them.
class FactorPair {
 public:
  /// @param low, high  (n × n) lower triangular, rows of length one
  FactorPair(const Eigen::MatrixXd& low, const Eigen::MatrixXd& high);

  struct Entry {
    int column;
    double low, high;
  };
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(apart_.size()); }
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

/// Random waves exp(i phi), or complex normal numbers of unit mean square, of kLanes places of a stream from `first` on: pure
/// functions of seed, stream and place. @param real, imaginary  kLanes numbers each
void random_waves(std::uint64_t seed, std::uint64_t stream, Eigen::Index first, bool normal, double* real, double* imaginary);

/// Where the waves of one call lie.
struct WaveLanes {
  double share[kLanes];      ///< of the anchor above, in [0, 1]
  double amplitude[kLanes];  ///< of the waves
};

/// exp(-2 pi i turns) of kLanes places.
struct Drift {
  double real[kLanes], imaginary[kLanes];
};
/// @param turns  kLanes numbers of either sign
void drifts(const double* turns, double* real, double* imaginary);

/// For the point of row j and the waves l of the lanes:  z_l = amplitude_l first lane_l sum_m L_jm(f_l) wave_ml,  L_j the two
/// rows mixed by share and brought back to length one.
/// @param wave   [m][real, imaginary][lane]
/// @param first, lane  factors of unit size: of all waves, of each (the drift to the point)
/// @param out    [lane][real, imaginary]
void wave_sums(const FactorPair& factor, Eigen::Index j, const double* wave, const WaveLanes& lanes, std::complex<double> first,
               const Drift& lane, double* out);

}  // namespace twindeck::wind
