#include "steps/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "signal/condition.hpp"

namespace twindeck::steps {

using Eigen::Index;

io::FieldTable IdentificationConfig::fields() {
  io::FieldTable table;
  table.text("setup", setup, "setup whose records are used; empty where the campaign has one only")
      .text("condition", condition, "condition whose records are used; empty where the setup has one only")
      .text("kind", kind, "kind of record: ambient, wind or another whose excitation is broad")
      .texts("references", references, "reference channels; empty: those marked in channels.csv, or all")
      .texts("exclude", exclude, "channels that are left out")
      .integer("longest_gap", longest_gap, io::non_negative(), "samples missing in a row that may be bridged by a straight line")
      .integer("decimation", decimation, {1.0, 1000.0}, "every so many-th sample is kept, after a zero-phase low-pass")
      .number("band.lowest", lowest_Hz, "Hz", io::non_negative(), "poles below are left out")
      .number("band.highest", highest_Hz, "Hz", io::non_negative(), "poles above are left out; 0: 0.8 of the Nyquist frequency")
      .integer("block_rows", block_rows, {2.0, 500.0}, "block rows of the Toeplitz matrix; twice as many lags are used")
      .integer("minimum_order", minimum_order, {2.0, 500.0}, "smallest model order")
      .integer("maximum_order", maximum_order, {2.0, 500.0}, "largest model order")
      .integer("order_step", order_step, {1.0, 100.0}, "step of the order")
      .integer("blocks", blocks, {2.0, 1000.0}, "blocks a record is cut into for the standard deviations")
      .integer("welch_segment", welch_segment, {8.0, 1e7}, "samples of a Welch segment, after decimation")
      .number("stable.frequency", criteria.frequency, "", io::positive(), "paper 3.1: relative change of a stable frequency")
      .number("stable.damping", criteria.damping, "", io::positive(), "paper 3.1: change of a stable damping ratio (0.01 = 1 % of critical)")
      .number("stable.mac", criteria.mac, "", {0.0, 1.0}, "paper 3.1: MAC of a stable shape")
      .number("largest_damping", largest_damping, "", {0.0, 1.0, true}, "poles with a larger damping ratio are left out")
      .number("cleaning.mac", cleaning.mac, "", {0.0, 1.0}, "paper Eq. (3): MAC of shapes that count as the same")
      .number("cleaning.frequency", cleaning.frequency, "", io::positive(), "relative distance of frequencies that may count as the same")
      .number("cleaning.recursion", cleaning.recursion, "", io::non_negative(), "paper Eq. (4): index of recursion that a mode exceeds")
      .number("cleaning.share", cleaning.share, "", {0.0, 1.0}, "share of the orders that a mode is found at, from its first; 0: paper's rule")
      .number("cleaning.deviation", largest_deviation, "", io::non_negative(),
              "largest relative standard deviation of a mode's frequency; 0: paper's rule, nothing is dropped for it");
  return table;
}

namespace {

bool listed(const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

void require_known(const std::vector<std::string>& asked, const std::vector<std::string>& known, const std::string& key) {
  for (const std::string& name : asked) {
    if (!listed(known, name)) {
      throw InputError({"", 0, key}, fmt::format("'{}' is no channel of the record{}", name, did_you_mean(name, known)), "name its columns");
    }
  }
}

/// Columns that are used: responses that are not left out.
std::vector<Index> used_columns(const Campaign& campaign, const CampaignRecord& record, const IdentificationConfig& config) {
  require_known(config.exclude, record.channels, "exclude");
  std::vector<Index> columns;
  for (std::size_t c = 0; c < record.channels.size(); ++c) {
    if (!campaign.channel(record.channels[c]).is_input && !listed(config.exclude, record.channels[c])) columns.push_back(static_cast<Index>(c));
  }
  if (columns.empty()) throw InputError({"", 0, "exclude"}, "leaves no response channel", "leave out fewer");
  return columns;
}

void choose_references(Conditioned& conditioned, const std::vector<std::string>& asked) {
  std::vector<std::string> names;
  for (const CampaignChannel& channel : conditioned.channels) names.push_back(channel.name);
  require_known(asked, names, "references");
  const bool marked = std::any_of(conditioned.channels.begin(), conditioned.channels.end(), [](const auto& c) { return c.reference; });
  for (std::size_t c = 0; c < names.size(); ++c) {
    const bool chosen = !asked.empty() ? listed(asked, names[c]) : !marked || conditioned.channels[c].reference;
    if (chosen) conditioned.references.push_back(static_cast<Index>(c));
  }
}

void refuse_dead(const std::vector<ChannelQuality>& quality, const std::vector<CampaignChannel>& used) {
  for (const ChannelQuality& q : quality) {
    const bool is_used = std::any_of(used.begin(), used.end(), [&](const auto& c) { return c.name == q.channel; });
    if (q.dead && is_used) {
      throw InputError({q.record, 0, q.channel}, fmt::format("is constant ({}) over {} samples", q.mean, q.samples),
                       "leave the channel out: --set 'exclude=[\"" + q.channel + "\"]'");
    }
  }
}

int derivative(const std::string& quantity) { return quantity == "acceleration" ? 2 : quantity == "velocity" ? 1 : 0; }

double highest_of(const Conditioned& conditioned, const IdentificationConfig& config) {
  const double nyquist = 0.5 * conditioned.rate_Hz;
  if (config.highest_Hz > nyquist || config.lowest_Hz >= (config.highest_Hz > 0.0 ? config.highest_Hz : 0.8 * nyquist)) {
    throw InputError({"", 0, "band.highest"},
                     fmt::format("the band {} to {} Hz does not lie below {} Hz, the Nyquist frequency after decimation", config.lowest_Hz,
                                 config.highest_Hz, nyquist),
                     "change the band, or decimate less");
  }
  return config.highest_Hz > 0.0 ? config.highest_Hz : 0.8 * nyquist;
}

}  // namespace

Conditioned condition_records(const Campaign& campaign, const IdentificationConfig& config) {
  const std::vector<CampaignRecord> records = choose_records(campaign, {config.setup, config.condition, config.kind});
  const CampaignRecord& first = records.front();
  const std::vector<Index> columns = used_columns(campaign, first, config);
  Conditioned conditioned;
  conditioned.setup = first.setup;
  conditioned.condition = first.condition;
  conditioned.rate_Hz = first.sampling_rate_Hz / static_cast<double>(config.decimation);
  std::vector<std::string> names;
  for (const Index c : columns) {
    names.push_back(first.channels[static_cast<std::size_t>(c)]);
    conditioned.channels.push_back(campaign.channel(names.back()));
  }
  choose_references(conditioned, config.references);
  for (const CampaignRecord& record : records) {
    const Eigen::MatrixXd raw = read_record(campaign, record);
    const auto quality = channel_quality(raw, record.channels, record.setup, record.file.lexically_relative(campaign.folder).generic_string());
    conditioned.quality.insert(conditioned.quality.end(), quality.begin(), quality.end());
    refuse_dead(quality, conditioned.channels);
    Eigen::MatrixXd data = raw(Eigen::all, columns);
    fill_gaps(data, names, config.longest_gap, record.file.string());
    conditioned.records.push_back(signal::detrended(signal::decimated(signal::detrended(data), config.decimation)));
  }
  return conditioned;
}

sysid::Identification identify_modes(const Conditioned& conditioned, const IdentificationConfig& config) {
  sysid::IdentifyOptions options;
  options.block_rows = config.block_rows;
  options.minimum_order = static_cast<int>(config.minimum_order);
  options.maximum_order = static_cast<int>(std::max(config.maximum_order, config.minimum_order));
  options.order_step = static_cast<int>(config.order_step);
  options.criteria = config.criteria;
  options.limits = {config.lowest_Hz, highest_of(conditioned, config), config.largest_damping};
  options.cleaning = config.cleaning;
  options.largest_deviation = config.largest_deviation;
  // Channels on one scale, so that a large or a distant one does not hide the others and units do not matter.
  const auto n = static_cast<Index>(conditioned.channels.size());
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(n);
  for (const Eigen::MatrixXd& record : conditioned.records) scale += record.colwise().squaredNorm().transpose() / static_cast<double>(record.rows());
  scale = (scale / static_cast<double>(conditioned.records.size())).cwiseSqrt();
  signal::BlockCorrelations blocks;
  for (const Eigen::MatrixXd& record : conditioned.records) {
    blocks.append(signal::correlations(record * scale.cwiseInverse().asDiagonal(), conditioned.references, 2 * config.block_rows, config.blocks));
  }
  sysid::Identification found = sysid::identify(blocks, conditioned.rate_Hz, options);
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    sysid::Cluster& mode = found.modes[m];
    const std::complex<double> lambda = found.diagram[mode.representative].pole.eigenvalue;
    Eigen::VectorXcd factor(n);
    for (Index c = 0; c < n; ++c) {
      const int order = derivative(conditioned.channels[static_cast<std::size_t>(c)].quantity) - derivative(conditioned.channels.front().quantity);
      factor[c] = scale[c] * std::pow(lambda, -order);
    }
    const Eigen::VectorXcd physical = mode.shape.cwiseProduct(factor);
    const double norm = physical.norm();
    mode.shape = sysid::normalised_shape(physical);
    if (m >= found.deviations.size()) continue;
    // The turn by 0, 90 or 180 degrees between quantities mixes real and imaginary parts: the larger of both holds for either.
    sysid::ModeDeviation& deviation = found.deviations[m];
    const Eigen::VectorXd magnitude = factor.cwiseAbs() / norm;
    if ((factor.imag().array() != 0.0).any()) deviation.shape_real = deviation.shape_imag = deviation.shape_real.cwiseMax(deviation.shape_imag);
    deviation.shape_real.array() *= magnitude.array();
    deviation.shape_imag.array() *= magnitude.array();
  }
  return found;
}

signal::PowerSpectra average_spectra(const Conditioned& conditioned, const IdentificationConfig& config) {
  signal::PowerSpectra average;
  for (const Eigen::MatrixXd& record : conditioned.records) {
    const Index segment = std::min<Index>(config.welch_segment, record.rows());
    if (segment < config.welch_segment) {
      throw InputError({"", 0, "welch_segment"}, fmt::format("is {}, longer than the record of {} samples after decimation", config.welch_segment, segment),
                       "give a shorter segment");
    }
    const signal::PowerSpectra one = signal::power_spectra(record, conditioned.rate_Hz, {segment, 0.5});
    const double weight = static_cast<double>(one.n_segments);
    average.frequency_Hz = one.frequency_Hz;
    average.density = average.n_segments == 0 ? Eigen::MatrixXd(weight * one.density) : Eigen::MatrixXd(average.density + weight * one.density);
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

}  // namespace twindeck::steps
