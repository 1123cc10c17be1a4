#include "identification/merge_poser.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

struct Candidate {
  std::size_t setup, mode;
};

struct Comparison {
  double mac = 1.0;
  double noise = 0.0;  ///< expected 1 - MAC of two estimates of one shape with these deviations
};
Comparison compare(const SetupModes& a, std::size_t p, const SetupModes& b, std::size_t q) {
  const Cluster &first = a.modes[p], &second = b.modes[q];
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0, va = 0.0, vb = 0.0;
  int common = 0;
  const auto variance = [](const ModeDeviation& d, Index i) {
    return std::pow(d.shape_real[i], 2) + std::pow(d.shape_imag[i], 2);
  };
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    for (std::size_t j = 0; j < b.channels.size(); ++j) {
      if (a.channels[i] != b.channels[j]) continue;
      const auto at = static_cast<Index>(i), bt = static_cast<Index>(j);
      product += std::conj(first.shape[at]) * second.shape[bt];
      aa += std::norm(first.shape[at]);
      bb += std::norm(second.shape[bt]);
      va += variance(a.deviations[p], at);
      vb += variance(b.deviations[q], bt);
      ++common;
    }
  }
  if (common < 2) return {};
  if (!(aa > 0.0 && bb > 0.0)) return {0.0, 0.0};
  return {std::norm(product) / (aa * bb), va / aa + vb / bb};
}

/// Whether two modes may be one: alike by the rule, or different by no more than their deviations. Modes that hardly move the
/// common channels have no certain shape there, and badly determined frequencies may differ more.
bool may_be_one(const Comparison& shapes, double df_Hz, double deviation_Hz, double reach_Hz, const MergingRule& rule) {
  if (df_Hz < reach_Hz && shapes.mac >= rule.mac) return true;
  return df_Hz <= 3.0 * deviation_Hz && 1.0 - shapes.mac <= rule.noise * shapes.noise;
}

/// How unlikely this difference is for one and the same mode: minus twice the logarithm of its density. Frequencies are normal
/// and 1 - MAC is exponential, with the given deviations. So the better known quantity decides between close modes, and a badly
/// known mode is near to none. The floors cover errors that are not in deviations from few blocks and one order.
double unlikelihood(const Comparison& shapes, double df_Hz, double deviation_Hz, double frequency_Hz) {
  constexpr double kFrequencyFloor = 0.001;  // of the frequency
  constexpr double kShapeFloor = 0.02;       // of 1 - MAC
  const double sigma = std::hypot(deviation_Hz / frequency_Hz, kFrequencyFloor), mean = shapes.noise + kShapeFloor;
  return std::pow(df_Hz / frequency_Hz / sigma, 2) + 2.0 * (std::log(sigma) + (1.0 - shapes.mac) / mean + std::log(mean));
}

/// Groups of modes of different setups, nearest pairs first.
std::vector<std::vector<Candidate>> groups(const std::vector<SetupModes>& setups, const MergingRule& rule) {
  std::vector<Candidate> all;
  for (std::size_t s = 0; s < setups.size(); ++s)
    for (std::size_t m = 0; m < setups[s].modes.size(); ++m) all.push_back({s, m});
  struct Pair {
    double distance;
    std::size_t a, b;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      if (all[a].setup == all[b].setup) continue;
      const Cluster &p = setups[all[a].setup].modes[all[a].mode], &q = setups[all[b].setup].modes[all[b].mode];
      const double df_Hz = std::abs(p.frequency_Hz - q.frequency_Hz);
      const double half_bandwidth = std::min(p.damping_ratio * p.frequency_Hz, q.damping_ratio * q.frequency_Hz);
      const double reach_Hz = std::max(rule.frequency * std::max(p.frequency_Hz, q.frequency_Hz), half_bandwidth);
      const SetupModes &first = setups[all[a].setup], &second = setups[all[b].setup];
      const Comparison shapes = compare(first, all[a].mode, second, all[b].mode);
      const double deviation_Hz =
          std::hypot(first.deviations[all[a].mode].frequency_Hz, second.deviations[all[b].mode].frequency_Hz);
      if (may_be_one(shapes, df_Hz, deviation_Hz, reach_Hz, rule))
        pairs.push_back({unlikelihood(shapes, df_Hz, deviation_Hz, p.frequency_Hz), a, b});
    }
  }
  std::ranges::stable_sort(pairs, [](const Pair& x, const Pair& y) { return x.distance < y.distance; });
  std::vector<std::size_t> group(all.size());
  std::iota(group.begin(), group.end(), 0U);
  std::vector<std::set<std::size_t>> present(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) present[i].insert(all[i].setup);
  for (const Pair& pair : pairs) {
    const std::size_t a = std::min(group[pair.a], group[pair.b]), b = std::max(group[pair.a], group[pair.b]);
    if (a == b || std::ranges::any_of(present[b], [&](std::size_t s) { return present[a].contains(s); })) continue;
    std::replace(group.begin(), group.end(), b, a);
    present[a].merge(present[b]);
  }
  std::map<std::size_t, std::vector<Candidate>> sets;
  for (std::size_t i = 0; i < all.size(); ++i) sets[group[i]].push_back(all[i]);
  return each_of(sets, [](const auto& set) { return set.second; });
}

struct Average {
  double value = 0.0, deviation = 0.0, scatter = 0.0;
};

/// Random-effects mean of values with their own variances.
Average average(const Eigen::ArrayXd& values, Eigen::ArrayXd variances) {
  // A variance from few blocks may be tiny by chance. None counts for less than a hundredth of the median.
  Eigen::ArrayXd sorted = variances;
  std::ranges::sort(sorted);
  variances = variances.max(0.01 * sorted[sorted.size() / 2]).max(1e-300);
  const Eigen::ArrayXd w = 1.0 / variances;
  const auto n = static_cast<double>(values.size());
  double tau2 = 0.0;
  const double mean = (w * values).sum() / w.sum();
  if (values.size() > 1) {
    const double excess = (w * (values - mean).square()).sum() - (n - 1.0);
    tau2 = std::max(0.0, excess / (w.sum() - w.square().sum() / w.sum()));
  }
  const Eigen::ArrayXd v = 1.0 / (variances + tau2);
  Average result{(v * values).sum() / v.sum(), std::sqrt(1.0 / v.sum()), 0.0};
  if (values.size() > 1) result.scatter = std::sqrt((values - values.mean()).square().sum() / (n - 1.0));
  return result;
}

Index position(const SetupModes& setup, Index channel) {
  const auto at = std::ranges::find(setup.channels, channel);
  return at == setup.channels.end() ? -1 : static_cast<Index>(at - setup.channels.begin());
}

/// Variance of an entry as a weight, rounded to a power of two: few blocks do not determine it better, and its last digits must
/// not change a shape.
double entry_variance(const ModeDeviation& deviation, Index i) {
  const double variance = deviation.shape_real[i] * deviation.shape_real[i] + deviation.shape_imag[i] * deviation.shape_imag[i];
  return variance > 0.0 ? std::exp2(std::round(std::log2(variance))) : 0.0;
}

/// Motion of the references in units of its deviation. Below about three, the sign of a setup's shape is unknown.
double reference_signal(const SetupModes& setup, std::size_t mode, const std::vector<Index>& references) {
  constexpr double kFloor = 0.02;  // of the shape's norm: error by close modes, beyond the deviation
  double square = 0.0;
  for (const Index reference : references) {
    const Index at = position(setup, reference);
    const double variance =
        entry_variance(setup.deviations[mode], at) + kFloor * kFloor * setup.modes[mode].shape.squaredNorm();
    square += std::norm(setup.modes[mode].shape[at]) / variance;
  }
  return std::sqrt(square);
}

/// Factors that scale each member's references to one common shape. A setup whose references hardly move gets zero. If fewer
/// than two setups remain, the setup with the strongest references alone gives the shape.
std::vector<std::complex<double>> scales(const std::vector<SetupModes>& setups, const std::vector<Candidate>& members,
                                         const std::vector<Index>& references) {
  if (members.size() < 2) return {1.0};
  constexpr double kLeastSignal = 3.0;
  const auto n_refs = static_cast<Index>(references.size()), n = static_cast<Index>(members.size());
  Eigen::MatrixXcd shapes(n_refs, n);
  Eigen::MatrixXd weights(n_refs, n);
  Eigen::VectorXd signal(n);
  for (Index k = 0; k < n; ++k) {
    const Candidate& member = members[static_cast<std::size_t>(k)];
    const SetupModes& setup = setups[member.setup];
    signal[k] = reference_signal(setup, member.mode, references);
    for (Index r = 0; r < n_refs; ++r) {
      const Index at = position(setup, references[static_cast<std::size_t>(r)]);
      shapes(r, k) = setup.modes[member.mode].shape[at];
      weights(r, k) = 1.0 / std::max(entry_variance(setup.deviations[member.mode], at), 1e-8);
    }
  }
  std::vector<std::complex<double>> factors(members.size(), 0.0);
  if ((signal.array() >= kLeastSignal).count() < 2) {
    Index strongest = 0;
    signal.maxCoeff(&strongest);
    factors[static_cast<std::size_t>(strongest)] = 1.0;
    return factors;
  }
  std::vector<Index> moving;
  for (Index k = 0; k < n; ++k)
    if (signal[k] >= kLeastSignal) moving.push_back(k);
  Eigen::MatrixXcd unit = shapes(Eigen::all, moving);
  for (Index k = 0; k < unit.cols(); ++k) unit.col(k) /= unit.col(k).norm();
  const Eigen::VectorXcd common = Eigen::JacobiSVD<Eigen::MatrixXcd>(unit, Eigen::ComputeThinU).matrixU().col(0);
  for (const Index k : moving) {
    const Eigen::VectorXcd weighted = weights.col(k).asDiagonal() * shapes.col(k);
    factors[static_cast<std::size_t>(k)] = weighted.dot(common) / shapes.col(k).dot(weighted).real();
  }
  return factors;
}

/// Weight of an entry of a setup's shape times `size`.
double entry_weight(const ModeDeviation& deviation, Index at, double size) {
  return 1.0 / std::max(size * size * entry_variance(deviation, at), 1e-12);
}

void merge_shapes(const std::vector<SetupModes>& setups, const std::vector<Candidate>& members,
                  const std::vector<std::complex<double>>& factors, Index n_channels, MergedMode& merged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(n_channels);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(n_channels), real = weight, imag = weight;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (factors[k] == 0.0) continue;
    const SetupModes& setup = setups[members[k].setup];
    for (std::size_t i = 0; i < setup.channels.size(); ++i) {
      const auto at = static_cast<Index>(i), channel = setup.channels[i];
      const double w = entry_weight(setup.deviations[members[k].mode], at, std::abs(factors[k]));
      shape[channel] += w * factors[k] * setup.modes[members[k].mode].shape[at];
      weight[channel] += w;
    }
  }
  for (Index i = 0; i < n_channels; ++i)
    if (weight[i] > 0.0) shape[i] /= weight[i];
  const double norm = std::max(shape.norm(), 1e-300);
  merged.shape = normalised_shape(shape);
  // The deviations are rotated like the shape: by the setup's factor and by the phase of the normalised shape.
  const double turn = std::arg(shape.dot(merged.shape));
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (factors[k] == 0.0) continue;
    const SetupModes& setup = setups[members[k].setup];
    const ModeDeviation& deviation = setup.deviations[members[k].mode];
    const double size = std::abs(factors[k]), angle = std::arg(factors[k]) + turn, c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < setup.channels.size(); ++i) {
      const auto at = static_cast<Index>(i), channel = setup.channels[i];
      const double w = entry_weight(deviation, at, size);
      const double vr = std::pow(size * deviation.shape_real[at], 2), vi = std::pow(size * deviation.shape_imag[at], 2);
      real[channel] += w * w * (c * c * vr + s * s * vi);
      imag[channel] += w * w * (s * s * vr + c * c * vi);
    }
  }
  merged.deviation.shape_real = (real.cwiseSqrt().array() / weight.array().max(1e-300) / norm).matrix();
  merged.deviation.shape_imag = (imag.cwiseSqrt().array() / weight.array().max(1e-300) / norm).matrix();
  for (Index i = 0; i < n_channels; ++i)
    if (weight[i] == 0.0) merged.shape[i] = std::complex<double>(nan, nan);
}

}  // namespace

std::vector<MergedMode> merge_poser(const std::vector<SetupModes>& setups, Index n_channels,
                                    const std::vector<Index>& references, const MergingRule& rule) {
  for (const SetupModes& setup : setups) {
    TWINDECK_ASSERT(setup.modes.size() == setup.deviations.size());
    if (setups.size() > 1 && references.empty())
      throw InputError({"", 0, "references"}, "names no channel that all setups share, expected at least one",
                       "mark the sensors that stayed in place by reference = 1 in channels.csv");
    for (const Index channel : references)
      if (setups.size() > 1 && position(setup, channel) < 0)
        throw InputError({"", 0, "references"}, fmt::format("setup {} lacks a reference channel of the others", setup.setup),
                         "leave the setup out, or choose references that every setup has");
  }
  std::vector<MergedMode> result;
  for (const std::vector<Candidate>& members : groups(setups, rule)) {
    const auto n = static_cast<Index>(members.size());
    Eigen::ArrayXd frequency(n), frequency_variance(n), damping(n), damping_variance(n);
    MergedMode merged;
    for (Index k = 0; k < n; ++k) {
      const Candidate& member = members[static_cast<std::size_t>(k)];
      const Cluster& mode = setups[member.setup].modes[member.mode];
      const ModeDeviation& deviation = setups[member.setup].deviations[member.mode];
      frequency[k] = mode.frequency_Hz;
      damping[k] = mode.damping_ratio;
      frequency_variance[k] = deviation.frequency_Hz * deviation.frequency_Hz;
      damping_variance[k] = deviation.damping_ratio * deviation.damping_ratio;
      merged.members.emplace_back(member.setup, member.mode);
    }
    const Average f = average(frequency, frequency_variance), z = average(damping, damping_variance);
    merged.frequency_Hz = f.value;
    merged.frequency_scatter_Hz = f.scatter;
    merged.deviation.frequency_Hz = f.deviation;
    merged.damping_ratio = z.value;
    merged.damping_ratio_scatter = z.scatter;
    merged.deviation.damping_ratio = z.deviation;
    merge_shapes(setups, members, scales(setups, members, references), n_channels, merged);
    result.push_back(std::move(merged));
  }
  std::ranges::sort(result, {}, &MergedMode::frequency_Hz);
  return result;
}

}  // namespace twindeck::identification
