#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>

namespace twindeck::signal {

/// Discrete Fourier transform of real sequences of one length (FFTW, the plan is made once and not tuned to the machine, so
/// that the same input gives the same bytes):  X_m = sum_t x_t exp(-2 pi i m t / n),  m = 0 … n/2.
class RealFft {
 public:
  /// @param size  n >= 1
  explicit RealFft(Eigen::Index size);
  ~RealFft();
  RealFft(const RealFft&) = delete;
  RealFft& operator=(const RealFft&) = delete;

  [[nodiscard]] Eigen::Index size() const;
  /// @param x  at most n values; the rest counts as zeros @return (n/2 + 1)
  [[nodiscard]] Eigen::VectorXcd forward(const Eigen::Ref<const Eigen::VectorXd>& x);
  /// The inverse, with its factor 1/n: inverse(forward(x)) = x. @param spectrum (n/2 + 1) @return (n)
  [[nodiscard]] Eigen::VectorXd inverse(const Eigen::Ref<const Eigen::VectorXcd>& spectrum);
  /// Values x_t = sum over l of 2 Re(waves_l exp(2 pi i (first + l) t / n)): the inverse without its factor, of a band of the
  /// spectrum, zero elsewhere.
  /// @param first  >= 1, first + count <= (n + 1) / 2  @param values  (n); may share memory with the waves
  void sum_of_waves(const std::complex<double>* waves, Eigen::Index first, Eigen::Index count, double* values);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Smallest length of at least `wanted` whose only prime factors are 2, 3 and 5: fast to transform.
[[nodiscard]] Eigen::Index fast_fft_size(Eigen::Index wanted);

}  // namespace twindeck::signal
