#include "identification/releases.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHalfSecond = 0.5;   ///< [s] over which the motion is averaged; releases within it are one
constexpr Index kRegressors = 60;     ///< of the prediction: two for each mode of thirty
constexpr double kSurprise = 10.0;    ///< [standard deviations] of a prediction's error at a release; noise reaches five
constexpr double kLeastShare = 0.1;   ///< of the largest energy: a third of the amplitude
constexpr double kLeastLength = 0.5;  ///< of the longest decay

/// Largest error of a linear prediction over the channels, in standard deviations (n_samples); 0 where nothing is predicted.
VectorXd surprise_of(const Eigen::Ref<const MatrixXd>& data) {
  const Index channels = data.cols(), lags = std::max<Index>(2, kRegressors / channels), n = data.rows() - lags;
  VectorXd out = VectorXd::Zero(data.rows());
  if (n < 4 * lags * channels) return out;
  const auto past = [&](Index lag) { return data.middleRows(lags - lag, n); };
  MatrixXd normal(lags * channels, lags * channels), right(lags * channels, channels), error = past(0);
  for (Index k = 0; k < lags; ++k) {
    right.middleRows(k * channels, channels) = linalg::product(past(k + 1), past(0), true);
    for (Index l = 0; l < lags; ++l)
      normal.block(k * channels, l * channels, channels, channels) = linalg::product(past(k + 1), past(l + 1), true);
  }
  normal.diagonal() *= 1.0 + 1e-9;  // a record without noise determines fewer unknowns than there are
  const MatrixXd factor = normal.ldlt().solve(right);
  for (Index k = 0; k < lags; ++k) error -= past(k + 1) * factor.middleRows(k * channels, channels);
  for (Index c = 0; c < channels; ++c) {
    const VectorXd size = error.col(c).cwiseAbs();
    // The median of a normal law's magnitudes lies at 0.6745 standard deviations. Rounding is no noise.
    const double deviation = std::max(median({size.begin(), size.end()}) / 0.6745, 1e-6 * data.col(c).cwiseAbs().maxCoeff());
    if (deviation > 0.0) out.tail(n) = out.tail(n).cwiseMax(size / deviation);
  }
  return out;
}

/// Mean energy of `count` samples from each sample on (n_samples - count + 1).
VectorXd running_mean(const VectorXd& energy, Index count) {
  VectorXd out(energy.size() - count + 1);
  out[0] = energy.head(count).sum();
  for (Index t = 1; t < out.size(); ++t) out[t] = out[t - 1] + energy[t + count - 1] - energy[t - 1];
  return out / static_cast<double>(count);
}

}  // namespace

VectorXd energy_of(const Eigen::Ref<const MatrixXd>& data) {
  const VectorXd scale = data.colwise().squaredNorm().transpose().cwiseMax(1e-300);
  return (data.array().square().rowwise() / scale.transpose().array()).rowwise().sum();
}

std::vector<std::pair<Index, Index>> decays_of(const Eigen::Ref<const MatrixXd>& data, double rate_Hz) {
  const Index half = std::max<Index>(2, static_cast<Index>(std::lround(kHalfSecond * rate_Hz)));
  if (data.rows() <= 4 * half) return {{0, data.rows()}};
  const VectorXd mean = running_mean(energy_of(data), half), surprise = surprise_of(data);
  const double largest = mean.maxCoeff();
  std::vector<Index> starts = {0};
  for (Index t = half; t + half < data.rows(); ++t) {
    const bool rises = mean[t] > mean[t - half] && mean[t] > kLeastShare * largest;
    if (rises && surprise[t] > kSurprise && t >= starts.back() + half) starts.push_back(t);
  }
  std::vector<std::pair<Index, Index>> decays;
  Index longest = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Index end = i + 1 < starts.size() ? starts[i + 1] : data.rows();
    if (end - starts[i] <= half) continue;
    Index first = 0;
    const double most = mean.segment(starts[i], end - starts[i] - half + 1).maxCoeff(&first);
    first += starts[i];
    if (most < kLeastShare * largest) continue;
    decays.emplace_back(first, end - first);
    longest = std::max(longest, end - first);
  }
  std::erase_if(decays, [&](const auto& decay) {
    return static_cast<double>(decay.second) < kLeastLength * static_cast<double>(longest);
  });
  return decays;
}

}  // namespace twindeck::identification
