#include "identification/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "identification/changing_channels.hpp"
#include "identification/channel_lag.hpp"
#include "identification/common_motion.hpp"
#include "identification/doubts.hpp"
#include "identification/limits.hpp"
#include "identification/mode_choices.hpp"
#include "identification/one_mode.hpp"
#include "identification/response_modes.hpp"
#include "identification/sampling.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

Index position_of(const std::vector<records::CampaignChannel>& channels, const std::string& name) {
  const auto at = std::ranges::find(channels, name, &records::CampaignChannel::name);
  return at == channels.end() ? -1 : static_cast<Index>(at - channels.begin());
}

std::vector<Index> positions(const ConditionResult& result, const std::vector<records::CampaignChannel>& channels) {
  return each_of(channels, [&](const auto& channel) { return position_of(result.channels, channel.name); });
}

/// Positions, in the list of all channels, of the references that every setup has.
std::vector<Index> common_references(const ConditionResult& result) {
  std::vector<Index> common;
  for (const Index r : result.setups.front().conditioned.references) {
    const std::string& name = result.setups.front().conditioned.channels[static_cast<std::size_t>(r)].name;
    const bool everywhere = std::ranges::all_of(
        result.setups, [&](const SetupResult& setup) { return position_of(setup.conditioned.channels, name) >= 0; });
    if (everywhere) common.push_back(position_of(result.channels, name));
  }
  return common;
}

InputError no_common_reference(const std::filesystem::path& folder, const ConditionResult& result) {
  return InputError(
      {(folder / "channels.csv").string(), 0, "reference"},
      fmt::format("no reference channel is in each of the {} setups of condition {}", result.setups.size(), result.condition),
      "mark the sensors that stayed in place, or choose one setup: --set setup=…");
}

void list_channels(ConditionResult& result) {
  for (const SetupResult& setup : result.setups)
    for (const records::CampaignChannel& channel : setup.conditioned.channels)
      if (position_of(result.channels, channel.name) < 0) result.channels.push_back(channel);
}

/// Whether all setups have one rate; setups of different rates have no common lags.
bool is_one_rate(const ConditionResult& result) {
  return std::ranges::all_of(result.setups, [&](const SetupResult& setup) {
    return setup.conditioned.rate_Hz == result.setups.front().conditioned.rate_Hz;
  });
}

/// Divisors of the records for PreGER.
struct Scales {
  std::vector<double> level;  ///< of each setup: geometric mean of the RMS at the common references
  Eigen::VectorXd channels;   ///< (n_channels) geometric mean over the setups of a channel's RMS in units of their levels
};

/// One scale per channel, the same in all setups, so that the rows of the references stay those of one system. The level of
/// each setup (wind, traffic, gain of the recorder) is removed first, because it would weigh the other setups' channels.
Scales preger_scales(const ConditionResult& result, const std::vector<Index>& references) {
  const auto n_channels = static_cast<Index>(result.channels.size());
  Scales scales;
  Eigen::VectorXd log_scale = Eigen::VectorXd::Zero(n_channels), seen = log_scale;
  for (const SetupResult& setup : result.setups) {
    const Eigen::VectorXd log_rms = channel_rms(setup.conditioned.records).array().log();
    const std::vector<Index> at = positions(result, setup.conditioned.channels);
    double log_level = 0.0;
    for (std::size_t c = 0; c < at.size(); ++c)
      if (contains(references, at[c])) log_level += log_rms[static_cast<Index>(c)] / static_cast<double>(references.size());
    scales.level.push_back(std::exp(log_level));
    for (std::size_t c = 0; c < at.size(); ++c) {
      log_scale[at[c]] += log_rms[static_cast<Index>(c)] - log_level;
      seen[at[c]] += 1.0;
    }
  }
  scales.channels = (log_scale.array() / seen.array().max(1.0)).exp();
  return scales;
}

/// PreGER of the same records. @param scale  divisor of each channel, besides the level of the setup
Identification preger(const ConditionResult& result, const std::vector<Index>& references, const IdentificationSettings& config,
                      Eigen::VectorXd& scale) {
  const auto n_channels = static_cast<Index>(result.channels.size());
  const double rate = result.setups.front().conditioned.rate_Hz;
  const IdentifyOptions options = config.options(rate, result.channels);
  const Scales scales = preger_scales(result, references);
  scale = scales.channels;
  std::vector<SetupCorrelations> setups;
  for (const SetupResult& setup : result.setups) {
    const double level = scales.level[setups.size()];
    SetupCorrelations one{setup.conditioned.setup, positions(result, setup.conditioned.channels), {}, {}};
    for (const Index r : references)
      one.references.push_back(position_of(setup.conditioned.channels, result.channels[static_cast<std::size_t>(r)].name));
    Eigen::VectorXd own(static_cast<Index>(one.channels.size()));
    for (Index c = 0; c < own.size(); ++c) own[c] = level * scale[one.channels[static_cast<std::size_t>(c)]];
    signal::BlockCorrelations blocks;
    for (const Samples& record : setup.conditioned.records)
      blocks.append(
          signal::correlations(scaled_channels(record, own.cwiseInverse()), one.references, 2 * config.block_rows, 1));
    one.lags = blocks.mean();
    setups.push_back(std::move(one));
  }
  // The references alone must suffice for the orders.
  std::vector<int> orders = options.orders();
  const auto most = static_cast<int>((config.block_rows - 1) * static_cast<Index>(references.size()));
  std::erase_if(orders, [&](int order) { return order > most; });
  if (orders.empty()) return {};
  Identification found = modes_of_poles(merge_preger(setups, n_channels, config.block_rows, orders, rate), orders, options);
  to_physical_shapes(found, result.channels, scale);
  return found;
}

/// Sorts modes with their checks by frequency, because the other merging may change the order.
void sort_by_frequency(ConditionResult& result) {
  std::vector<std::size_t> order(result.modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return result.modes[i].frequency_Hz; });
  std::vector<MergedMode> modes;
  std::vector<MergingCheck> checks;
  for (const std::size_t i : order) {
    modes.push_back(std::move(result.modes[i]));
    checks.push_back(std::move(result.checks[i]));
  }
  result.modes = std::move(modes);
  result.checks = std::move(checks);
}

void check_merging(ConditionResult& result, const std::vector<Index>& references, const IdentificationSettings& config) {
  Eigen::VectorXd scale;
  const Identification before = preger(result, references, config, scale);
  result.checks = merging_checks(result.modes, before, result.channels, scale);
  if (config.merge != "preger") return;
  for (std::size_t m = 0; m < result.modes.size(); ++m) take_preger(result.modes[m], result.checks[m]);
  sort_by_frequency(result);
}

/// The highest peak above the usual band in the spectrum of an undecimated record; 0 for none.
double peak_above_band(const SetupResult& setup) {
  if (setup.conditioned.filtered || setup.singular.frequency_Hz.size() == 0) return 0.0;
  const double nyquist = 0.5 * setup.conditioned.rate_Hz;
  const std::vector<double> peaks = spectral_peaks(setup.singular.frequency_Hz, setup.singular.values.col(0), kClearPeak,
                                                   kFilteredBand * nyquist, kUnfilteredBand * nyquist);
  return peaks.empty() ? 0.0 : peaks.back();
}

/// Ends a band that the configuration leaves open at the highest common motion of the sensors. @return a sentence about it
std::string limit_band(SetupResult& setup) {
  constexpr double kBeyond = 1.1;  // of the highest common motion, to include the flank of a mode there
  const double nyquist = 0.5 * setup.conditioned.rate_Hz, peak = peak_above_band(setup);
  const double widest = (peak > 0.0 ? 1.0 : kFilteredBand) * nyquist;
  const double common = highest_common_Hz(setup.conditioned.records, setup.conditioned.rate_Hz);
  const bool limited = kBeyond * common > setup.limits.lowest_Hz && kBeyond * common < widest;
  setup.limits.highest_Hz = limited ? kBeyond * common : widest;
  const std::string why =
      limited ? "above which the sensors show no common motion"
      : peak > 0.0
          ? fmt::format(
                "the Nyquist frequency, because the spectrum has a peak at {:.4g} Hz above 0.8 of it; a mode there may "
                "be the alias of one above the Nyquist frequency; a record with a higher sampling rate shows which",
                peak)
          : "0.8 of the Nyquist frequency";
  return fmt::format("setup {}: modes are looked for up to {:.4g} Hz, {}; band.highest sets another limit",
                     setup.conditioned.setup, setup.limits.highest_Hz, why);
}

/// Modes of one setup of frequency response functions, with the singular values beside them.
void identify_hammer_test(SetupResult& setup, const IdentificationSettings& config) {
  const Eigen::VectorXd& f = setup.conditioned.responses.frequency_Hz;
  setup.singular = response_spectra(setup.conditioned.responses);
  setup.limits.lowest_Hz = f[0];
  setup.limits.highest_Hz = f[f.size() - 1];
  setup.found = identify_responses(setup.conditioned, config);
  take_choices(setup.found, config.choices, setup.conditioned, response_scale(setup.conditioned.responses));
}

/// Whether the modes come from responses to forces that were not measured.
bool is_output_only(const Conditioned& conditioned) { return conditioned.excitation.empty() && !conditioned.has_responses(); }

/// Reads the records of one setup and lowers the limits that they are too short for.
SetupResult read_setup(const records::Campaign& campaign, const records::RecordGroup& group,
                       const IdentificationSettings& config, Reporter& reporter) {
  SetupResult setup;
  const bool has_responses = group.records.front().kind == records::kFrfKind;
  setup.conditioned = has_responses ? condition_responses(campaign, group, config) : condition_records(campaign, group, config);
  for (const std::string& note : setup.conditioned.notes) reporter.say(note);
  for (const std::string& warning : setup.conditioned.warnings) reporter.warn(warning);
  IdentificationSettings own = config;
  own.decimation = std::max(config.decimation, 1L);
  own.block_rows = setup.conditioned.block_rows;
  if (has_responses) {
    setup.limits = std::move(own);
    return setup;
  }
  auto [limits, note] = carried_by(setup.conditioned, own);
  setup.limits = std::move(limits);
  if (!note.empty()) reporter.warn(note);
  return setup;
}

}  // namespace

ConditionResult read_condition(const records::Campaign& campaign, const std::vector<records::RecordGroup>& groups,
                               const IdentificationSettings& config, Reporter& reporter) {
  ConditionResult result;
  std::vector<std::string> left_out;
  result.condition = groups.front().condition;
  for (const records::RecordGroup& group : groups) {
    reporter.progress("reading records of condition " + result.condition, static_cast<double>(result.setups.size()),
                      static_cast<double>(groups.size()));
    SetupResult setup;
    try {
      setup = read_setup(campaign, group, config, reporter);
    } catch (const UnusableRecord& problem) {
      if (&group == &groups.back() && result.setups.empty()) throw;
      left_out.push_back(fmt::format("setup {} of condition {} is left out: {}", group.setup, group.condition, problem.what()));
      continue;
    }
    result.setups.push_back(std::move(setup));
  }
  for (const std::string& warning : left_out) reporter.warn(warning);
  list_channels(result);
  if (config.merge == "preger" && !is_one_rate(result))
    throw InputError(
        {(campaign.folder / "campaign.toml").string(), groups.front().records.front().line, "sampling_rate_Hz"},
        fmt::format("differs between the setups of condition {}, expected one rate for merge = \"preger\"", result.condition),
        "merge after identification: --set merge=poser");
  if (result.setups.size() > 1 && common_references(result).empty()) throw no_common_reference(campaign.folder, result);
  return result;
}

void merge_setups(ConditionResult& result) {
  list_channels(result);
  const auto setups = each_of(result.setups, [&](const SetupResult& setup) -> SetupModes {
    return {setup.conditioned.setup, positions(result, setup.conditioned.channels), setup.found.modes, setup.found.deviations};
  });
  const std::vector<Index> references = common_references(result);
  if (setups.size() > 1 && references.empty()) throw no_common_reference({}, result);
  result.modes = merge_poser(setups, static_cast<Index>(result.channels.size()), references, {});
}

void identify_condition(ConditionResult& result, const IdentificationSettings& config, Reporter& reporter) {
  std::size_t done = 0;
  for (SetupResult& setup : result.setups) {
    const std::string& name = setup.conditioned.setup;
    reporter.progress(fmt::format("identifying {} in condition {}", name, result.condition), static_cast<double>(done++),
                      static_cast<double>(result.setups.size()));
    if (setup.conditioned.has_responses()) {
      identify_hammer_test(setup, config);
      continue;
    }
    setup.spectra = average_spectra(setup.conditioned, setup.limits);
    setup.singular = singular_spectra(setup.conditioned, setup.limits);
    const std::string band = config.highest_Hz == 0.0 ? limit_band(setup) : "";
    setup.found = identify_modes(setup.conditioned, setup.limits);
    take_choices(setup.found, config.choices, setup.conditioned, channel_rms(setup.conditioned.records));
    if (!band.empty()) reporter.say(band);
    for (const PeriodicLine& line : setup.found.periodic)
      reporter.say(fmt::format("setup {}: {:.4f} Hz is a steady line of a periodic force{}, no mode", name, line.frequency_Hz,
                               line.multiple > 1 ? fmt::format(" ({} times the lowest)", line.multiple) : ""));
  }
  std::vector<Identification*> found;
  for (SetupResult& setup : result.setups) found.push_back(&setup.found);
  if (config.selection == Selection::automatic) drop_lines_of_others(found, config.periodic);
  for (SetupResult& setup : result.setups) {
    if (setup.conditioned.has_responses()) continue;
    estimate_lags(setup.conditioned, setup.found);
    const std::string late = lag_warning(setup.conditioned, setup.found);
    if (!late.empty()) reporter.warn(late);
    if (!is_output_only(setup.conditioned)) continue;  // a measured force also moves the structure off its modes
    for (const std::string& change : changes_within_records(setup.conditioned, setup.found)) reporter.warn(change);
  }
  merge_setups(result);
  if (result.setups.size() > 1 && is_output_only(result.setups.front().conditioned) && is_one_rate(result)) {
    const auto fewest = std::ranges::min_element(
        result.setups, [](const SetupResult& a, const SetupResult& b) { return a.limits.block_rows < b.limits.block_rows; });
    check_merging(result, common_references(result), fewest->limits);
  }
  if (config.choices.empty())
    for (const std::string& line : merge_modes_that_are_one(result)) reporter.warn(line);
  for (const std::string& doubt : doubts_of(result)) reporter.warn(doubt);
}

}  // namespace twindeck::identification
