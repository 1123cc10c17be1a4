#include "steps/shared/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "modal/pair_name.hpp"
#include "model_io/export.hpp"
#include "steps/shared/measured_tables.hpp"
#include "steps/shared/study.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

/// What rows.csv says of one mode.
struct MeasuredMode {
  std::size_t row = 0;
  double frequency = kUnknown, frequency_std = kUnknown, damping = kUnknown, damping_std = kUnknown;
  std::map<std::string, std::complex<double>> shape;  // by channel
};

const std::vector<std::string> kTypes = {"frequency_Hz",      "damping_ratio_pct", "shape",           "shape_imag",
                                         "stay_frequency_Hz", "rms_m_s2",          "psd_floor_m2_s3", "static_m"};

/// Enters one row into the mode that it belongs to.
void enter(const io::CsvTable& table, std::size_t row, const std::vector<Channel>& channels, MeasuredMode& mode) {
  const std::string type = table.text(row, "type");
  const double value = table.number(row, "value");
  const auto once = [&](double& target, double number) {
    if (!std::isnan(target))
      table.fail(row, "type", fmt::format("{} of this mode stands twice", type), "remove one of the two rows");
    target = number;
  };
  if (type == "frequency_Hz") {
    if (value <= 0.0) table.fail(row, "value", fmt::format("is {}, expected a frequency above 0 Hz", value));
    once(mode.frequency, value);
    mode.frequency_std = table.number(row, "std");
  } else if (type == "damping_ratio_pct") {
    once(mode.damping, value / 100.0);
    mode.damping_std = table.number(row, "std") / 100.0;
  } else {
    const std::string channel = table.text(row, "channel");
    std::vector<std::string> names;
    for (const Channel& known : channels) names.push_back(known.name);
    if (std::find(names.begin(), names.end(), channel) == names.end()) {
      table.fail(row, "channel", fmt::format("channel '{}' is not in channels.csv{}", channel, did_you_mean(channel, names)),
                 "add the channel there");
    }
    mode.shape[channel] += type == "shape" ? std::complex<double>(value, 0.0) : std::complex<double>(0.0, value);
  }
}

Measured assemble_measured(const io::CsvTable& table, const std::vector<std::string>& names,
                           std::map<std::string, MeasuredMode>& found, std::vector<Channel> channels) {
  Measured measured;
  std::vector<std::string> order = names;
  for (const std::string& name : order) {
    if (std::isnan(found.at(name).frequency)) {
      table.fail(found.at(name).row, "mode", fmt::format("mode {} has no row of type frequency_Hz", name),
                 "add its frequency, or remove its other rows");
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto& a, const auto& b) { return found.at(a).frequency < found.at(b).frequency; });
  const auto n = static_cast<Index>(order.size());
  modal::ModeSet& modes = measured.modes;
  modes.frequency_Hz = modes.frequency_std_Hz = modes.damping_ratio = modes.damping_ratio_std = Eigen::VectorXd(n);
  std::vector<const Channel*> used;
  for (const Channel& channel : channels) {
    if (std::any_of(found.begin(), found.end(), [&](const auto& mode) { return mode.second.shape.contains(channel.name); }))
      used.push_back(&channel);
  }
  for (const Channel* channel : used)
    modes.dofs.push_back({channel->point.empty() ? channel->name : channel->point, channel->name});
  modes.shapes.resize(static_cast<Index>(used.size()), n);
  for (Index i = 0; i < n; ++i) {
    const std::string& name = order[static_cast<std::size_t>(i)];
    const MeasuredMode& mode = found.at(name);
    modes.names.push_back(name);
    measured.labels.push_back(modal::experimental_label(name));
    modes.frequency_Hz[i] = mode.frequency;
    modes.frequency_std_Hz[i] = mode.frequency_std;
    modes.damping_ratio[i] = mode.damping;
    modes.damping_ratio_std[i] = mode.damping_std;
    if (!used.empty() && mode.shape.empty())
      table.fail(mode.row, "mode", fmt::format("mode {} has no shape, which other modes have", name), "give its shape at some channels");
    for (std::size_t c = 0; c < used.size(); ++c) {
      const auto at = mode.shape.find(used[c]->name);
      // A channel that this mode lacks is missing, not zero: MACs leave it out.
      modes.shapes(static_cast<Index>(c), i) = at == mode.shape.end() ? std::complex<double>(kUnknown, 0.0) : at->second;
    }
  }
  measured.channels = std::move(channels);
  return measured;
}

}  // namespace

Measured read_measured_features(const std::filesystem::path& folder, const std::string& condition) {
  const std::string chosen = choose_condition(folder / "conditions.toml", condition);
  const auto table =
      io::CsvTable::read(folder / "rows.csv", {"type", "mode", "channel", "condition", "value", "std"}, {"held_out"});
  std::vector<Channel> channels;
  if (std::filesystem::exists(folder / "channels.csv")) channels = read_channels(folder / "channels.csv");

  std::map<std::string, MeasuredMode> found;
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string type = table.text(row, "type");
    if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
      table.fail(row, "type", fmt::format("'{}' is not a known type of row{}", type, did_you_mean(type, kTypes)));
    }
    const std::optional<double> deviation = table.number_if(row, "std");
    if (!deviation || *deviation <= 0.0) {
      table.fail(row, "std", deviation ? fmt::format("is {}, expected a value above 0", *deviation) : "is empty",
                 "state the standard deviation of the value; a row without one can't be weighed");
    }
    const bool of_modes = type == "frequency_Hz" || type == "damping_ratio_pct" || type == "shape" || type == "shape_imag";
    if (!of_modes || table.text(row, "condition") != chosen || table.number_or(row, "held_out", 0.0) != 0.0) continue;
    const std::string mode = table.text(row, "mode");
    if (mode.empty()) table.fail(row, "mode", "is empty", "name the mode that the row belongs to");
    const auto [at, is_new] = found.try_emplace(mode);
    if (is_new) {
      at->second.row = row;
      names.push_back(mode);
    }
    enter(table, row, channels, at->second);
  }
  if (names.empty()) {
    throw InputError({(folder / "rows.csv").string(), 0, ""}, fmt::format("has no modes of condition '{}'", chosen),
                     "check the column `condition`, or the key `condition` of the step");
  }
  Measured measured = assemble_measured(table, names, found, std::move(channels));
  measured.source = folder.string();
  return measured;
}

Measured read_measured_modes(const std::filesystem::path& folder) {
  Measured measured;
  measured.source = folder.string();
  measured.modes = model_io::read_modes(folder);
  for (Index i = 0; i < measured.modes.size(); ++i) {
    const std::string& name = measured.modes.names[static_cast<std::size_t>(i)];
    if (!(measured.modes.frequency_std_Hz[i] > 0.0)) {
      throw InputError({(folder / "modes.csv").string(), i + 2, "frequency_std_Hz"},
                       fmt::format("mode {} has no standard deviation", name),
                       "state it; a frequency without one can't be weighed");
    }
    if (!(measured.modes.frequency_Hz[i] > 0.0)) {
      throw InputError({(folder / "modes.csv").string(), i + 2, "frequency_Hz"},
                       fmt::format("mode {} has no frequency above 0 Hz", name), "");
    }
    measured.labels.push_back(modal::experimental_label(name));
  }
  if (std::filesystem::exists(folder / "channels.csv")) measured.channels = read_channels(folder / "channels.csv");
  return measured;
}

std::optional<Measured> find_measured(StepContext& context, const std::string& condition) {
  if (context.modes) return read_measured_modes(context.input(*context.modes));
  if (context.features) return read_measured_features(context.input(*context.features), condition);
  if (context.study.empty()) return std::nullopt;
  const Study study = read_study(context.study);
  if (study.features.empty()) return std::nullopt;
  return read_measured_features(context.input(study.features), condition);
}

}  // namespace twindeck::steps
