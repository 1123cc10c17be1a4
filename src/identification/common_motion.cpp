#include "identification/common_motion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "signal/welch.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr Index kSegments = 60;            // half-overlapping segments of the shortest record, which separate motion from noise
constexpr Index kLeastSegment = 64;        // [samples] shorter segments do not resolve modes from noise
constexpr double kIndependentShare = 0.8;  // independent segments per half-overlapping segment (Welch: 9/11)
/// [bytes] Most memory for cross spectra. Sixteen channels get lines of 1/131,072 of the rate, 256 channels 1/512.
constexpr Index kMostBytes = Index{256} << 20U;
/// Threshold above the bound of noise: three tenths of the bound or, with few channels, a quarter of the distance from the
/// bound to one common motion.
constexpr double kAbove = 0.3, kShareOfWay = 0.25;

/// Cross spectra of all records, weighted by their segments.
signal::CrossSpectra weighted_spectra(const std::vector<Samples>& records, double rate_Hz, Index segment) {
  signal::CrossSpectra sum;
  for (const Samples& record : records) {
    signal::CrossSpectra one = signal::cross_spectra(record, rate_Hz, {segment, 0.5});
    for (Eigen::MatrixXcd& density : one.density) density *= static_cast<double>(one.n_segments);
    if (sum.density.empty()) {
      sum = std::move(one);
      continue;
    }
    for (std::size_t f = 0; f < sum.density.size(); ++f) sum.density[f] += one.density[f];
    sum.n_segments += one.n_segments;
  }
  return sum;
}

double largest_of_coherences(const Eigen::MatrixXcd& density) {
  const Eigen::VectorXd scale = density.diagonal().real().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXcd coherence = scale.asDiagonal() * density * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(coherence, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

Index common_motion_segment(Index n_samples, Index n_channels) {
  const Index longest = 2 * kMostBytes / (static_cast<Index>(sizeof(std::complex<double>)) * n_channels * n_channels);
  return std::max(kLeastSegment, std::min(longest, 2 * n_samples / (kSegments + 1)));
}

double highest_common_Hz(const std::vector<Samples>& records, double rate_Hz) {
  const Index n_channels = records.front().cols();
  Index shortest = records.front().rows();
  for (const Samples& record : records) shortest = std::min(shortest, record.rows());
  const Index segment = common_motion_segment(shortest, n_channels);
  if (n_channels < 2 || segment > shortest) return 0.0;
  const signal::CrossSpectra spectra = weighted_spectra(records, rate_Hz, segment);
  const auto n = static_cast<double>(n_channels);
  const double bound = std::pow(1.0 + std::sqrt(n / (kIndependentShare * static_cast<double>(spectra.n_segments))), 2);
  const double least = std::min((1.0 + kAbove) * bound, bound + kShareOfWay * (n - bound));
  if (bound >= n) return 0.0;
  bool before = false;
  for (Index f = spectra.frequency_Hz.size() - 1; f > 0; --f) {
    const bool common = largest_of_coherences(spectra.density[static_cast<std::size_t>(f)]) > least;
    if (common && before) return spectra.frequency_Hz[f + 1];
    before = common;
  }
  return 0.0;
}

}  // namespace twindeck::identification
