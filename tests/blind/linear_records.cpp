#include <cmath>
#include <complex>
#include <numbers>

#include "blind/records.hpp"
#include "core/random.hpp"

namespace twindeck::blind {

namespace {

using diagnosis::Row;
using diagnosis::RowType;
using Complex = std::complex<double>;
using Eigen::Index;

constexpr int kModesHeard = 11;  // beyond those that are asked for, so that an identification has to choose
constexpr double kLength_s = 600.0, kRate = 10.0, kChannelNoise = 0.05;

/// Rows that ask the truth for its modes in each condition: frequency, damping, complex shape at every channel.
diagnosis::FeatureSet questions(const Bench& bench) {
  diagnosis::FeatureSet f;
  f.channels = bench.rows.channels;
  f.direction = bench.rows.direction;
  f.conditions = bench.rows.conditions;
  const diagnosis::ReducedModel& model = *bench.truth.reduced;
  for (std::size_t c = 0; c < f.conditions.size(); ++c) {
    for (int m = 0; m < kModesHeard; ++m) {
      const std::string name = std::to_string(m + 1);
      const Eigen::VectorXd shape = model.sensors * model.mode_coordinates.col(m);
      const auto condition = static_cast<int>(c);
      f.rows.push_back(
          {RowType::frequency, name, -1, "", condition, model.frequency_Hz[m], 0.004 * model.frequency_Hz[m], false});
      f.rows.push_back({RowType::damping, name, -1, "", condition, 0.5, 0.1, false});
      double largest = 0.0;
      for (Index ch = 0; ch < static_cast<Index>(f.channels.size()); ++ch) largest = std::max(largest, std::abs(shape[4 * ch]));
      for (Index ch = 0; ch < static_cast<Index>(f.channels.size()); ++ch) {
        f.rows.push_back({RowType::shape, name, static_cast<int>(ch), "", condition, shape[4 * ch] / largest, 0.03, false});
        f.rows.push_back({RowType::shape_imag, name, static_cast<int>(ch), "", condition, 0.0, 0.03, false});
      }
    }
  }
  return f;
}

}  // namespace

const std::set<std::string>& families_of_linear_records() {
  static const std::set<std::string> families = {
      "axis",   "brg",        "brgfric", "cable", "crowd",     "dampabsent", "dampc", "damping",  "dampk",
      "freeze", "foundation", "fric",    "gain",  "geo",       "humansys",   "joint", "mass",     "osc",
      "pol",    "skewclk",    "slack",   "stay",  "stiffness", "swap",       "tempE", "tempStay", "tie"};
  return families;
}

Campaign linear_records(const Bench& bench, const Hidden& hidden) {
  Campaign campaign;
  campaign.conditions = bench.rows.conditions;
  campaign.rate_Hz = kRate;
  const diagnosis::FeatureSet asked = questions(bench);
  const diagnosis::FeatureMap map(*bench.truth.reduced, asked, bench.scatter);
  const std::uint64_t seed = hidden.seal.seed;
  diagnosis::Prediction p;
  for (std::uint64_t attempt = 0; attempt < 20 && !p.valid; ++attempt) {
    Eigen::VectorXd x(static_cast<Index>(map.nuisances().size()));
    for (Index j = 0; j < x.size(); ++j) {
      const diagnosis::Nuisance& v = map.nuisances()[static_cast<std::size_t>(j)];
      std::uint64_t again = 0;
      do
        x[j] = (v.kind == diagnosis::Nuisance::Kind::mode_damping ? 0.3 : 1.0) *
               normal_number(seed, 1000 + attempt, static_cast<std::uint64_t>(j) * 64 + again++);
      while (x[j] < v.lower || x[j] > v.upper);
    }
    p = map.predict(map.base(x), hidden.causes, false);
  }
  if (!p.valid) return campaign;
  const auto n_channels = static_cast<Index>(asked.channels.size());
  const auto samples = static_cast<Index>(kLength_s * kRate);
  const Index rows_per_mode = 2 + 2 * n_channels;
  for (std::size_t c = 0; c < campaign.conditions.size(); ++c) {
    Eigen::MatrixXd record = Eigen::MatrixXd::Zero(samples, n_channels);
    for (Index m = 0; m < kModesHeard; ++m) {
      const Index row = (static_cast<Index>(c) * kModesHeard + m) * rows_per_mode;
      const double omega = 2.0 * std::numbers::pi * std::exp(p.g[row]), zeta = 0.01 * std::exp(p.g[row + 1]);
      if (zeta >= 0.5) continue;  // hardly vibrates
      const Complex s = omega * Complex(-zeta, std::sqrt(1.0 - zeta * zeta));
      Eigen::VectorXcd shape(n_channels);
      for (Index ch = 0; ch < n_channels; ++ch) shape[ch] = Complex(p.g[row + 2 + 2 * ch], p.g[row + 3 + 2 * ch]);
      // White forces of one size: a mode answers with the root of omega/zeta, by and by.
      const Complex step = std::exp(s / kRate);
      const std::uint64_t stream = 2000 + 100 * c + static_cast<std::uint64_t>(m);
      const double size =
          std::sqrt(1.0 - std::norm(step)) * std::sqrt(omega / zeta) * std::exp(0.4 * normal_number(seed, stream, 0));
      Complex z = 0.0;
      for (Index t = -500; t < samples; ++t) {
        const auto k = static_cast<std::uint64_t>(t + 501);
        z = step * z + size * Complex(normal_number(seed, stream, 2 * k), normal_number(seed, stream, 2 * k + 1));
        if (t >= 0) record.row(t) += (shape * z).real().transpose();
      }
    }
    for (Index ch = 0; ch < n_channels; ++ch) {
      const double noise = kChannelNoise * std::sqrt(record.squaredNorm() / static_cast<double>(record.size()));
      for (Index t = 0; t < samples; ++t)
        record(t, ch) +=
            noise * normal_number(seed, 5000 + 100 * c + static_cast<std::uint64_t>(ch), static_cast<std::uint64_t>(t));
    }
    campaign.records.push_back(record);
  }
  return campaign;
}

}  // namespace twindeck::blind
