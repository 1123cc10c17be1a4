#include "identification/quality.hpp"

#include <fmt/format.h>

#include <cmath>

#include "identification/clipping.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

ChannelQuality quality_of(const Eigen::Ref<const Eigen::VectorXd>& x) {
  ChannelQuality q;
  q.samples = x.size();
  double sum = 0.0, lowest = 0.0, highest = 0.0;
  long run = 0, there = 0;
  for (Index t = 0; t < x.size(); ++t) {
    run = std::isfinite(x[t]) ? 0 : run + 1;
    q.longest_gap = std::max(q.longest_gap, run);
    if (run > 0) continue;
    lowest = there == 0 ? x[t] : std::min(lowest, x[t]);
    highest = there == 0 ? x[t] : std::max(highest, x[t]);
    sum += x[t];
    ++there;
  }
  q.missing = q.samples - there;
  if (there == 0 || lowest == highest) {
    q.mean = lowest;
    q.dead = true;
    return q;
  }
  q.mean = sum / static_cast<double>(there);
  q.clipped = clipped_samples(x, lowest, highest);
  q.lone = lone_sample(x);
  // Least-squares line in u in [-1, 1] over the samples that are there.
  double squares = 0.0, u_sum = 0.0, u_squares = 0.0, product = 0.0;
  for (Index t = 0; t < x.size(); ++t) {
    if (!std::isfinite(x[t])) continue;
    const double u = x.size() < 2 ? 0.0 : 2.0 * static_cast<double>(t) / static_cast<double>(x.size() - 1) - 1.0,
                 v = x[t] - q.mean;
    squares += v * v;
    u_sum += u;
    u_squares += u * u;
    product += u * v;
  }
  q.rms = std::sqrt(squares / static_cast<double>(there));
  q.drift = 2.0 * product / (u_squares - u_sum * u_sum / static_cast<double>(there)) / q.rms;
  return q;
}

}  // namespace

std::vector<ChannelQuality> channel_quality(const Samples& data, const std::vector<std::string>& channels,
                                            const std::string& setup, const std::string& record) {
  std::vector<ChannelQuality> rows;
  for (Index c = 0; c < data.cols(); ++c) {
    rows.push_back(quality_of(data.col(c)));
    rows.back().setup = setup;
    rows.back().record = record;
    rows.back().channel = channels[static_cast<std::size_t>(c)];
  }
  return rows;
}

long fill_gaps(Eigen::MatrixXd& data, const std::vector<std::string>& channels, long longest, const std::string& record) {
  long filled = 0;
  for (Index c = 0; c < data.cols(); ++c) {
    for (Index t = 0; t < data.rows(); ++t) {
      if (std::isfinite(data(t, c))) continue;
      Index end = t;
      while (end < data.rows() && !std::isfinite(data(end, c))) ++end;
      const long gap = end - t;
      if (gap > longest || t == 0 || end == data.rows()) {
        long most = 0;
        for (Index k = 0; k < data.cols(); ++k) most = std::max(most, quality_of(data.col(k)).longest_gap);
        throw UnusableRecord(
            {record, 0, channels[static_cast<std::size_t>(c)]},
            fmt::format("has a gap of {} samples from sample {} on, expected none over {} and none at an end", gap, t, longest),
            fmt::format("cut the record, leave the channel out (--set 'exclude=[\"{}\"]'){}",
                        channels[static_cast<std::size_t>(c)],
                        t == 0 || end == data.rows() ? "" : fmt::format(", or bridge gaps (--set longest_gap={})", most)));
      }
      const double before = data(t - 1, c), step = (data(end, c) - before) / static_cast<double>(gap + 1);
      for (Index k = t; k < end; ++k) data(k, c) = before + step * static_cast<double>(k - t + 1);
      filled += gap;
      t = end;
    }
  }
  return filled;
}

}  // namespace twindeck::identification
