#include "steps/campaign/campaign_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/lists.hpp"
#include "io/atomic.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

/// Setups that records of the decks use, in the order of the layout.
std::vector<std::string> used_setups(const ponte::CampaignSettings& settings,
                                     const std::vector<sensors::LayoutChannel>& layout) {
  std::vector<std::string> used;
  for (const std::string& name : sensors::setup_names(layout))
    if (std::ranges::any_of(settings.records, [&](const ponte::RecordSettings& r) { return r.setup == name; }))
      used.push_back(name);
  return used;
}

/// Channels that more than one setup has: they stay in position while the others move.
std::set<std::string> references(const std::vector<sensors::LayoutChannel>& layout, const std::vector<std::string>& used) {
  std::map<std::string, int> count;
  for (const std::string& setup : used)
    for (const sensors::LayoutChannel& channel : sensors::channels_of(layout, setup)) ++count[channel.channel];
  int most = 1;
  for (const auto& [name, times] : count) most = std::max(most, times);
  std::set<std::string> out;
  for (const auto& [name, times] : count)
    if (most > 1 && times == most) out.insert(name);
  return out;
}

void write_channels(const ponte::CampaignSettings& settings, const std::vector<sensors::LayoutChannel>& layout,
                    const std::vector<ponte::StayRecord>& stays, const fs::path& file) {
  io::CsvWriter csv(
      {"channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"});
  const std::vector<std::string> used = used_setups(settings, layout);
  const std::set<std::string> fixed = references(layout, used);
  std::set<std::string> written;
  const auto row = [&](const std::string& name, const std::string& point, const Eigen::Vector3d& x, const Eigen::Vector3d& d) {
    if (!written.insert(name).second) return;
    csv.row({name, point, x.x(), x.y(), x.z(), d.x(), d.y(), d.z(), "acceleration", "m/s^2", 1, fixed.contains(name) ? 1 : 0,
             "response"});
  };
  for (const std::string& setup : used)
    for (const sensors::LayoutChannel& c : sensors::channels_of(layout, setup)) row(c.channel, c.point, c.x_m, c.cosines);
  for (std::size_t i = 0; i < stays.size(); ++i)
    row(settings.stays[i].stay, settings.stays[i].stay, stays[i].x_m, stays[i].direction);
  csv.save(file);
}

std::string quoted(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "\"" : ", \"") + name + "\"";
  return "[" + out + "]";
}

}  // namespace

std::vector<RecordFile> record_files(const ponte::CampaignSettings& settings,
                                     const std::vector<sensors::LayoutChannel>& layout) {
  std::vector<RecordFile> files;
  std::map<std::string, int> count;
  const auto add = [&](const std::string& setup, const std::string& kind, const std::string& condition,
                       std::vector<std::string> channels) {
    const std::string stem = fmt::format("records/{}/{}_{}", setup, condition, kind);
    files.push_back({setup, kind, condition, fmt::format("{}_{}.npy", stem, ++count[stem]), std::move(channels)});
  };
  for (const ponte::RecordSettings& record : settings.records) {
    (void)settings.condition(record.condition);
    add(record.setup, record.kind, record.condition,
        each_of(sensors::channels_of(layout, record.setup), &sensors::LayoutChannel::channel));
  }
  for (const ponte::StayTest& test : settings.stays) add(test.stay, "stay", test.condition, {test.stay});
  return files;
}

void write_campaign_files(const ponte::CampaignSettings& settings, const std::vector<sensors::LayoutChannel>& layout,
                          const std::vector<ponte::StayRecord>& stays, const std::vector<RecordFile>& files,
                          const std::map<std::string, Amplitude>& amplitudes, const fs::path& folder) {
  write_channels(settings, layout, stays, folder / "channels.csv");

  std::string campaign = "# Virtual test campaign: records as the loggers wrote them.\n";
  for (const RecordFile& f : files)
    campaign += fmt::format(
        "\n[[record]]\nsetup = \"{}\"\nkind = \"{}\"\nfile = \"{}\"\nsampling_rate_Hz = {}\nchannels = {}\ncondition = "
        "\"{}\"\n",
        f.setup, f.kind, f.file, io::format_number(settings.rate_Hz), quoted(f.channels), f.condition);
  io::write_file_atomically(folder / "campaign.toml", campaign);

  std::string conditions;
  for (const ponte::ConditionSettings& c : settings.conditions) {
    conditions += fmt::format("{}[{}]\ndampers = \"{}\"\n", conditions.empty() ? "" : "\n", c.name, c.dampers ? "on" : "off");
    if (const auto amplitude = amplitudes.find(c.name); amplitude != amplitudes.end())
      conditions += fmt::format("amplitude_m = {}\namplitude_channel = \"{}\"\n", io::format_number(amplitude->second.rms_m),
                                amplitude->second.channel);
    conditions += fmt::format("temperature_C = {}\nwind_m_s = {}\npeople = {}\n", io::format_number(c.temperature_C),
                              io::format_number(c.wind_m_s), c.people);
  }
  std::set<std::string> of_stays;
  for (const ponte::StayTest& test : settings.stays) {
    const bool known = std::ranges::any_of(settings.conditions, [&](const auto& c) { return c.name == test.condition; });
    if (!known && of_stays.insert(test.condition).second) conditions += fmt::format("\n[{}]\n", test.condition);
  }
  io::write_file_atomically(folder / "conditions.toml", conditions);
}

TruthTables::TruthTables()
    : modes_({"condition", "mode", "frequency_Hz", "damping_ratio_pct", "stay_share"}),
      participation_({"condition", "setup", "frequency_Hz", "participation"}),
      shapes_({"condition", "mode", "channel", "value", "value_imag"}),
      dampers_({"condition", "damper", "rms_force_N", "sliding_pct", "equivalent_slip_m_per_N_s"}) {}

void TruthTables::add(const std::string& condition, const ponte::CampaignSettings& settings, const ponte::ConditionModel& model,
                      const ponte::TrueModes& modes, const std::vector<sensors::LayoutChannel>& layout,
                      const Eigen::MatrixXd& damper_force_N) {
  for (Index i = 0; i < modes.frequency_Hz.size(); ++i)
    modes_.row({condition, modes.name[static_cast<std::size_t>(i)], modes.frequency_Hz[i], 100.0 * modes.damping_ratio[i],
                modes.stay_share[i]});
  std::set<std::string> seen;
  for (const std::string& setup : used_setups(settings, layout)) {
    const auto channels = sensors::channels_of(layout, setup);
    const Eigen::MatrixXd at = at_channels(*model.state, model.basis.vectors, channels);
    const Eigen::VectorXd share = participation(model, modes, at);
    for (Index i = 0; i < share.size(); ++i) participation_.row({condition, setup, modes.frequency_Hz[i], share[i]});
    const Eigen::MatrixXcd shapes = at * modes.shapes;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (!seen.insert(channels[c].channel).second) continue;
      for (Index i = 0; i < shapes.cols(); ++i) {
        const std::string& name = modes.name[static_cast<std::size_t>(i)];
        const std::complex<double> value = shapes(static_cast<Index>(c), i);
        if (!name.empty()) shapes_.row({condition, name, channels[c].channel, value.real(), value.imag()});
      }
    }
  }
  for (std::size_t d = 0; d < model.dampers.size(); ++d) {
    const auto force = damper_force_N.col(static_cast<Index>(d)).array();
    const double n = static_cast<double>(force.size());
    const double sliding = static_cast<double>((force.abs() > model.dampers[d].friction_N).count());
    dampers_.row({condition, model.damper_names[d], std::sqrt(force.square().sum() / n), 100.0 * sliding / n,
                  modes.slip[static_cast<Index>(d)]});
  }
}

void TruthTables::save(const ponte::CampaignSettings& settings, const std::vector<ponte::StayRecord>& stays,
                       const fs::path& folder) const {
  fs::create_directories(folder);
  modes_.save(folder / "modes.csv");
  participation_.save(folder / "participation.csv");
  shapes_.save(folder / "shapes.csv");
  dampers_.save(folder / "dampers.csv");
  io::CsvWriter csv({"condition", "stay", "length_m", "f1_Hz", "f2_Hz", "f3_Hz", "f4_Hz", "f5_Hz", "damping_ratio_pct",
                     "pull_per_mass_m2_s2", "lambda_squared"});
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const ponte::StayTruth& t = stays[i].truth;
    const auto f = [&](Index k) { return t.frequency_Hz[k]; };
    const std::optional<double> none;
    csv.row({settings.stays[i].condition, settings.stays[i].stay, t.length_m, f(0), f(1), f(2), f(3), f(4),
             100.0 * settings.stays[i].damping_ratio, t.is_string ? std::optional<double>(t.pull_per_mass_m2_s2) : none,
             t.is_string ? std::optional<double>(t.lambda_squared) : none});
  }
  csv.save(folder / "stays.csv");
}

}  // namespace twindeck::steps
