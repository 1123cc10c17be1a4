#include "signal/correlation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "signal/fft.hpp"

namespace twindeck::signal {

using Eigen::Index;

namespace {

/// Sums of products of t in [begin, end), piece by piece: references over L samples, outputs over L + n_lags - 1, both padded
/// to the transform's length, so that lags 0 … n_lags - 1 see no wrap-around.
Eigen::VectorXd sums_of_block(const Eigen::Ref<const Eigen::MatrixXd>& data, const std::vector<Index>& references, Index n_lags,
                              Index begin, Index end, RealFft& fft) {
  const Index length = fft.size() - n_lags + 1;
  const Index n_frequencies = fft.size() / 2 + 1, n_outputs = data.cols();
  const auto n_references = static_cast<Index>(references.size());
  // One row a pair of channels and one column a frequency: each frequency's update is a small outer product of adjacent
  // numbers.
  Eigen::MatrixXcd spectrum = Eigen::MatrixXcd::Zero(n_outputs * n_references, n_frequencies);
  Eigen::MatrixXcd outputs(n_outputs, n_frequencies), inputs(n_references, n_frequencies);
  for (Index at = begin; at < end; at += length) {
    const Index n = std::min(length, end - at);
    for (Index c = 0; c < n_outputs; ++c)
      outputs.row(c) = fft.forward(data.col(c).segment(at, std::min(n + n_lags - 1, data.rows() - at))).transpose();
    for (Index r = 0; r < n_references; ++r)
      inputs.row(r) = fft.forward(data.col(references[static_cast<std::size_t>(r)]).segment(at, n)).adjoint();
    for (Index f = 0; f < n_frequencies; ++f) {
      Eigen::Map<Eigen::MatrixXcd>(spectrum.col(f).data(), n_outputs, n_references).noalias() +=
          outputs.col(f) * inputs.col(f).transpose();
    }
  }
  Eigen::VectorXd sums(n_outputs * n_references * n_lags);
  for (Index pair = 0; pair < spectrum.rows(); ++pair) {
    const Eigen::VectorXcd row = spectrum.row(pair).transpose();
    const Eigen::VectorXd correlation = fft.inverse(row);
    for (Index k = 0; k < n_lags; ++k) sums[k * spectrum.rows() + pair] = correlation[k];
  }
  return sums;
}

}  // namespace

std::vector<Eigen::MatrixXd> BlockCorrelations::mean(Index without) const {
  Eigen::VectorXd total = sums.rowwise().sum();
  Eigen::VectorXd count = counts.rowwise().sum();
  if (without >= 0) {
    total -= sums.col(without);
    count -= counts.col(without);
  }
  std::vector<Eigen::MatrixXd> lags;
  for (Index k = 0; k < n_lags; ++k) {
    lags.emplace_back(Eigen::Map<const Eigen::MatrixXd>(total.data() + k * n_outputs * n_references, n_outputs, n_references) /
                      count[k]);
  }
  return lags;
}

void BlockCorrelations::append(const BlockCorrelations& other) {
  if (n_blocks() == 0) {
    *this = other;
    return;
  }
  TWINDECK_ASSERT(other.sums.rows() == sums.rows() && other.n_lags == n_lags);
  const Index before = n_blocks();
  sums.conservativeResize(Eigen::NoChange, before + other.n_blocks());
  counts.conservativeResize(Eigen::NoChange, before + other.n_blocks());
  sums.rightCols(other.n_blocks()) = other.sums;
  counts.rightCols(other.n_blocks()) = other.counts;
}

BlockCorrelations correlations(const Eigen::Ref<const Eigen::MatrixXd>& data, const std::vector<Index>& references,
                               Index n_lags, Index n_blocks) {
  TWINDECK_ASSERT(n_lags >= 1 && n_blocks >= 1 && !references.empty());
  const Index length = data.rows() / n_blocks;
  if (length < 2 * n_lags) {
    throw InputError({"", 0, "blocks"},
                     fmt::format("cut the record of {} samples into {} blocks of {}, expected at least {}, twice the {} lags",
                                 data.rows(), n_blocks, length, 2 * n_lags, n_lags),
                     "ask for fewer blocks or block rows, a smaller decimation, or give a longer record");
  }
  BlockCorrelations result;
  result.n_outputs = data.cols();
  result.n_references = static_cast<Index>(references.size());
  result.n_lags = n_lags;
  result.sums.resize(result.n_outputs * result.n_references * n_lags, n_blocks);
  result.counts.resize(n_lags, n_blocks);
  RealFft fft(fast_fft_size(std::min(length + n_lags, std::max<Index>(4 * n_lags, 256))));
  for (Index b = 0; b < n_blocks; ++b) {
    const Index begin = b * length, end = b + 1 == n_blocks ? data.rows() : begin + length;
    result.sums.col(b) = sums_of_block(data, references, n_lags, begin, end, fft);
    for (Index k = 0; k < n_lags; ++k) result.counts(k, b) = static_cast<double>(std::min(end, data.rows() - k) - begin);
  }
  return result;
}

}  // namespace twindeck::signal
