#include "identification/lying_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kStuck =
    0.05;  ///< [-] of the record that repeats the sample before: a loss that bends the channel's shape by several per cent
constexpr double kHeld = 0.01;             ///< [-] the same, of a run that resolution does not explain: a spurious mode at 3 %
constexpr double kAlone = 10.0;            ///< times the tenth longest run: then it is no matter of resolution
constexpr double kRoundingOfGain = 1e-12;  ///< [-] what the gain's multiplication does to equal values

/// The longest run of one value.
struct Run {
  Index first = 0, length = 0;
  Index usual = 1;  ///< length of the tenth longest
};

Run longest_run(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Run best, now;
  std::vector<Index> lengths;  // of the runs that have ended
  for (Index t = 0; t < x.size(); ++t) {
    const bool same = t > 0 && x[t] == x[t - 1];
    if (!same && now.length > 1) lengths.push_back(now.length);
    now = same ? Run{now.first, now.length + 1, 1} : Run{t, std::isfinite(x[t]) ? 1 : 0};
    if (now.length > best.length) best = now;
  }
  constexpr std::size_t tenth = 9;
  if (lengths.size() <= tenth) return best;
  std::nth_element(lengths.begin(), lengths.begin() + tenth, lengths.end(), std::greater<>());
  best.usual = lengths[tenth];
  return best;
}

bool is_copy(const Eigen::Ref<const Eigen::VectorXd>& a, double gain_a, const Eigen::Ref<const Eigen::VectorXd>& b,
             double gain_b) {
  for (Index t = 0; t < a.size(); ++t) {
    const double x = a[t] / gain_a, y = b[t] / gain_b;
    if (std::isnan(x) && std::isnan(y)) continue;
    if (!(std::abs(x - y) <= kRoundingOfGain * std::abs(x))) return false;
  }
  return true;
}

double median_rms(const JudgedChannels& judged, const std::vector<ChannelQuality>& quality) {
  std::vector<double> rms;
  for (const Index c : judged.columns) rms.push_back(quality[static_cast<std::size_t>(c)].rms);
  std::nth_element(rms.begin(), rms.begin() + std::ssize(rms) / 2, rms.end());
  return rms[rms.size() / 2];
}

void judge_motion(const Samples& raw, const JudgedChannels& judged, std::vector<ChannelQuality>& quality) {
  const double usual = median_rms(judged, quality);
  std::vector<Run> runs;
  for (const Index c : judged.columns) runs.push_back(longest_run(raw.col(c)));
  const auto stuck = [&](const Run& run) {
    const bool held = !judged.may_rest && static_cast<double>(run.length) > kAlone * static_cast<double>(run.usual);
    return static_cast<double>(run.length - 1) > (held ? kHeld : kStuck) * static_cast<double>(raw.rows());
  };
  const bool most = 2 * std::count_if(runs.begin(), runs.end(), stuck) > std::ssize(runs);
  for (std::size_t k = 0; k < judged.columns.size(); ++k) {
    ChannelQuality& q = quality[static_cast<std::size_t>(judged.columns[k])];
    if (q.dead) {
      q.left_out = fmt::format("is constant ({}) over {} samples", q.mean, q.samples);
    } else if (q.rms < kUnresolved * usual) {
      q.left_out = fmt::format("does not move: its RMS is {:.3g} beside {:.3g} of the others", q.rms, usual);
    } else if (stuck(runs[k]) && !(judged.may_rest && most)) {
      q.left_out = fmt::format("is stuck: it holds {:.6g} over {} samples in a row from sample {} on, {:.3g} % of the record",
                               raw(runs[k].first, judged.columns[k]), runs[k].length, runs[k].first,
                               100.0 * static_cast<double>(runs[k].length) / static_cast<double>(raw.rows()));
    }
  }
}

}  // namespace

void judge_channels(const Samples& raw, const JudgedChannels& judged, std::vector<ChannelQuality>& quality) {
  if (judged.columns.empty() || raw.rows() == 0) return;
  judge_motion(raw, judged, quality);
  for (std::size_t j = 0; j < judged.columns.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      ChannelQuality *a = &quality[static_cast<std::size_t>(judged.columns[i])],
                     *b = &quality[static_cast<std::size_t>(judged.columns[j])];
      if (!a->left_out.empty() || !b->left_out.empty()) continue;
      if (!is_copy(raw.col(judged.columns[i]), judged.gain[i], raw.col(judged.columns[j]), judged.gain[j])) continue;
      if (judged.reference[j] && !judged.reference[i]) std::swap(a, b);
      b->left_out = fmt::format("is a copy of {}: both hold the same values", a->channel);
    }
  }
}

}  // namespace twindeck::identification
