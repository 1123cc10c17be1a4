#include "wind/wave_sums.hpp"

#include <cmath>
#include <cstddef>

#include "core/random.hpp"

namespace twindeck::wind {

using Eigen::Index;

FactorPair::FactorPair(const Eigen::MatrixXd& low, const Eigen::MatrixXd& high) {
  constexpr double nothing = 1e-18;  // sixty of them are below the rounding of a row of length one
  begin_.push_back(0);
  for (Index j = 0; j < low.rows(); ++j) {
    double square = 0.0;
    for (Index m = 0; m <= j; ++m) {
      const double a = low(j, m), b = high(j, m);
      square += (a - b) * (a - b);
      if (std::abs(a) > nothing || std::abs(b) > nothing) entries_.push_back({static_cast<int>(m), a, b});
    }
    begin_.push_back(entries_.size());
    apart_.push_back(0.5 * square);
  }
}

// Two widths of the processor, here and below; neither fuses products with sums, so that both give the same bytes. The choice
// is made before ThreadSanitizer starts, which it does not survive: there is one width there.
#ifdef __SANITIZE_THREAD__
#define TWINDECK_TWO_WIDTHS
#else
#define TWINDECK_TWO_WIDTHS [[gnu::target_clones("avx2", "default")]]
#endif

TWINDECK_TWO_WIDTHS static void unit_waves(const double* turns, double* cosine, double* sine) {
  for (int i = 0; i < kLanes; ++i) unit_wave(turns[i], cosine[i], sine[i]);
}

void drifts(const double* turns, double* real, double* imaginary) {
  double size[kLanes];
  for (int i = 0; i < kLanes; ++i) size[i] = std::abs(turns[i]);
  unit_waves(size, real, imaginary);
  for (int i = 0; i < kLanes; ++i) imaginary[i] = turns[i] < 0.0 ? imaginary[i] : -imaginary[i];
}

void random_waves(std::uint64_t seed, std::uint64_t stream, Index first, bool normal, double* real, double* imaginary) {
  double turns[kLanes];
  for (int i = 0; i < kLanes; ++i) turns[i] = uniform_number(seed, stream, 2 * static_cast<std::uint64_t>(first + i));
  unit_waves(turns, real, imaginary);
  if (!normal) return;
  for (int i = 0; i < kLanes; ++i) {
    const double size = std::sqrt(-std::log(1.0 - uniform_number(seed, stream, 2 * static_cast<std::uint64_t>(first + i) + 1)));
    real[i] *= size;
    imaginary[i] *= size;
  }
}

TWINDECK_TWO_WIDTHS void wave_sums(const FactorPair& factor, Index j, const double* wave, const WaveLanes& lanes,
                                   std::complex<double> first, const Drift& lane, double* out) {
  using Four = double __attribute__((vector_size(32)));  // sums that stay in registers
  // Four numbers in memory. Clang ignores this after `using`, and `auto` loses it.
  typedef Four Numbers __attribute__((aligned(8), may_alias));
  static_assert(alignof(Numbers) == alignof(double));
  Four low0{}, low1{}, low2{}, low3{}, high0{}, high1{}, high2{}, high3{};  // real 0-3, real 4-7, imaginary 0-3, imaginary 4-7
  const FactorPair::Entry* entry = factor.row(j);
  for (int k = factor.entries(j); k > 0; --k, ++entry) {
    const Numbers* w = reinterpret_cast<const Numbers*>(wave + static_cast<std::ptrdiff_t>(2 * kLanes) * entry->column);
    const Four w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
    const double a = entry->low, b = entry->high;
    low0 += a * w0;
    low1 += a * w1;
    low2 += a * w2;
    low3 += a * w3;
    high0 += b * w0;
    high1 += b * w1;
    high2 += b * w2;
    high3 += b * w3;
  }
  const double apart = 2.0 * factor.apart(j);
  double scale[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const double t = lanes.share[i];
    scale[i] = lanes.amplitude[i] / std::sqrt(1.0 - (1.0 - t) * t * apart);  // rows back to length one
  }
  const double first_real = first.real(), first_imaginary = first.imag();
  for (int half = 0; half < 2; ++half) {
    const Four t = *reinterpret_cast<const Numbers*>(lanes.share + 4 * half),
               size4 = *reinterpret_cast<const Numbers*>(scale + 4 * half), r = 1.0 - t;
    const Four x = size4 * (r * (half == 0 ? low0 : low1) + t * (half == 0 ? high0 : high1));
    const Four y = size4 * (r * (half == 0 ? low2 : low3) + t * (half == 0 ? high2 : high3));
    const Four c = *reinterpret_cast<const Numbers*>(lane.real + 4 * half),
               d = *reinterpret_cast<const Numbers*>(lane.imaginary + 4 * half);
    const Four cosine = first_real * c - first_imaginary * d, sine = first_real * d + first_imaginary * c;
    const Four real = cosine * x - sine * y, imaginary = cosine * y + sine * x;
    for (int i = 0; i < 4; ++i) {
      out[8 * half + 2 * i] = real[i];
      out[8 * half + 2 * i + 1] = imaginary[i];
    }
  }
}

}  // namespace twindeck::wind
