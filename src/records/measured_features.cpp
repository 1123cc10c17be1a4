#include "records/measured_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "io/spreadsheet.hpp"
#include "matching/mode_name.hpp"
#include "records/feature_rows.hpp"

namespace twindeck::records {

namespace {

using Eigen::Index;

struct MeasuredMode {
  std::size_t row = 0;
  double frequency = matching::kUnknown, frequency_std = matching::kUnknown, damping = matching::kUnknown,
         damping_std = matching::kUnknown;
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

matching::Measured assemble_measured(const io::CsvTable& table, const std::vector<std::string>& names,
                                     std::map<std::string, MeasuredMode>& found, std::vector<matching::Channel> channels) {
  matching::Measured measured;
  std::vector<std::string> order = names;
  for (const std::string& name : order)
    if (std::isnan(found.at(name).frequency))
      table.fail(found.at(name).row, "mode", fmt::format("mode {} has no row of type frequency_Hz", name),
                 "add its frequency, or remove its other rows");
  std::ranges::stable_sort(order, [&](const auto& a, const auto& b) { return found.at(a).frequency < found.at(b).frequency; });
  const auto n = std::ssize(order);
  modal::ModeSet& modes = measured.modes;
  modes.frequency_Hz = modes.frequency_std_Hz = modes.damping_ratio = modes.damping_ratio_std = Eigen::VectorXd(n);
  std::vector<const matching::Channel*> used;
  for (const matching::Channel& channel : channels)
    if (std::ranges::any_of(found, [&](const auto& mode) { return mode.second.shape.contains(channel.name); }))
      used.push_back(&channel);
  for (const matching::Channel* channel : used)
    modes.dofs.push_back({channel->point.empty() ? channel->name : channel->point, channel->name});
  modes.shapes.resize(std::ssize(used), n);
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
      // A channel without a value for this mode is unknown, not zero: MACs leave it out.
      modes.shapes(static_cast<Index>(c), i) =
          at == mode.shape.end() ? std::complex<double>(matching::kUnknown, 0.0) : at->second;
    }
  }
  measured.channels = std::move(channels);
  return measured;
}

/// Rows that were entered into modes, with their covariance.
void take_rows(const FeatureRows& read, const std::vector<std::size_t>& entered, matching::Measured& measured) {
  std::vector<Index> at;
  for (const std::size_t r : entered) {
    const FeatureRow& row = read.rows[r];
    if (row.type == "damping_ratio_pct") continue;
    const auto& names = measured.modes.names;
    matching::MeasuredRow& taken = measured.rows.emplace_back();
    taken.mode = std::ranges::find(names, row.mode) - names.begin();
    taken.imaginary = row.type == "shape_imag";
    taken.value = row.value;
    if (row.is_shape()) {
      const auto& dofs = measured.modes.dofs;
      taken.dof = std::ranges::find(dofs, row.channel, &modal::ShapeDof::direction) - dofs.begin();
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

matching::Measured read_measured_features(const std::filesystem::path& folder, const MeasuredChoice& choice) {
  const std::filesystem::path conditions_file = folder / "conditions.toml";
  const std::vector<MeasuredCondition> conditions = read_conditions(conditions_file);
  const std::string chosen = choose_condition(conditions_file, conditions, choice.conditions);
  std::vector<matching::Channel> channels;
  if (io::has_table(folder / "channels.csv")) channels = read_channels(folder / "channels.csv");
  FeatureRows read = read_feature_rows(folder, conditions, channels);
  refuse_unknown_channels(choice.corrections, each_of(channels, &matching::Channel::name), (folder / "channels.csv").string());
  correct(choice.corrections, conditions, read);

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
  if (names.empty())
    throw InputError({(folder / "rows.csv").string(), 0, ""}, fmt::format("has no modes of condition '{}'", chosen),
                     "check the column `condition`, or take another condition (--condition)");
  matching::Measured measured = assemble_measured(read.table, names, found, std::move(channels));
  take_rows(read, entered, measured);
  measured.source = folder.string();
  return measured;
}

}  // namespace twindeck::records
