#include "steps/measured/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "matching/mode_name.hpp"
#include "model_io/export.hpp"
#include "steps/measured/feature_rows.hpp"
#include "steps/measured/measured_choice.hpp"
#include "steps/measured/measured_tables.hpp"
#include "steps/shared/study.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

std::vector<std::string> names_of(const std::vector<Channel>& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

/// What rows.csv says of one mode.
struct MeasuredMode {
  std::size_t row = 0;
  double frequency = kUnknown, frequency_std = kUnknown, damping = kUnknown, damping_std = kUnknown;
  std::map<std::string, std::complex<double>> shape;  // by channel
};

/// Enters one row into the mode that it belongs to.
void enter(const FeatureRow& row, MeasuredMode& mode) {
  if (row.type == "frequency_Hz") {
    mode.frequency = row.value;
    mode.frequency_std = row.std;
  } else if (row.type == "damping_ratio_pct") {
    mode.damping = row.value / 100.0;
    mode.damping_std = row.std / 100.0;
  } else {
    mode.shape[row.channel] +=
        row.type == "shape" ? std::complex<double>(row.value, 0.0) : std::complex<double>(0.0, row.value);
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
    measured.labels.push_back(matching::experimental_label(name));
    modes.frequency_Hz[i] = mode.frequency;
    modes.frequency_std_Hz[i] = mode.frequency_std;
    modes.damping_ratio[i] = mode.damping;
    modes.damping_ratio_std[i] = mode.damping_std;
    if (!used.empty() && mode.shape.empty())
      table.fail(mode.row, "mode", fmt::format("mode {} has no shape, which other modes have", name),
                 "give its shape at some channels");
    for (std::size_t c = 0; c < used.size(); ++c) {
      const auto at = mode.shape.find(used[c]->name);
      // A channel that this mode lacks is missing, not zero: MACs leave it out.
      modes.shapes(static_cast<Index>(c), i) = at == mode.shape.end() ? std::complex<double>(kUnknown, 0.0) : at->second;
    }
  }
  measured.channels = std::move(channels);
  return measured;
}

/// Rows that were entered into modes, with their covariance.
void take_rows(const FeatureRows& read, const std::vector<std::size_t>& entered, Measured& measured) {
  std::vector<Index> at;
  for (const std::size_t r : entered) {
    const FeatureRow& row = read.rows[r];
    if (row.type == "damping_ratio_pct") continue;
    const auto& names = measured.modes.names;
    MeasuredRow& taken = measured.rows.emplace_back();
    taken.mode = std::find(names.begin(), names.end(), row.mode) - names.begin();
    taken.imaginary = row.type == "shape_imag";
    taken.value = row.value;
    if (row.is_shape()) {
      const auto& dofs = measured.modes.dofs;
      taken.dof =
          std::find_if(dofs.begin(), dofs.end(), [&](const auto& dof) { return dof.direction == row.channel; }) - dofs.begin();
    }
    at.push_back(static_cast<Index>(r));
  }
  if (read.covariance.size() > 0) {
    measured.covariance = read.covariance(at, at);
    return;
  }
  measured.covariance = Eigen::MatrixXd::Zero(std::ssize(at), std::ssize(at));
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double std = read.rows[static_cast<std::size_t>(at[i])].std;
    measured.covariance(static_cast<Index>(i), static_cast<Index>(i)) = std * std;
  }
}

}  // namespace

Measured read_measured_features(const std::filesystem::path& folder, const MeasuredChoice& choice) {
  const std::filesystem::path conditions_file = folder / "conditions.toml";
  const std::vector<MeasuredCondition> conditions = read_conditions(conditions_file);
  const std::string chosen = choose_condition(conditions_file, conditions, choice.conditions);
  std::vector<Channel> channels;
  if (std::filesystem::exists(folder / "channels.csv")) channels = read_channels(folder / "channels.csv");
  FeatureRows read = read_feature_rows(folder, conditions, channels);
  refuse_unknown_channels(choice.corrections, names_of(channels), (folder / "channels.csv").string());
  correct(choice.corrections, read);

  std::map<std::string, MeasuredMode> found;
  std::vector<std::string> names;
  std::vector<std::size_t> entered;
  for (std::size_t at = 0; at < read.rows.size(); ++at) {
    const FeatureRow& row = read.rows[at];
    if (!row.is_modal() || row.condition != chosen || row.held_out) continue;
    const auto [mode, is_new] = found.try_emplace(row.mode);
    if (is_new) {
      mode->second.row = at;
      names.push_back(row.mode);
    }
    enter(row, mode->second);
    entered.push_back(at);
  }
  if (names.empty()) {
    throw InputError({(folder / "rows.csv").string(), 0, ""}, fmt::format("has no modes of condition '{}'", chosen),
                     "check the column `condition`, or take another condition (--condition)");
  }
  Measured measured = assemble_measured(read.table, names, found, std::move(channels));
  take_rows(read, entered, measured);
  measured.source = folder.string();
  return measured;
}

Measured read_measured_modes(const std::filesystem::path& folder, const MeasuredChoice& choice) {
  Measured measured;
  measured.source = folder.string();
  std::vector<long> lines;
  measured.modes = model_io::read_modes(folder, &lines);
  for (Index i = 0; i < measured.modes.size(); ++i) {
    const std::string& name = measured.modes.names[static_cast<std::size_t>(i)];
    if (!(measured.modes.frequency_std_Hz[i] > 0.0)) {
      throw InputError({(folder / "modes.csv").string(), lines[static_cast<std::size_t>(i)], "frequency_std_Hz"},
                       fmt::format("mode {} has no standard deviation", name),
                       "state it; a frequency without one can't be weighed");
    }
    if (!(measured.modes.frequency_Hz[i] > 0.0)) {
      throw InputError({(folder / "modes.csv").string(), lines[static_cast<std::size_t>(i)], "frequency_Hz"},
                       fmt::format("mode {} has no frequency above 0 Hz", name), "");
    }
    measured.labels.push_back(matching::experimental_label(name));
    measured.rows.push_back({i, -1, false, measured.modes.frequency_Hz[i]});
  }
  measured.covariance = measured.modes.frequency_std_Hz.cwiseAbs2().asDiagonal();
  if (std::filesystem::exists(folder / "channels.csv")) measured.channels = read_channels(folder / "channels.csv");
  correct(choice.corrections, measured.modes, (folder / "shapes.csv").string());
  return measured;
}

namespace {

/// Comparing and updating go by modes: that rows of load tests were left is said.
void warn_of_load_tests(const std::filesystem::path& folder, StepContext& context) {
  const auto table = io::CsvTable::read(folder / "rows.csv", {"type"}, {}, true);
  int count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) count += table.text(row, "type").starts_with("static_") ? 1 : 0;
  if (count > 0) context.warn(fmt::format("{} rows of load tests are not used here: s9_diagnosis compares them", count));
}

}  // namespace

std::optional<Measured> find_measured(StepContext& context, const std::string& condition) {
  if (context.modes) {
    for (const char* flag : {"condition", "state"}) {
      if (context.has_flag(flag))
        throw InputError({"command line", 0, std::string("--") + flag},
                         "does not go with --modes: modes.csv knows no conditions", "leave it out, or give --features");
    }
    return read_measured_modes(context.input(*context.modes), asked_choice(context));
  }
  std::filesystem::path folder;
  if (context.features)
    folder = *context.features;
  else if (!context.study.empty())
    folder = read_study(context.study).features;
  const MeasuredChoice choice = asked_choice(context, condition);
  if (!folder.empty()) {
    Measured measured = read_measured_features(context.input(folder), choice);
    warn_of_load_tests(folder, context);
    return measured;
  }
  for (const Flag& flag : measured_flags()) {
    if (context.has_flag(flag.name))
      throw InputError({"command line", 0, "--" + flag.name}, "is given, but no measured modes are",
                       "give --features DIR or --modes DIR");
  }
  return std::nullopt;
}

std::vector<MeasuredFrequencies> frequencies_of(const std::optional<Measured>& measured) {
  if (!measured) return {};
  return {{measured->modes.names, measured->modes.frequency_Hz}};
}

}  // namespace twindeck::steps
