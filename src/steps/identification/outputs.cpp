#include "steps/identification/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/lists.hpp"
#include "io/atomic.hpp"
#include "steps/identification/exports.hpp"

namespace twindeck::steps {

namespace {

namespace fs = std::filesystem;
using Eigen::Index;

std::string name_of(std::size_t mode) { return std::to_string(mode + 1); }

// A deviation that happens to be zero must not give a row infinite weight.
double at_least(double deviation, double smallest) { return std::max(deviation, smallest); }

bool is_partial(const identification::MergedMode& mode) { return mode.shape.array().real().isNaN().any(); }

const identification::Cluster& cluster_of(const identification::ConditionResult& result,
                                          std::pair<std::size_t, std::size_t> member) {
  return result.setups[member.first].found.modes[member.second];
}

std::size_t orders_of(const identification::ConditionResult& result, const identification::MergedMode& mode) {
  std::size_t most = 0;
  for (const auto& member : mode.members) most = std::max(most, cluster_of(result, member).members.size());
  return most;
}

void write_modes(const identification::ConditionResult& result, const fs::path& file) {
  io::CsvWriter csv({"mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct",
                     "frequency_scatter_Hz", "damping_ratio_scatter_pct", "orders", "setups", "partial", "efdd_frequency_Hz",
                     "efdd_damping_ratio_pct"});
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const identification::MergedMode& mode = result.modes[m];
    const identification::Cluster& first = cluster_of(result, mode.members.front());
    const bool single = mode.members.size() == 1;
    const identification::SingularSpectra& spectra = result.setups[mode.members.front().first].singular;
    const identification::EfddMode check =
        spectra.frequency_Hz.size() > 0 ? identification::efdd(spectra, mode.frequency_Hz) : identification::EfddMode{};
    csv.row({name_of(m), mode.frequency_Hz, mode.deviation.frequency_Hz, 100.0 * mode.damping_ratio,
             100.0 * mode.deviation.damping_ratio, single ? first.frequency_scatter_Hz : mode.frequency_scatter_Hz,
             100.0 * (single ? first.damping_ratio_scatter : mode.damping_ratio_scatter), orders_of(result, mode),
             mode.members.size(), is_partial(mode) ? 1 : 0, check.found ? std::optional(check.frequency_Hz) : std::nullopt,
             check.found ? std::optional(100.0 * check.damping_ratio) : std::nullopt});
  }
  csv.save(file);
}

void write_shapes(const identification::ConditionResult& result, const fs::path& file) {
  io::CsvWriter csv({"mode", "point", "direction", "value", "value_imag"});
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const Eigen::VectorXcd& shape = result.modes[m].shape;
    std::complex<double> largest = 0.0;
    for (Index i = 0; i < shape.size(); ++i)
      if (!std::isnan(shape[i].real()) && std::abs(shape[i]) > std::abs(largest)) largest = shape[i];
    for (std::size_t c = 0; c < result.channels.size(); ++c) {
      const std::complex<double> value = shape[static_cast<Index>(c)] / largest;
      if (std::isnan(value.real())) continue;
      csv.row({name_of(m), result.channels[c].point, result.channels[c].name, value.real(), value.imag()});
    }
  }
  csv.save(file);
}

/// Name of a setup's mode in the merged list, "" for none.
std::string merged_name(const identification::ConditionResult& result, std::size_t setup, int mode) {
  if (mode < 0) return "";
  for (std::size_t m = 0; m < result.modes.size(); ++m)
    for (const auto& member : result.modes[m].members)
      if (member == std::pair(setup, static_cast<std::size_t>(mode))) return name_of(m);
  return "";
}

void write_poles(const identification::ConditionResult& result, const fs::path& file) {
  io::CsvWriter csv({"setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping",
                     "stable_shape", "mode", "condition"});
  for (std::size_t s = 0; s < result.setups.size(); ++s)
    for (const identification::DiagramPole& p : result.setups[s].found.diagram)
      csv.row({result.setups[s].conditioned.setup, p.pole.order, p.pole.frequency_Hz, 100.0 * p.pole.damping_ratio,
               p.stable_frequency ? 1 : 0, p.stable_damping ? 1 : 0, p.stable_shape ? 1 : 0, merged_name(result, s, p.mode),
               result.condition});
  csv.save(file);
}

void write_spectra(const identification::ConditionResult& result, const fs::path& folder) {
  io::CsvWriter psd({"channel", "frequency_Hz", "psd_m2_s3", "setup", "condition"});
  io::CsvWriter singular({"setup", "frequency_Hz", "sv1", "sv2", "sv3", "condition"});
  for (const identification::SetupResult& setup : result.setups) {
    const std::string& name = setup.conditioned.setup;
    for (std::size_t c = 0; c < setup.conditioned.channels.size(); ++c)
      for (Index f = 0; f < setup.spectra.frequency_Hz.size(); ++f)
        psd.row({setup.conditioned.channels[c].name, setup.spectra.frequency_Hz[f],
                 setup.spectra.density(f, static_cast<Index>(c)), name, result.condition});
    for (Index f = 0; f < setup.singular.frequency_Hz.size(); ++f) {
      const auto value = [&](Index k) {
        return k < setup.singular.values.cols() ? std::optional(setup.singular.values(f, k)) : std::nullopt;
      };
      singular.row({name, setup.singular.frequency_Hz[f], value(0), value(1), value(2), result.condition});
    }
  }
  psd.save(folder / "psd.csv");
  singular.save(folder / "singular_values.csv");
}

void write_merging(const identification::ConditionResult& result, const fs::path& file) {
  io::CsvWriter csv(
      {"mode", "frequency_Hz", "preger_frequency_Hz", "damping_ratio_pct", "preger_damping_ratio_pct", "mac", "setups"});
  for (std::size_t m = 0; m < result.checks.size(); ++m) {
    const identification::MergingCheck& check = result.checks[m];
    const auto known = [&](double value) { return check.found ? std::optional(value) : std::nullopt; };
    csv.row({name_of(m), check.poser_frequency_Hz, known(check.frequency_Hz), 100.0 * check.poser_damping_ratio,
             known(100.0 * check.damping_ratio), known(check.mac), result.modes[m].members.size()});
  }
  csv.save(file);
}

/// Writes the rows of the campaign's channels.csv whose channels have shape values.
void write_channels(const records::Campaign& campaign, const identification::ConditionResult& result, const fs::path& file) {
  const auto table = io::CsvTable::read(campaign.folder / "channels.csv", {"channel"}, {}, true);
  io::CsvWriter csv(table.columns());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool used = std::ranges::any_of(
        result.channels, [&](const records::CampaignChannel& c) { return c.name == table.text(row, "channel"); });
    if (!used) continue;
    std::vector<io::Cell> cells;
    for (const std::string& column : table.columns()) cells.emplace_back(table.text(row, column));
    csv.row(cells);
  }
  csv.save(file);
}

void write_quality(const std::vector<identification::ChannelQuality>& rows, const std::filesystem::path& file) {
  io::CsvWriter csv({"setup", "record", "channel", "samples", "missing", "longest_gap", "clipped", "mean", "rms", "drift_rms",
                     "dead", "left_out", "lag_s", "lag_std_s"});
  for (const identification::ChannelQuality& q : rows)
    csv.row({q.setup, q.record, q.channel, q.samples, q.missing, q.longest_gap, q.clipped, q.mean, q.rms, q.drift,
             q.dead ? 1 : 0, q.left_out, q.lag_s, q.lag_std_s});
  csv.save(file);
}

void write_condition(const records::Campaign& campaign, const identification::ConditionResult& result, const fs::path& folder) {
  fs::create_directories(folder);
  write_modes(result, folder / "modes.csv");
  write_shapes(result, folder / "shapes.csv");
  write_poles(result, folder / "poles.csv");
  write_spectra(result, folder);
  if (!result.checks.empty()) write_merging(result, folder / "merging.csv");
  write_channels(campaign, result, folder / "channels.csv");
}

/// An empty table for each condition, in the order of first appearance.
std::string tables_of(const std::vector<std::string>& conditions) {
  std::string tables;
  for (auto at = conditions.begin(); at != conditions.end(); ++at)
    if (std::find(conditions.begin(), at, *at) == at) tables += "[" + *at + "]\n";
  return tables;
}

void write_features(const records::Campaign& campaign, const std::vector<identification::ConditionResult>& results,
                    const std::vector<std::string>& conditions, const std::vector<std::vector<io::Cell>>& more,
                    const std::vector<identification::ChannelQuality>& more_quality, const fs::path& folder) {
  fs::create_directories(folder);
  io::CsvWriter csv({"type", "mode", "channel", "condition", "value", "std"});
  std::vector<identification::ChannelQuality> quality;
  for (const identification::ConditionResult& result : results) {
    const std::string& condition = result.condition;
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
      const identification::MergedMode& mode = result.modes[m];
      const std::string name = name_of(m);
      csv.row({"frequency_Hz", name, "", condition, mode.frequency_Hz,
               at_least(mode.deviation.frequency_Hz, 1e-9 * mode.frequency_Hz)});
      csv.row({"damping_ratio_pct", name, "", condition, 100.0 * mode.damping_ratio,
               at_least(100.0 * mode.deviation.damping_ratio, 1e-9)});
      for (std::size_t c = 0; c < result.channels.size(); ++c) {
        const auto i = static_cast<Index>(c);
        if (std::isnan(mode.shape[i].real())) continue;
        const std::string& channel = result.channels[c].name;
        csv.row({"shape", name, channel, condition, mode.shape[i].real(), at_least(mode.deviation.shape_real[i], 1e-6)});
        csv.row({"shape_imag", name, channel, condition, mode.shape[i].imag(), at_least(mode.deviation.shape_imag[i], 1e-6)});
      }
    }
    for (const identification::SetupResult& setup : result.setups)
      quality.insert(quality.end(), setup.conditioned.quality.begin(), setup.conditioned.quality.end());
  }
  for (const std::vector<io::Cell>& row : more) csv.row(row);
  csv.save(folder / "rows.csv");
  fs::copy_file(campaign.folder / "channels.csv", folder / "channels.csv");
  if (campaign.conditions.empty())
    io::write_file_atomically(folder / "conditions.toml", tables_of(conditions));
  else
    fs::copy_file(campaign.folder / "conditions.toml", folder / "conditions.toml");
  quality.insert(quality.end(), more_quality.begin(), more_quality.end());
  write_quality(quality, folder / "quality.csv");
}

std::string numbers_of(const identification::Numbering& numbering) {
  std::vector<int> numbers = each_of(numbering.harmonics, &identification::Harmonic::number);
  return fmt::format("{}", fmt::join(numbers, " "));
}

/// decays.csv: each mode with the ambient mode it agrees with (empty for none). amplitude.csv: source free_decay (bands of the
/// envelope) and ambient (one row a mode, amplitude sqrt(2) times the modal RMS), at the channel of the shape's largest
/// component.
void write_decays(const std::vector<identification::DecayResult>& decays,
                  const std::vector<identification::ConditionResult>& results,
                  const identification::IdentificationSettings& config, const std::filesystem::path& folder) {
  io::CsvWriter modes({"condition", "setup", "mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct",
                       "damping_ratio_std_pct", "orders", "ambient_mode", "ambient_frequency_Hz", "ambient_frequency_std_Hz",
                       "mac"});
  io::CsvWriter levels({"source", "condition", "setup", "record", "mode", "amplitude", "quantity", "frequency_Hz",
                        "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct", "seconds"});
  for (const identification::DecayResult& decay : decays) {
    const identification::ConditionResult* ambient = identification::condition_named(results, decay.conditioned.condition);
    for (std::size_t m = 0; m < decay.found.modes.size(); ++m) {
      const identification::Cluster& mode = decay.found.modes[m];
      const identification::ModeDeviation& deviation = decay.found.deviations[m];
      const auto partner = identification::partner_of(mode, decay.conditioned.channels, ambient);
      const auto known = [&](double value) { return partner ? std::optional(value) : std::nullopt; };
      const std::size_t at = partner ? partner->mode : 0;
      modes.row({decay.conditioned.condition, decay.conditioned.setup, std::to_string(m + 1), mode.frequency_Hz,
                 deviation.frequency_Hz, 100.0 * mode.damping_ratio, 100.0 * deviation.damping_ratio, mode.members.size(),
                 partner ? std::to_string(at + 1) : "", known(partner ? ambient->modes[at].frequency_Hz : 0.0),
                 known(partner ? ambient->modes[at].deviation.frequency_Hz : 0.0), known(partner ? partner->mac : 0.0)});
    }
    for (const identification::DecayResult::ByAmplitude& by : decay.by_amplitude) {
      const Eigen::VectorXcd& shape = decay.found.modes[by.found].shape;
      for (const identification::AmplitudePoint& point : by.points)
        levels.row({"free_decay", decay.conditioned.condition, decay.conditioned.setup, by.record, by.mode, point.amplitude,
                    identification::quantity_at_largest(decay.conditioned.channels, shape), point.frequency_Hz,
                    point.frequency_std_Hz, 100.0 * point.damping_ratio, 100.0 * point.damping_ratio_std, point.seconds});
    }
  }
  for (const identification::AmbientAmplitude& ambient : identification::ambient_amplitudes(results, config)) {
    const identification::MergedMode& mode = identification::condition_named(results, ambient.condition)->modes[ambient.mode];
    levels.row({"ambient", ambient.condition, ambient.setup, "", std::to_string(ambient.mode + 1), ambient.amplitude,
                ambient.quantity, mode.frequency_Hz, mode.deviation.frequency_Hz, 100.0 * mode.damping_ratio,
                100.0 * mode.deviation.damping_ratio, ambient.seconds});
  }
  modes.save(folder / "decays.csv");
  levels.save(folder / "amplitude.csv");
}

/// stays.csv and stay_tensions.csv: the tension is empty without a length, lambda² without the first harmonic.
void write_stays(const std::vector<identification::StayResult>& stays, double level, const std::filesystem::path& folder) {
  io::CsvWriter modes(
      {"stay", "condition", "harmonic", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"});
  std::vector<std::string> columns = {"stay", "condition", "length_m"};
  using Names = std::pair<std::string, std::string>;  // of a quantity, its unit
  for (const auto& [name, unit] :
       {Names{"c", "_Hz"}, Names{"tension_per_mass", "_m2_s2"}, Names{"lambda_squared", ""}, Names{"xi", ""}})
    for (const char* end : {"", "_low", "_high"}) columns.push_back(name + end + unit);
  columns.insert(columns.end(),
                 {"hinged_probability", "clamped_probability", "numbering_probability", "residual", "harmonics", "level"});
  io::CsvWriter tensions(columns);
  for (const identification::StayResult& stay : stays) {
    for (const identification::StayResult::Mode& mode : stay.modes)
      modes.row({stay.stay, stay.condition, mode.harmonic, mode.frequency_Hz, mode.frequency_std_Hz, 100.0 * mode.damping_ratio,
                 100.0 * mode.damping_ratio_std});
    if (!stay.fitted) continue;
    const identification::StayFit& fit = stay.fit;
    const bool has_length = stay.length_m > 0.0;
    std::vector<io::Cell> cells = {stay.stay, stay.condition, has_length ? std::optional(stay.length_m) : std::nullopt};
    const auto add = [&](const identification::Bounded& of, bool known) {
      for (const double value : {of.value, of.low, of.high}) cells.emplace_back(known ? std::optional(value) : std::nullopt);
    };
    add(fit.c_Hz, true);
    add(fit.tension_per_mass, has_length);
    add(fit.lambda_squared, stay.modes.front().harmonic == 1);
    add(fit.xi, true);
    cells.insert(cells.end(), {fit.hinged, fit.clamped, fit.numbering.probability, fit.residual, stay.modes.size(), level});
    tensions.row(cells);
  }
  modes.save(folder / "stays.csv");
  tensions.save(folder / "stay_tensions.csv");
}

/// Rows `stay_frequency_Hz` of features/rows.csv: channel = the stay, mode = the harmonic.
std::vector<std::vector<io::Cell>> stay_rows(const std::vector<identification::StayResult>& stays) {
  std::vector<std::vector<io::Cell>> rows;
  for (const identification::StayResult& stay : stays)
    for (const identification::StayResult::Mode& mode : stay.modes)
      rows.push_back({"stay_frequency_Hz", std::to_string(mode.harmonic), stay.stay, stay.condition, mode.frequency_Hz,
                      mode.frequency_std_Hz});
  return rows;
}

}  // namespace

void write_identification(const records::Campaign& campaign, const std::vector<identification::ConditionResult>& results,
                          const std::vector<identification::DecayResult>& decays,
                          const std::vector<identification::StayResult>& stays,
                          const identification::IdentificationSettings& config, const fs::path& folder) {
  std::vector<identification::ChannelQuality> quality;
  if (results.empty()) write_condition(campaign, {}, folder);  // only stays: the same files, without rows
  for (std::size_t i = 0; i < results.size(); ++i) {
    const fs::path place = i == 0 ? folder : folder / "conditions" / results[i].condition;
    write_condition(campaign, results[i], place);
    write_mode_exports(results[i], place);
  }
  const bool no_ambient = !results.empty() && results.front().of_decays;
  write_decays(decays, no_ambient ? std::vector<identification::ConditionResult>{} : results, config, folder);
  write_stays(stays, config.stay_level, folder);
  for (const identification::DecayResult& decay : decays)
    quality.insert(quality.end(), decay.conditioned.quality.begin(), decay.conditioned.quality.end());
  for (const identification::StayResult& stay : stays) quality.insert(quality.end(), stay.quality.begin(), stay.quality.end());
  std::vector<std::string> conditions = each_of(results, &identification::ConditionResult::condition);
  for (const identification::StayResult& stay : stays) conditions.push_back(stay.condition);
  write_features(campaign, results, conditions, stay_rows(stays), quality, folder / "features");
}

std::vector<std::string> notes_of(const std::vector<identification::DecayResult>& decays,
                                  const std::vector<identification::StayResult>& stays) {
  std::vector<std::string> notes = each_of(decays, &identification::DecayResult::note);
  for (const identification::StayResult& stay : stays) notes.push_back(stay.note);
  std::erase(notes, "");
  return notes;
}

std::string why_no_mode(const identification::ConditionResult& result) {
  const bool lines = std::ranges::any_of(
      result.setups, [](const identification::SetupResult& setup) { return !setup.found.periodic.empty(); });
  return fmt::format("no mode is stable over the model orders{}; see poles.csv, and raise block_rows or the record's length",
                     lines ? " beside the lines of periodic forces" : "");
}

std::vector<std::string> report_lines(const identification::ConditionResult& result) {
  std::vector<std::string> lines = {
      fmt::format("condition {}, {} setup{}", result.condition, result.setups.size(), result.setups.size() == 1 ? "" : "s"),
      fmt::format("{:>4} {:>10} {:>9} {:>9} {:>9} {:>7} {:>7}", "mode", "f [Hz]", "sigma", "zeta [%]", "sigma", "orders",
                  "setups")};
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const identification::MergedMode& mode = result.modes[m];
    lines.push_back(fmt::format("{:>4} {:>10.4f} {:>9.4f} {:>9.3f} {:>9.3f} {:>7} {:>7}{}", name_of(m), mode.frequency_Hz,
                                mode.deviation.frequency_Hz, 100.0 * mode.damping_ratio, 100.0 * mode.deviation.damping_ratio,
                                orders_of(result, mode), mode.members.size(), is_partial(mode) ? " partial" : ""));
  }
  return lines;
}

std::vector<std::string> stay_lines(const std::vector<identification::StayResult>& stays, double level) {
  constexpr double kCertain = 0.9;  // probability above which no warning is added
  constexpr double kNarrow = 0.1;   // [-] relative width of an interval that needs no advice
  std::vector<std::string> lines;
  for (const identification::StayResult& stay : stays) {
    const identification::StayFit& fit = stay.fit;
    if (!stay.fitted) continue;
    const bool known = stay.length_m > 0.0;
    const identification::Bounded& force = known ? fit.tension_per_mass : fit.c_Hz;
    std::string line =
        fmt::format("stay {}, {}: {} {:.6g} {} ({:.0f} %: {:.6g} to {:.6g}), harmonics {}, ends hinged {:.2f} clamped {:.2f}",
                    stay.stay, stay.condition, known ? "T/m" : "c", force.value, known ? "m2/s2" : "Hz", 100.0 * level,
                    force.low, force.high, numbers_of(fit.numbering), fit.hinged, fit.clamped);
    if (fit.numbering.probability < kCertain && !fit.others.empty())
      line += fmt::format("; the numbering has probability {:.2f}, {} has {:.2f}", fit.numbering.probability,
                          numbers_of(fit.others.front()), fit.others.front().probability);
    if (force.high - force.low > kNarrow * force.value)
      line += "; more harmonics, or ends and bending_stiffness in [[stay_length]], narrow the interval";
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace twindeck::steps
