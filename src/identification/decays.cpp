#include "identification/decays.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// MAC over the channels that both have.
double common_mac(const Eigen::VectorXcd& a, const std::vector<records::CampaignChannel>& a_channels, const Eigen::VectorXcd& b,
                  const std::vector<records::CampaignChannel>& b_channels) {
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a_channels.size(); ++i) {
    for (std::size_t j = 0; j < b_channels.size(); ++j) {
      const std::complex<double> x = a[static_cast<Index>(i)], y = b[static_cast<Index>(j)];
      if (a_channels[i].name != b_channels[j].name || std::isnan(x.real()) || std::isnan(y.real())) continue;
      product += std::conj(x) * y;
      aa += std::norm(x);
      bb += std::norm(y);
    }
  }
  return aa > 0.0 && bb > 0.0 ? std::norm(product) / (aa * bb) : 0.0;
}

void read_by_amplitude(DecayResult& result, const Eigen::MatrixXd& decay, double rate_Hz, const std::string& record,
                       const IdentificationSettings& config, const ConditionResult* ambient) {
  for (const sysid::Cluster& mode : result.found.modes) {
    // Neighbours closer than the filter can tell apart beat in its band.
    const bool alone = std::all_of(result.found.modes.begin(), result.found.modes.end(), [&](const sysid::Cluster& other) {
      return &other == &mode || std::abs(other.frequency_Hz - mode.frequency_Hz) > 1.5 * config.decay_band_Hz;
    });
    if (!alone || mode.frequency_Hz < 2.0 * config.decay_band_Hz) continue;
    const sysid::DecayingCoordinate q =
        sysid::decaying_coordinate(decay, rate_Hz, mode.shape, mode.frequency_Hz, mode.damping_ratio, config.decay_band_Hz);
    const auto points =
        sysid::decay_by_amplitude(q.value, rate_Hz, 0.5 / config.decay_band_Hz, static_cast<int>(config.decay_bands), q.noise);
    if (points.empty()) continue;
    const auto partner = partner_of(mode, result.channels, ambient);
    result.by_amplitude.push_back({partner ? std::to_string(partner->mode + 1) : "", record, mode.frequency_Hz, points});
  }
}

/// First sample after the release: where the motion's running RMS over half a second is largest. @param data (n_samples ×
/// n_channels)
Index release_sample(const Samples& data, double rate_Hz) {
  const Index half = std::max<Index>(2, static_cast<Index>(std::lround(0.5 * rate_Hz)));
  if (data.rows() <= 2 * half) return 0;
  const Eigen::VectorXd scale = data.colwise().squaredNorm().transpose().cwiseMax(1e-300);
  const Eigen::VectorXd energy = (data.array().square().rowwise() / scale.transpose().array()).rowwise().sum();
  double sum = energy.head(half).sum(), most = sum;
  Index best = 0;
  for (Index t = 1; t + half <= energy.size(); ++t) {
    sum += energy[t + half - 1] - energy[t - 1];
    if (sum > most) {
      most = sum;
      best = t;
    }
  }
  return best;
}

}  // namespace

std::optional<AmbientPartner> partner_of(const sysid::Cluster& mode, const std::vector<records::CampaignChannel>& channels,
                                         const ConditionResult* ambient) {
  std::optional<AmbientPartner> best;
  if (ambient == nullptr) return best;
  for (std::size_t m = 0; m < ambient->modes.size(); ++m) {
    if (std::abs(ambient->modes[m].frequency_Hz / mode.frequency_Hz - 1.0) > 0.10) continue;
    const double mac = common_mac(mode.shape, channels, ambient->modes[m].shape, ambient->channels);
    if (mac > 0.8 && (!best || mac > best->mac)) best = AmbientPartner{m, mac};
  }
  return best;
}

const ConditionResult* condition_named(const std::vector<ConditionResult>& results, const std::string& name) {
  const auto at = std::find_if(results.begin(), results.end(), [&](const ConditionResult& r) { return r.condition == name; });
  return at == results.end() ? nullptr : &*at;
}

std::string quantity_at_largest(const std::vector<records::CampaignChannel>& channels, const Eigen::VectorXcd& shape) {
  Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return channels[static_cast<std::size_t>(largest)].quantity;
}

std::vector<DecayResult> identify_free_decays(const std::vector<Conditioned>& records, const IdentificationSettings& config,
                                              const std::vector<ConditionResult>& results, std::uint64_t seed) {
  std::vector<DecayResult> decays;
  for (const Conditioned& conditioned : records) {
    DecayResult result;
    result.setup = conditioned.setup;
    result.condition = conditioned.condition;
    result.channels = conditioned.channels;
    result.quality = conditioned.quality;
    const Eigen::VectorXd scale = channel_rms(conditioned.records);
    const auto wanted = static_cast<Index>(std::lround(config.decay_length_s * conditioned.rate_Hz));
    const auto skipped = static_cast<Index>(std::lround(config.decay_start_s * conditioned.rate_Hz));
    std::vector<Eigen::MatrixXd> whole, pieces, quiet;
    Index length = wanted;
    for (const Samples& record : conditioned.records) {
      const Index from = std::min(release_sample(record, conditioned.rate_Hz) + skipped, record.rows() - 1);
      whole.emplace_back(record.bottomRows(record.rows() - from));
      length = std::min(length, whole.back().rows());
    }
    for (const Eigen::MatrixXd& decay : whole) pieces.emplace_back(decay.topRows(length) * scale.cwiseInverse().asDiagonal());
    // The last half of a record that is long enough shows what moves the bridge when the decay is over.
    for (const Eigen::MatrixXd& decay : whole) {
      if (decay.rows() >= 2 * length) {
        const Eigen::MatrixXd rest = decay.bottomRows(decay.rows() / 2) * scale.cwiseInverse().asDiagonal();
        quiet.emplace_back(rest.rowwise() - rest.colwise().mean());
      }
    }
    IdentificationSettings own = config;
    own.block_rows = config.decay_block_rows;
    own.maximum_order = config.decay_maximum_order;
    const sysid::IdentifyOptions options = own.options(conditioned.rate_Hz, conditioned.channels);
    result.found = sysid::identify_decays(pieces, conditioned.rate_Hz, options, seed, quiet);
    to_physical_shapes(result.found, conditioned.channels, scale);
    const ConditionResult* ambient = condition_named(results, conditioned.condition);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      read_by_amplitude(result, whole[i], conditioned.rate_Hz, conditioned.files[i], config, ambient);
    }
    decays.push_back(std::move(result));
  }
  return decays;
}

std::vector<AmbientAmplitude> ambient_amplitudes(const std::vector<ConditionResult>& results,
                                                 const IdentificationSettings& config) {
  std::vector<AmbientAmplitude> amplitudes;
  for (const ConditionResult& result : results) {
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
      const sysid::MergedMode& mode = result.modes[m];
      const SetupResult& setup = result.setups[mode.members.front().first];
      const sysid::Cluster& own = setup.found.modes[mode.members.front().second];
      double squares = 0.0, seconds = 0.0;
      for (const Samples& record : setup.conditioned.records) {
        // Wide enough for the mode's half-power band, no wider than the filter of the decays.
        const double half_width = std::max(0.25 * config.decay_band_Hz, 2.0 * mode.damping_ratio * mode.frequency_Hz);
        const Eigen::VectorXcd q =
            sysid::modal_coordinate(record, setup.conditioned.rate_Hz, own.shape, mode.frequency_Hz, half_width);
        squares += q.squaredNorm() / setup.conditioned.rate_Hz;
        seconds += static_cast<double>(record.rows()) / setup.conditioned.rate_Hz;
      }
      amplitudes.push_back({result.condition, setup.conditioned.setup, m, std::sqrt(squares / seconds),
                            quantity_at_largest(setup.conditioned.channels, own.shape), seconds});
    }
  }
  return amplitudes;
}

}  // namespace twindeck::identification
