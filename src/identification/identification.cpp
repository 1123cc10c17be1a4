#include "identification/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "identification/input_output.hpp"
#include "identification/lying_channels.hpp"
#include "identification/repeated_rows.hpp"
#include "identification/sampling.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// Columns of a record that are inputs, or responses, and not excluded.
std::vector<Index> columns_of(const records::Campaign& campaign, const records::CampaignRecord& record,
                              const IdentificationSettings& config, bool inputs) {
  std::vector<Index> columns;
  for (std::size_t c = 0; c < record.channels.size(); ++c)
    if (campaign.channel(record.channels[c]).is_input == inputs && !contains(config.exclude, record.channels[c]))
      columns.push_back(static_cast<Index>(c));
  return columns;
}

std::vector<Index> used_columns(const records::Campaign& campaign, const records::CampaignRecord& record,
                                const IdentificationSettings& config) {
  require_known(config.exclude, record.channels, "exclude");
  std::vector<Index> columns = columns_of(campaign, record, config, false);
  if (columns.empty() && config.exclude.empty())
    throw InputError({(campaign.folder / "channels.csv").string(), 0, "role"}, "no channel of the record is a response",
                     "give one at least the role response");
  if (columns.empty()) throw InputError({"", 0, "exclude"}, "leaves no response channel", "leave out fewer");
  constexpr std::size_t most = 500;  // channels; cross spectra of 500 channels take 4 GB, those of 5,000 would take 400 GB
  if (columns.size() > most)
    throw InputError(
        {(campaign.folder / "campaign.toml").string(), record.line_of("channels"), "channels"},
        fmt::format("{} response channels are to be identified together, expected at most {}", columns.size(), most),
        "divide them over several [[record]] tables of the same file with a setup each, which share some references, "
        "or leave channels out by the key `exclude`");
  return columns;
}

void refuse_clipped(const ChannelQuality& q, double largest, const std::string& without) {
  const double share = static_cast<double>(q.clipped) / static_cast<double>(q.samples);
  if (share <= largest) return;
  throw UnusableRecord({q.record, 0, q.channel},
                       fmt::format("stands at its largest or smallest value over {} of {} samples ({:.3g} %), expected at most "
                                   "{:.3g} %: it was driven past its range",
                                   q.clipped, q.samples, 100.0 * share, 100.0 * largest),
                       without + fmt::format(", or allow it (--set largest_clipping={:.2g})", 1.1 * share));
}

void refuse_lone(const ChannelQuality& q, double largest, const std::string& without) {
  if (!q.lone || q.lone->deviations <= largest) return;
  const bool several = q.lone->samples > 1;
  throw UnusableRecord(
      {q.record, 0, q.channel},
      fmt::format("has {:.6g} at sample {}{}, {:.3g} robust deviations from its median and alone between quiet neighbours, "
                  "expected at most {:.3g}: that is no motion",
                  q.lone->value, q.lone->sample, several ? fmt::format(" and {} after it", q.lone->samples - 1) : "",
                  q.lone->deviations, largest),
      fmt::format("empty the cell{} and bridge the gap (--set longest_gap={}), {}, or allow it (--set largest_lone={:.2g})",
                  several ? "s" : "", q.lone->samples, without, 1.1 * q.lone->deviations));
}

/// Refuses used channels that do not move, are clipped, or have errors of the recorder. A force may be a single blow.
void refuse_unusable(const std::vector<ChannelQuality>& quality, const std::vector<records::CampaignChannel>& used,
                     const IdentificationSettings& config) {
  for (const ChannelQuality& q : quality) {
    const auto channel = std::ranges::find(used, q.channel, &records::CampaignChannel::name);
    if (channel == used.end()) continue;
    const std::string without = "leave the channel out: --set 'exclude=[\"" + q.channel + "\"]'";
    if (!q.left_out.empty()) throw LyingChannel({q.record, 0, q.channel}, q.left_out, without);
    if (q.dead)
      throw UnusableRecord({q.record, 0, q.channel}, fmt::format("is constant ({}) over {} samples", q.mean, q.samples),
                           without);
    if (channel->quantity != "force") refuse_lone(q, config.largest_lone, without);
    refuse_clipped(q, config.largest_clipping, without);
  }
}

/// Warns of the channel that holds its values longest, if its own rate is below that of the record.
void warn_of_held(Conditioned& conditioned, double recorded_Hz) {
  const auto slowest = std::ranges::max_element(conditioned.quality, {}, &ChannelQuality::held);
  if (slowest == conditioned.quality.end() || !(conditioned.rate_Hz * static_cast<double>(slowest->held) > 1.001 * recorded_Hz))
    return;
  const double own_Hz = recorded_Hz / static_cast<double>(slowest->held);
  conditioned.warnings.push_back(
      fmt::format("setup {}: channel {} holds each value for {} samples, as one of {:.6g} Hz in a faster table does: above "
                  "{:.6g} Hz it shows "
                  "mirror images of the modes below; set decimation={}, or write each value once",
                  conditioned.setup, slowest->channel, slowest->held, own_Hz, own_Hz / 2.0, slowest->held));
}

JudgedChannels judged_channels(const std::vector<Index>& columns, const Conditioned& conditioned,
                               const records::CampaignRecord& record) {
  JudgedChannels judged{columns, {}, {}, record.kind == "free_decay" || record.kind == "earthquake"};
  for (const records::CampaignChannel& channel : conditioned.channels) {
    judged.gain.push_back(channel.gain);
    judged.reference.push_back(channel.reference);
  }
  return judged;
}

/// Refuses samples that the setup has twice: they would count as two measurements.
void refuse_repeats(const Samples& raw, const records::CampaignRecord& record, RowsSeen& seen) {
  const auto twice = seen.add(raw, record.file.string());
  if (!twice) return;
  const bool own = twice->file == record.file.string();
  if (!own && twice->length == raw.rows())
    throw InputError(
        {record.file.string(), 0, ""}, "holds the same samples as " + twice->file + ", which the setup has too",
        fmt::format("remove the [[record]] on line {} of campaign.toml: counted twice, deviations are too small", record.line));
  throw InputError({record.file.string(), 0, ""},
                   fmt::format("holds samples twice: the {} from sample {} on are those {}from sample {} on, in all channels",
                               twice->length, twice->again, own ? "" : "of " + twice->file + " ", twice->first),
                   fmt::format("remove samples {} to {} of the file: counted twice, deviations are too small", twice->again,
                               twice->again + twice->length - 1));
}

/// Does the work of condition_records with all channels that are not excluded.
Conditioned condition_with(const records::Campaign& campaign, const records::RecordGroup& group,
                           const IdentificationSettings& config) {
  const auto decimation = static_cast<Index>(std::max(config.decimation, 1L));
  const records::CampaignRecord& first = group.records.front();
  const std::vector<Index> columns = used_columns(campaign, first, config),
                           input_columns = columns_of(campaign, first, config, true);
  Conditioned conditioned;
  conditioned.setup = first.setup;
  conditioned.condition = first.condition;
  conditioned.rate_Hz = first.sampling_rate_Hz / static_cast<double>(decimation);
  const auto name_of = [&](Index column) { return first.channels[static_cast<std::size_t>(column)]; };
  const std::vector<std::string> names = each_of(columns, name_of), input_names = each_of(input_columns, name_of);
  const auto channel_of = [&](const std::string& name) { return campaign.channel(name); };
  conditioned.channels = each_of(names, channel_of);
  conditioned.inputs = each_of(input_names, channel_of);
  choose_references(conditioned, config.references);
  static_cast<void>(config.options(conditioned.rate_Hz, conditioned.channels));  // refuses a band above that of the records
  // Channels are prepared one by one, so that memory holds the record and only one channel more.
  const auto ready = [&](const Samples& raw, const std::vector<Index>& chosen, const std::vector<std::string>& called,
                         const std::string& file) {
    Samples out;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      Eigen::MatrixXd channel = raw.col(chosen[k]);
      fill_gaps(channel, {called[k]}, config.longest_gap, file);
      channel = signal::detrended(signal::decimated(signal::detrended(channel), decimation));
      if (k == 0) out = Samples(channel.rows(), static_cast<Index>(chosen.size()));
      out.col(static_cast<Index>(k)) = channel;
    }
    return out;
  };
  RowsSeen seen;
  for (const records::CampaignRecord& record : group.records) {
    const auto [raw, notes] = records::read_record(campaign, record);
    const std::string file = record.file.lexically_relative(campaign.folder).generic_string();
    refuse_repeats(raw, record, seen);
    auto quality = channel_quality(raw, record.channels, record.setup, file);
    judge_channels(raw, judged_channels(columns, conditioned, record), quality);
    try {
      refuse_unusable(quality, conditioned.channels, config);
      refuse_unusable(quality, conditioned.inputs, config);
      Samples responses = ready(raw, columns, names, record.file.string());
      if (!input_columns.empty())
        conditioned.excitation.push_back(ready(raw, input_columns, input_names, record.file.string()));
      conditioned.records.push_back(std::move(responses));
    } catch (const UnusableRecord& problem) {
      if (conditioned.records.empty() && &record == &group.records.back()) throw;
      conditioned.notes.push_back(fmt::format("{} is left out: {}", file, problem.what()));
      continue;
    }
    conditioned.notes.insert(conditioned.notes.end(), notes.begin(), notes.end());
    conditioned.files.push_back(file);
    conditioned.quality.insert(conditioned.quality.end(), quality.begin(), quality.end());
  }
  settle_sampling(conditioned, config, first.kind == "free_decay");
  warn_of_held(conditioned, first.sampling_rate_Hz);
  return conditioned;
}

/// What turns the entries of a shape of scaled channels into the first channel's quantity. @param lambda  the pole
Eigen::VectorXcd to_first_quantity(const std::vector<records::CampaignChannel>& channels, const Eigen::VectorXd& scale,
                                   std::complex<double> lambda) {
  Eigen::VectorXcd factor(std::ssize(channels));
  for (Index c = 0; c < factor.size(); ++c) {
    const int order = derivative(channels[static_cast<std::size_t>(c)].quantity) - derivative(channels.front().quantity);
    factor[c] = scale[c] * std::pow(lambda, -order);
  }
  return factor;
}

Identification identify_ambient(const std::vector<Samples>& scaled, const Conditioned& conditioned,
                                const IdentificationSettings& config, const IdentifyOptions& options) {
  signal::BlockCorrelations blocks;
  for (const Samples& record : scaled)
    blocks.append(signal::correlations(record, conditioned.references, 2 * config.block_rows, config.blocks));
  return config.method == "data" ? identify_from_data(scaled, conditioned.references, blocks, conditioned.rate_Hz, options)
                                 : identify(blocks, conditioned.rate_Hz, options);
}

}  // namespace

void require_known(const std::vector<std::string>& asked, const std::vector<std::string>& known, const std::string& key) {
  for (const std::string& name : asked)
    if (!contains(known, name))
      throw InputError({"", 0, key}, fmt::format("'{}' is no channel of the record{}", name, did_you_mean(name, known)),
                       "name its columns");
}

void choose_references(Conditioned& conditioned, const std::vector<std::string>& asked) {
  const std::vector<std::string> names = each_of(conditioned.channels, &records::CampaignChannel::name);
  require_known(asked, names, "references");
  const bool marked = std::ranges::any_of(conditioned.channels, &records::CampaignChannel::reference);
  for (std::size_t c = 0; c < names.size(); ++c) {
    const bool chosen = !asked.empty() ? contains(asked, names[c]) : !marked || conditioned.channels[c].reference;
    if (chosen) conditioned.references.push_back(static_cast<Index>(c));
  }
}

Conditioned condition_records(const records::Campaign& campaign, const records::RecordGroup& group,
                              const IdentificationSettings& config) {
  IdentificationSettings without = config;
  std::map<std::string, std::string> reasons;  // why channels are left out
  std::optional<LyingChannel> first;
  for (;;) {
    try {
      Conditioned conditioned = condition_with(campaign, group, without);
      for (ChannelQuality& q : conditioned.quality)
        if (reasons.contains(q.channel)) q.left_out = reasons.at(q.channel);
      for (const auto& [name, reason] : reasons)
        conditioned.warnings.push_back(fmt::format("setup {}: channel {} is left out: {}", conditioned.setup, name, reason));
      return conditioned;
    } catch (const LyingChannel& lie) {
      if (!first) first = lie;
      const std::string& name = lie.place().key;
      const auto& names = group.records.front().channels;
      const auto responses = std::ranges::count_if(
          names, [&](const std::string& n) { return !campaign.channel(n).is_input && !contains(without.exclude, n); });
      if (campaign.channel(name).reference || contains(config.references, name)) throw;
      if (responses < 2) throw LyingChannel(*first);
      without.exclude.push_back(name);
      reasons[name] = lie.what();
    }
  }
}

Index shortest_record(const std::vector<Samples>& records) {
  Index shortest = records.front().rows();
  for (const Samples& record : records) shortest = std::min(shortest, record.rows());
  return shortest;
}

Eigen::VectorXd channel_rms(const std::vector<Samples>& records) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(records.front().cols());
  for (const Samples& record : records)
    squares += record.colwise().squaredNorm().transpose() / static_cast<double>(record.rows());
  return (squares / static_cast<double>(records.size())).cwiseSqrt();
}

Eigen::VectorXcd physical_shape(const Eigen::VectorXcd& shape, const std::vector<records::CampaignChannel>& channels,
                                const Eigen::VectorXd& scale, double frequency_Hz, double damping_ratio) {
  return normalised_shape(shape.cwiseProduct(to_first_quantity(channels, scale, eigenvalue_of(frequency_Hz, damping_ratio))));
}

void to_physical_shapes(Identification& found, const std::vector<records::CampaignChannel>& channels,
                        const Eigen::VectorXd& scale) {
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    Cluster& mode = found.modes[m];
    const Eigen::VectorXcd factor = to_first_quantity(channels, scale, found.diagram[mode.representative].pole.eigenvalue);
    const Eigen::VectorXcd physical = mode.shape.cwiseProduct(factor);
    const double norm = physical.norm();
    mode.shape = normalised_shape(physical);
    if (m >= found.deviations.size()) continue;
    // A turn by 0, 90 or 180 degrees between quantities mixes real and imaginary parts. The larger deviation is used for both.
    ModeDeviation& deviation = found.deviations[m];
    const Eigen::VectorXd magnitude = factor.cwiseAbs() / norm;
    if ((factor.imag().array() != 0.0).any())
      deviation.shape_real = deviation.shape_imag = deviation.shape_real.cwiseMax(deviation.shape_imag);
    deviation.shape_real.array() *= magnitude.array();
    deviation.shape_imag.array() *= magnitude.array();
  }
}

Identification identify_modes(const Conditioned& conditioned, const IdentificationSettings& config) {
  const IdentifyOptions options = config.options(conditioned.rate_Hz, conditioned.channels);
  // All channels get the same RMS, so that a large one hides no other and units do not matter.
  const Eigen::VectorXd scale = channel_rms(conditioned.records);
  std::vector<Samples> scaled;
  for (const Samples& record : conditioned.records) scaled.push_back(scaled_channels(record, scale.cwiseInverse()));
  Identification found;
  if (!conditioned.excitation.empty()) {
    if (scaled.size() > 1)
      throw InputError(
          {"", 0, "setup"},
          fmt::format("setup {} has {} records with measured inputs, expected one", conditioned.setup, scaled.size()),
          "give each its own setup");
    const Samples& input = conditioned.excitation.front();
    const Eigen::VectorXd input_scale = channel_rms(conditioned.excitation);
    found =
        identify_input_output(input * input_scale.cwiseInverse().asDiagonal(), scaled.front(), conditioned.rate_Hz, options);
  } else {
    found = identify_ambient(scaled, conditioned, config, options);
  }
  if (options.selection == Selection::automatic && conditioned.excitation.empty()) {
    mark_periodic(found, scaled, conditioned.rate_Hz, options.periodic);
    if (!found.periodic.empty()) {
      // At small orders, a line pulls the poles of a near mode to itself. The records are identified again without the lines.
      const std::vector<PeriodicLine> lines = without_lines(
          scaled, found.periodic, conditioned.rate_Hz, options.limits.lowest_Hz, options.limits.highest_Hz, options.periodic);
      found = identify_ambient(scaled, conditioned, config, options);
      mark_periodic(found, scaled, conditioned.rate_Hz, options.periodic, lines);
      const bool nothing_is_left = channel_rms(scaled).maxCoeff() < kUnresolved;
      if (nothing_is_left) keep_modes(found, std::vector<bool>(found.modes.size(), false));
    }
  } else {
    found.periodic.clear();  // candidates that were not tested
  }
  to_physical_shapes(found, conditioned.channels, scale);
  return found;
}

SingularSpectra singular_spectra(const Conditioned& conditioned, const IdentificationSettings& config) {
  const Eigen::VectorXd scale = channel_rms(conditioned.records);
  signal::CrossSpectra average;
  for (const Samples& record : conditioned.records) {
    const signal::CrossSpectra one =
        signal::cross_spectra(scaled_channels(record, scale.cwiseInverse()), conditioned.rate_Hz, {config.welch_segment, 0.5});
    const auto weight = static_cast<double>(one.n_segments);
    if (average.density.empty()) average.density.assign(one.density.size(), Eigen::MatrixXcd::Zero(scale.size(), scale.size()));
    for (std::size_t f = 0; f < one.density.size(); ++f) average.density[f] += weight * one.density[f];
    average.frequency_Hz = one.frequency_Hz;
    average.n_segments += one.n_segments;
  }
  for (Eigen::MatrixXcd& density : average.density) density /= static_cast<double>(average.n_segments);
  return singular_spectra(average, 3);
}

signal::PowerSpectra average_spectra(const Conditioned& conditioned, const IdentificationSettings& config) {
  signal::PowerSpectra average;
  for (const Samples& record : conditioned.records) {
    const signal::PowerSpectra one = signal::power_spectra(record, conditioned.rate_Hz, {config.welch_segment, 0.5});
    const double weight = static_cast<double>(one.n_segments);
    average.frequency_Hz = one.frequency_Hz;
    average.density = average.n_segments == 0 ? Eigen::MatrixXd(weight * one.density)
                                              : Eigen::MatrixXd(average.density + weight * one.density);
    average.n_segments += one.n_segments;
  }
  average.density /= static_cast<double>(average.n_segments);
  const Eigen::ArrayXd omega = 2.0 * std::numbers::pi * average.frequency_Hz.array();
  for (std::size_t c = 0; c < conditioned.channels.size(); ++c) {
    const int missing = 2 - derivative(conditioned.channels[c].quantity);
    for (int k = 0; k < missing; ++k) average.density.col(static_cast<Index>(c)).array() *= omega.square();
  }
  return average;
}

}  // namespace twindeck::identification
