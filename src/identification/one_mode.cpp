#include "identification/one_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twindeck::identification {

namespace {

constexpr double kApart = 3.0;     ///< standard deviations of the difference of two frequencies
constexpr double kOneShape = 0.9;  ///< [-] MAC of shapes that are alike

bool are_one(const MergedMode& low, const MergedMode& high) {
  const double sigma = std::hypot(low.deviation.frequency_Hz, high.deviation.frequency_Hz);
  return high.frequency_Hz - low.frequency_Hz <= kApart * sigma && known_mac(low.shape, high.shape) >= kOneShape;
}

/// Mean of two values weighted by 1/variance; the surer value if its deviation is 0.
double weighted(double sure, double sigma, double other, double other_sigma) {
  const double all = sigma * sigma + other_sigma * other_sigma;
  return all > 0.0 ? sure + (other - sure) * sigma * sigma / all : sure;
}

void fill_shape(MergedMode& sure, const MergedMode& other) {
  std::complex<double> product = 0.0;
  double norm = 0.0;
  for (Eigen::Index c = 0; c < sure.shape.size(); ++c) {
    if (std::isnan(std::abs(sure.shape[c])) || std::isnan(std::abs(other.shape[c]))) continue;
    product += std::conj(other.shape[c]) * sure.shape[c];
    norm += std::norm(other.shape[c]);
  }
  const std::complex<double> scale = product / norm;
  for (Eigen::Index c = 0; c < sure.shape.size(); ++c) {
    if (!std::isnan(std::abs(sure.shape[c])) || std::isnan(std::abs(other.shape[c]))) continue;
    sure.shape[c] = scale * other.shape[c];
    sure.deviation.shape_real[c] = std::abs(scale) * other.deviation.shape_real[c];
    sure.deviation.shape_imag[c] = std::abs(scale) * other.deviation.shape_imag[c];
  }
}

MergedMode merged(MergedMode sure, MergedMode other) {
  if (other.deviation.frequency_Hz < sure.deviation.frequency_Hz) std::swap(sure, other);
  const auto &own = sure.deviation, &its = other.deviation;
  const double f_apart = other.frequency_Hz - sure.frequency_Hz, zeta_apart = other.damping_ratio - sure.damping_ratio;
  fill_shape(sure, other);
  sure.frequency_Hz = weighted(sure.frequency_Hz, own.frequency_Hz, other.frequency_Hz, its.frequency_Hz);
  sure.damping_ratio = weighted(sure.damping_ratio, own.damping_ratio, other.damping_ratio, its.damping_ratio);
  sure.frequency_scatter_Hz = std::max(sure.frequency_scatter_Hz, other.frequency_scatter_Hz);
  sure.damping_ratio_scatter = std::max(sure.damping_ratio_scatter, other.damping_ratio_scatter);
  sure.deviation.frequency_Hz = std::hypot(own.frequency_Hz, f_apart);
  sure.deviation.damping_ratio = std::hypot(own.damping_ratio, zeta_apart);
  sure.members.insert(sure.members.end(), other.members.begin(), other.members.end());
  std::ranges::sort(sure.members);
  return sure;
}

}  // namespace

std::vector<std::string> merge_modes_that_are_one(ConditionResult& result) {
  std::vector<std::string> lines;
  if (result.channels.size() < 2) return lines;
  for (std::size_t m = 0; m + 1 < result.modes.size();) {
    MergedMode &low = result.modes[m], &high = result.modes[m + 1];
    if (!are_one(low, high)) {
      ++m;
      continue;
    }
    const double f_low = low.frequency_Hz, f_high = high.frequency_Hz;
    low = merged(std::move(low), std::move(high));
    lines.push_back(fmt::format(
        "condition {}: the modes at {:.4g} and {:.4g} Hz are one, mode {} at {:.4g} Hz: their shapes are alike and their "
        "frequencies lie within their standard deviations; pick modes by hand (key keep) to have both",
        result.condition, f_low, f_high, m + 1, low.frequency_Hz));
    result.modes.erase(result.modes.begin() + static_cast<std::ptrdiff_t>(m + 1));
    if (m + 1 < result.checks.size()) {
      if (!result.checks[m].found) result.checks[m] = result.checks[m + 1];
      result.checks.erase(result.checks.begin() + static_cast<std::ptrdiff_t>(m + 1));
    }
  }
  return lines;
}

}  // namespace twindeck::identification
