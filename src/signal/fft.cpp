#include "signal/fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <mutex>

#include "core/error.hpp"

namespace twindeck::signal {

using Eigen::Index;

namespace {

// FFTW's planner is not safe to be used by two threads at once; its transforms are.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

struct RealFft::Impl {
  Index n;
  double* time;
  fftw_complex* frequency;
  fftw_plan forward, backward;
};

RealFft::RealFft(Index size) : impl_(std::make_unique<Impl>()) {
  TWINDECK_ASSERT(size >= 1);
  const std::lock_guard<std::mutex> lock(planner());
  impl_->n = size;
  impl_->time = fftw_alloc_real(static_cast<std::size_t>(size));
  impl_->frequency = fftw_alloc_complex(static_cast<std::size_t>(size / 2 + 1));
  const int n = static_cast<int>(size);
  impl_->forward = fftw_plan_dft_r2c_1d(n, impl_->time, impl_->frequency, FFTW_ESTIMATE);
  impl_->backward = fftw_plan_dft_c2r_1d(n, impl_->frequency, impl_->time, FFTW_ESTIMATE);
}

RealFft::~RealFft() {
  const std::lock_guard<std::mutex> lock(planner());
  fftw_destroy_plan(impl_->forward);
  fftw_destroy_plan(impl_->backward);
  fftw_free(impl_->time);
  fftw_free(impl_->frequency);
}

Index RealFft::size() const { return impl_->n; }

Eigen::VectorXcd RealFft::forward(const Eigen::Ref<const Eigen::VectorXd>& x) {
  TWINDECK_ASSERT(x.size() <= impl_->n);
  std::copy(x.data(), x.data() + x.size(), impl_->time);
  std::fill(impl_->time + x.size(), impl_->time + impl_->n, 0.0);
  fftw_execute(impl_->forward);
  return Eigen::Map<const Eigen::VectorXcd>(reinterpret_cast<const std::complex<double>*>(impl_->frequency), impl_->n / 2 + 1);
}

Eigen::VectorXd RealFft::inverse(const Eigen::Ref<const Eigen::VectorXcd>& spectrum) {
  TWINDECK_ASSERT(spectrum.size() == impl_->n / 2 + 1);
  std::copy(spectrum.data(), spectrum.data() + spectrum.size(), reinterpret_cast<std::complex<double>*>(impl_->frequency));
  fftw_execute(impl_->backward);
  return Eigen::Map<const Eigen::VectorXd>(impl_->time, impl_->n) / static_cast<double>(impl_->n);
}

void RealFft::sum_of_waves(const std::complex<double>* waves, Index first, Index count, double* values) {
  TWINDECK_ASSERT(first >= 1 && 2 * (first + count) <= impl_->n + 1);
  auto* bins = reinterpret_cast<std::complex<double>*>(impl_->frequency);
  std::fill(bins, bins + first, 0.0);
  std::copy(waves, waves + count, bins + first);
  std::fill(bins + first + count, bins + impl_->n / 2 + 1, 0.0);
  if (fftw_alignment_of(values) ==
      fftw_alignment_of(impl_->time)) {  // a plan holds for memory aligned as that it was made with
    fftw_execute_dft_c2r(impl_->backward, impl_->frequency, values);
    return;
  }
  fftw_execute(impl_->backward);
  std::copy(impl_->time, impl_->time + impl_->n, values);
}

Index fast_fft_size(Index wanted) {
  for (Index n = std::max<Index>(wanted, 1);; ++n) {
    Index rest = n;
    for (const Index prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

}  // namespace twindeck::signal
