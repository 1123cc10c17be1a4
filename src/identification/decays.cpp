#include "identification/decays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/mode_choices.hpp"
#include "identification/releases.hpp"
#include "identification/sampling.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// MAC over the channels that both have.
double common_mac(const Eigen::VectorXcd& a, const std::vector<records::CampaignChannel>& a_channels, const Eigen::VectorXcd& b,
                  const std::vector<records::CampaignChannel>& b_channels) {
  Eigen::VectorXcd same = Eigen::VectorXcd::Constant(a.size(), std::numeric_limits<double>::quiet_NaN());  // b at a's
  for (std::size_t i = 0; i < a_channels.size(); ++i)
    for (std::size_t j = 0; j < b_channels.size(); ++j)
      if (a_channels[i].name == b_channels[j].name) same[static_cast<Index>(i)] = b[static_cast<Index>(j)];
  return known_mac(a, same);
}

void read_by_amplitude(DecayResult& result, const Eigen::MatrixXd& decay, double rate_Hz, const std::string& record,
                       const IdentificationSettings& config, const ConditionResult* ambient) {
  for (std::size_t m = 0; m < result.found.modes.size(); ++m) {
    const Cluster& mode = result.found.modes[m];
    // Modes closer than the filter can separate would beat in its band.
    const bool alone = std::ranges::all_of(result.found.modes, [&](const Cluster& other) {
      return &other == &mode || std::abs(other.frequency_Hz - mode.frequency_Hz) > 1.5 * config.decay_band_Hz;
    });
    if (!alone || mode.frequency_Hz < 2.0 * config.decay_band_Hz) continue;
    const DecayingCoordinate q =
        decaying_coordinate(decay, rate_Hz, mode.shape, mode.frequency_Hz, mode.damping_ratio, config.decay_band_Hz);
    const auto points =
        decay_by_amplitude(q.value, rate_Hz, 0.5 / config.decay_band_Hz, static_cast<int>(config.decay_bands), q.noise);
    if (points.empty()) continue;
    const auto partner = partner_of(mode, result.conditioned.channels, ambient);
    result.by_amplitude.push_back({partner ? std::to_string(partner->mode + 1) : "", record, m, points});
  }
}

/// Number of samples until the motion has fallen to three times its final RMS; all samples if it does not come to rest.
Index decaying_samples(const Eigen::MatrixXd& decay) {
  constexpr double kAboveTheRest = 9.0;  // mean square over that at the end
  constexpr Index kWindows = 50;
  const Eigen::VectorXd energy = energy_of(decay);
  const Index window = energy.size() / kWindows;
  if (window < 2) return energy.size();
  const double rest = energy.tail(energy.size() / 10).mean();
  Index end = 0;
  for (Index w = 0; w < kWindows; ++w)
    if (energy.segment(w * window, window).mean() > kAboveTheRest * rest) end = (w + 1) * window;
  return end == 0 || 10 * end > 9 * energy.size() ? energy.size() : end;
}

/// Number of samples to read of each decay. All decays begin at the release. Lowers the limits that this length is too short
/// for.
Index length_of(const std::vector<Eigen::MatrixXd>& decays, double rate_Hz, IdentificationSettings& own, std::string& note) {
  constexpr Index kMostEntries = 600'000;  // of the Hankel matrix; its random draws take most of the time
  const Index channels = decays.front().cols();
  Index length = decays.front().rows(), decaying = 0;
  for (const Eigen::MatrixXd& decay : decays) {
    length = std::min(length, decay.rows());
    decaying = std::max(decaying, decaying_samples(decay));
  }
  if (own.decay_length_s > 0.0) {
    length = std::min(length, static_cast<Index>(std::lround(own.decay_length_s * rate_Hz)));
  } else {
    const Index rows = own.block_rows * channels;
    length = std::min({length, std::max<Index>(decaying, 4 * own.block_rows), own.block_rows + kMostEntries / rows});
  }
  const long rows = std::max<long>(2, std::min<long>(own.block_rows, length / 3));
  const long order = std::max<long>(2, std::min<long>((rows - 1) * channels, length - rows + 1));
  if (rows < own.block_rows) note += fmt::format(", block_rows {} -> {}", own.block_rows, rows);
  if (order < own.maximum_order) note += fmt::format(", maximum_order {} -> {}", own.maximum_order, order);
  own.block_rows = rows;
  own.maximum_order = std::min(own.maximum_order, order);
  return length;
}

/// Upper end [Hz] of a band that the configuration leaves open. Above the motion's reach, filtered noise would give poles.
double band_end(const Conditioned& decay) {
  constexpr double kBeyond = 1.1;  // of the reach, to include the flank of a mode there
  const double widest = kFilteredBand * 0.5 * decay.rate_Hz;
  return decay.reach_Hz > 0.0 ? std::min(kBeyond * decay.reach_Hz, widest) : widest;
}

}  // namespace

std::optional<AmbientPartner> partner_of(const Cluster& mode, const std::vector<records::CampaignChannel>& channels,
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
  const auto at = std::ranges::find(results, name, &ConditionResult::condition);
  return at == results.end() ? nullptr : &*at;
}

std::string quantity_at_largest(const std::vector<records::CampaignChannel>& channels, const Eigen::VectorXcd& shape) {
  Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return channels[static_cast<std::size_t>(largest)].quantity;
}

std::vector<ConditionResult> decay_conditions(std::vector<DecayResult>& decays) {
  std::vector<ConditionResult> results;
  for (const DecayResult& decay : decays) {
    const std::string& name = decay.conditioned.condition;
    if (condition_named(results, name) == nullptr) {
      results.emplace_back().condition = name;
      results.back().of_decays = true;
    }
    ConditionResult& result = *std::ranges::find(results, name, &ConditionResult::condition);
    SetupResult& setup = result.setups.emplace_back();
    static_cast<ConditionedInfo&>(setup.conditioned) = decay.conditioned;
    setup.conditioned.quality.clear();  // the quality stays with the decay
    setup.found = decay.found;
  }
  for (ConditionResult& result : results) merge_setups(result);
  for (DecayResult& decay : decays) {
    const ConditionResult* result = condition_named(results, decay.conditioned.condition);
    for (DecayResult::ByAmplitude& by : decay.by_amplitude) {
      const auto partner = partner_of(decay.found.modes[by.found], decay.conditioned.channels, result);
      if (partner) by.mode = std::to_string(partner->mode + 1);
    }
  }
  return results;
}

std::vector<DecayResult> identify_free_decays(const std::vector<Conditioned>& records, const IdentificationSettings& config,
                                              const std::vector<ConditionResult>& results, std::uint64_t seed) {
  std::vector<DecayResult> decays;
  for (const Conditioned& conditioned : records) {
    DecayResult result;
    result.conditioned = conditioned;
    const Eigen::VectorXd scale = channel_rms(conditioned.records);
    IdentificationSettings own = config;
    own.block_rows = conditioned.block_rows > 0 ? conditioned.block_rows : config.decay_block_rows;
    own.maximum_order = config.decay_maximum_order;
    if (own.highest_Hz == 0.0) own.highest_Hz = band_end(conditioned);
    const auto skipped = static_cast<Index>(std::lround(config.decay_start_s * conditioned.rate_Hz));
    std::vector<Eigen::MatrixXd> whole, pieces, quiet;
    std::vector<std::string> files;  // of `whole`
    for (std::size_t i = 0; i < conditioned.records.size(); ++i)
      for (const auto& [release, samples] : decays_of(conditioned.records[i], conditioned.rate_Hz)) {
        const Index after = std::min(skipped, samples - 1);
        whole.emplace_back(conditioned.records[i].middleRows(release + after, samples - after));
        files.push_back(conditioned.files[i]);
      }
    const Index length = length_of(whole, conditioned.rate_Hz, own, result.note);
    if (!result.note.empty())
      result.note = fmt::format("setup {}: a free decay of {} samples is too short for all limits: {}", conditioned.setup,
                                length, result.note.substr(2));
    for (const Eigen::MatrixXd& decay : whole) pieces.emplace_back(decay.topRows(length) * scale.cwiseInverse().asDiagonal());
    // In a record of sufficient length, the last half shows the disturbance after the decay.
    for (const Eigen::MatrixXd& decay : whole) {
      if (decay.rows() >= 2 * length) {
        const Eigen::MatrixXd rest = decay.bottomRows(decay.rows() / 2) * scale.cwiseInverse().asDiagonal();
        quiet.emplace_back(rest.rowwise() - rest.colwise().mean());
      }
    }
    const IdentifyOptions options = own.options(conditioned.rate_Hz, conditioned.channels);
    result.found = identify_decays(pieces, conditioned.rate_Hz, options, seed, quiet);
    const auto tests =
        std::ranges::count_if(records, [&](const Conditioned& other) { return other.condition == conditioned.condition; });
    if (tests == 1 && options.selection == Selection::automatic)
      if (const auto dropped = drop_noise_of_a_decay(result.found, length); !dropped.empty())
        result.note +=
            fmt::format("{}setup {}: left out because the noise of one decay may have them: {}; a second decay tells",
                        result.note.empty() ? "" : "; ", conditioned.setup, fmt::join(dropped, ", "));
    to_physical_shapes(result.found, conditioned.channels, scale);
    take_choices(result.found, config.choices, conditioned, scale);
    const ConditionResult* ambient = condition_named(results, conditioned.condition);
    for (std::size_t i = 0; i < whole.size(); ++i)
      read_by_amplitude(result, whole[i], conditioned.rate_Hz, files[i], config, ambient);
    decays.push_back(std::move(result));
  }
  return decays;
}

std::vector<AmbientAmplitude> ambient_amplitudes(const std::vector<ConditionResult>& results,
                                                 const IdentificationSettings& config) {
  std::vector<AmbientAmplitude> amplitudes;
  for (const ConditionResult& result : results) {
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
      const MergedMode& mode = result.modes[m];
      const SetupResult& setup = result.setups[mode.members.front().first];
      if (setup.conditioned.has_responses()) continue;  // the force of a hammer test is not kept
      const Cluster& own = setup.found.modes[mode.members.front().second];
      double squares = 0.0, seconds = 0.0;
      for (const Samples& record : setup.conditioned.records) {
        // The filter is wide enough for the mode's half-power band, and no wider than that of the decays.
        const double half_width = std::max(0.25 * config.decay_band_Hz, 2.0 * mode.damping_ratio * mode.frequency_Hz);
        const Eigen::VectorXcd q =
            modal_coordinate(record, setup.conditioned.rate_Hz, own.shape, mode.frequency_Hz, half_width);
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
