#include "steps/identification_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "modal/modes.hpp"
#include "model_io/export.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

std::string name_of(std::size_t mode) { return std::to_string(mode + 1); }

// A replicate that happens to agree to the last digit must not give a row of infinite weight.
double at_least(double deviation, double smallest) { return std::max(deviation, smallest); }

modal::ModeSet mode_set(const Conditioned& conditioned, const sysid::Identification& found) {
  modal::ModeSet set;
  const auto n = static_cast<Index>(found.modes.size());
  set.frequency_Hz = set.frequency_std_Hz = set.damping_ratio = set.damping_ratio_std = Eigen::VectorXd(n);
  for (const CampaignChannel& channel : conditioned.channels) set.dofs.push_back({channel.point, channel.name});
  set.shapes.resize(static_cast<Index>(set.dofs.size()), n);
  for (Index i = 0; i < n; ++i) {
    const auto m = static_cast<std::size_t>(i);
    set.names.push_back(name_of(m));
    set.frequency_Hz[i] = found.modes[m].frequency_Hz;
    set.damping_ratio[i] = found.modes[m].damping_ratio;
    set.frequency_std_Hz[i] = found.deviations[m].frequency_Hz;
    set.damping_ratio_std[i] = found.deviations[m].damping_ratio;
    set.shapes.col(i) = found.modes[m].shape;
  }
  return set;
}

}  // namespace

void write_identified_modes(const Conditioned& conditioned, const sysid::Identification& found, const fs::path& folder) {
  TWINDECK_ASSERT(found.deviations.size() == found.modes.size());
  const modal::ModeSet set = mode_set(conditioned, found);
  model_io::write_modes(set, folder);
  io::CsvWriter csv({"mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct", "frequency_scatter_Hz",
                     "damping_ratio_scatter_pct", "orders"});
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    const sysid::Cluster& mode = found.modes[m];
    csv.row({name_of(m), mode.frequency_Hz, found.deviations[m].frequency_Hz, 100.0 * mode.damping_ratio, 100.0 * found.deviations[m].damping_ratio,
             mode.frequency_scatter_Hz, 100.0 * mode.damping_ratio_scatter, mode.members.size()});
  }
  csv.save(folder / "modes.csv");
}

void write_poles(const Conditioned& conditioned, const sysid::Identification& found, const fs::path& folder) {
  io::CsvWriter csv({"setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "mode"});
  for (const sysid::DiagramPole& p : found.diagram) {
    csv.row({conditioned.setup, p.pole.order, p.pole.frequency_Hz, 100.0 * p.pole.damping_ratio, p.stable_frequency ? 1 : 0, p.stable_damping ? 1 : 0,
             p.stable_shape ? 1 : 0, p.mode < 0 ? std::string() : name_of(static_cast<std::size_t>(p.mode))});
  }
  csv.save(folder / "poles.csv");
}

void write_spectra(const Conditioned& conditioned, const signal::PowerSpectra& spectra, const fs::path& folder) {
  io::CsvWriter csv({"channel", "frequency_Hz", "psd_m2_s3"});
  for (std::size_t c = 0; c < conditioned.channels.size(); ++c) {
    for (Index f = 0; f < spectra.frequency_Hz.size(); ++f) {
      csv.row({conditioned.channels[c].name, spectra.frequency_Hz[f], spectra.density(f, static_cast<Index>(c))});
    }
  }
  csv.save(folder / "psd.csv");
}

void write_features(const Campaign& campaign, const Conditioned& conditioned, const sysid::Identification& found, const fs::path& folder) {
  fs::create_directories(folder);
  const std::string& condition = conditioned.condition;
  io::CsvWriter csv({"type", "mode", "channel", "condition", "value", "std"});
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    const sysid::Cluster& mode = found.modes[m];
    const sysid::ModeDeviation& deviation = found.deviations[m];
    const std::string name = name_of(m);
    csv.row({"frequency_Hz", name, "", condition, mode.frequency_Hz, at_least(deviation.frequency_Hz, 1e-9 * mode.frequency_Hz)});
    csv.row({"damping_ratio_pct", name, "", condition, 100.0 * mode.damping_ratio, at_least(100.0 * deviation.damping_ratio, 1e-9)});
    for (std::size_t c = 0; c < conditioned.channels.size(); ++c) {
      const auto i = static_cast<Index>(c);
      const std::string& channel = conditioned.channels[c].name;
      csv.row({"shape", name, channel, condition, mode.shape[i].real(), at_least(deviation.shape_real[i], 1e-6)});
      csv.row({"shape_imag", name, channel, condition, mode.shape[i].imag(), at_least(deviation.shape_imag[i], 1e-6)});
    }
  }
  csv.save(folder / "rows.csv");
  fs::copy_file(campaign.folder / "channels.csv", folder / "channels.csv");
  if (campaign.conditions.empty()) {
    io::write_file_atomically(folder / "conditions.toml", "[" + condition + "]\n");
  } else {
    fs::copy_file(campaign.folder / "conditions.toml", folder / "conditions.toml");
  }
  write_quality(conditioned.quality, folder / "quality.csv");
}

std::vector<std::string> report_lines(const sysid::Identification& found) {
  std::vector<std::string> lines = {fmt::format("{:>4} {:>10} {:>9} {:>9} {:>9} {:>7}", "mode", "f [Hz]", "sigma", "zeta [%]", "sigma", "orders")};
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    lines.push_back(fmt::format("{:>4} {:>10.4f} {:>9.4f} {:>9.3f} {:>9.3f} {:>7}", name_of(m), found.modes[m].frequency_Hz,
                                found.deviations[m].frequency_Hz, 100.0 * found.modes[m].damping_ratio, 100.0 * found.deviations[m].damping_ratio,
                                found.modes[m].members.size()));
  }
  return lines;
}

}  // namespace twindeck::steps
