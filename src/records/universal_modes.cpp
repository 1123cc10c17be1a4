#include "records/universal_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "records/scan_universal.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kTranslations = 3;
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
/// [-] of the largest component of its mode: smaller components are below the six digits of a set's numbers.
constexpr double kStill = 1e-6;

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& mend) {
  throw InputError({file.string(), 0, ""}, problem, mend);
}

/// The modes among the results, ascending.
std::vector<NodalResult> modes_among(const UniversalData& data, const fs::path& file, std::vector<std::string>& notes) {
  std::vector<NodalResult> modes;
  for (const NodalResult& result : data.results) {
    const bool is_mode = (result.analysis == 2 || result.is_complex_mode()) && result.frequency_Hz > 0.0;
    if (is_mode && !result.values.empty()) modes.push_back(result);
  }
  if (modes.empty())
    refuse(file, fmt::format("holds no modes among its {} sets 55", data.results.size()),
           "export mode shapes (sets 2411 and 55) from the program that identified them");
  if (modes.size() < data.results.size())
    notes.push_back(fmt::format("{} sets 55 are no modes with a frequency, left out", data.results.size() - modes.size()));
  std::ranges::stable_sort(modes, {}, &NodalResult::frequency_Hz);
  return modes;
}

/// Nodes of the modes, which are the same in all.
std::vector<long> nodes_of(const std::vector<NodalResult>& modes, const UniversalData& data, const fs::path& file) {
  const auto nodes = each_of(modes.front().values, [](const auto& at) { return at.first; });
  for (const NodalResult& mode : modes) {
    const auto differs = [&, &m = mode](long node) { return !m.values.contains(node); };
    const auto lacking = std::ranges::find_if(nodes, differs);
    if (lacking != nodes.end() || mode.values.size() != nodes.size())
      refuse(file,
             fmt::format("has mode {} at {:.6g} Hz at other nodes than mode {} at {:.6g} Hz", mode.mode, mode.frequency_Hz,
                         modes.front().mode, modes.front().frequency_Hz),
             "export all modes at the same nodes");
    if (const Index per_node = mode.values.begin()->second.size(); per_node < kTranslations)
      refuse(file, fmt::format("has mode {} with {} values a node, expected three or six", mode.mode, per_node),
             "export mode shapes as displacements of three directions");
  }
  for (const long node : nodes) {
    if (!data.nodes.contains(node))
      refuse(file, fmt::format("has shapes at node {}, whose coordinates no set 15 or 2411 gives", node),
             "export the geometry into the same file");
    if (data.axes.at(node) != data.axes.at(nodes.front()))
      refuse(file, fmt::format("has nodes {} and {} in different coordinate systems, which are not read", nodes.front(), node),
             "export geometry and shapes in global coordinates");
  }
  return nodes;
}

struct Motion {
  long node = 0;
  Index axis = 0;
};

/// Translations in which some mode moves by more than that.
std::vector<Motion> measured_motions(const std::vector<NodalResult>& modes, const std::vector<long>& nodes) {
  std::vector<double> least;  // of each mode
  for (const NodalResult& mode : modes) {
    double largest = 0.0;
    for (const auto& [node, values] : mode.values)
      largest = std::max(largest, values.head(kTranslations).cwiseAbs().maxCoeff());
    least.push_back(kStill * largest);
  }
  std::vector<Motion> motions;
  for (const long node : nodes)
    for (Index axis = 0; axis < kTranslations; ++axis) {
      bool moves = false;
      for (std::size_t m = 0; m < modes.size() && !moves; ++m) moves = std::abs(modes[m].values.at(node)[axis]) > least[m];
      if (moves) motions.push_back({node, axis});
    }
  return motions;
}

/// Mode numbers of the file if they are positive and different, else 1, 2, …
std::vector<std::string> names_of(const std::vector<NodalResult>& modes) {
  std::set<int> numbers;
  for (const NodalResult& mode : modes) numbers.insert(mode.mode);
  const bool told_apart = numbers.size() == modes.size() && *numbers.begin() > 0;
  std::vector<std::string> names;
  for (std::size_t m = 0; m < modes.size(); ++m)
    names.push_back(std::to_string(told_apart ? modes[m].mode : static_cast<int>(m) + 1));
  return names;
}

}  // namespace

UniversalModes read_universal_modes(const fs::path& file, double std_pct) {
  RecordInfo info;
  UniversalModes read;
  const UniversalData data = scan_universal_sets(
      file, [](Index, Index, const Eigen::MatrixXd&) {}, info);
  const std::vector<NodalResult> modes = modes_among(data, file, read.notes);
  if (!data.has_units) read.notes.emplace_back("no set 164 (units): coordinates are taken as metres");
  if (modes.front().values.begin()->second.size() > kTranslations)
    read.notes.emplace_back("rotations are left out: no sensor measures them");
  const auto n = std::ssize(modes);
  modal::ModeSet& set = read.modes;
  set.names = names_of(modes);
  set.frequency_Hz = set.damping_ratio = Eigen::VectorXd(n);
  set.damping_ratio_std = Eigen::VectorXd::Constant(n, matching::kUnknown);
  for (Index m = 0; m < n; ++m) {
    const NodalResult& mode = modes[static_cast<std::size_t>(m)];
    set.frequency_Hz[m] = mode.frequency_Hz;
    set.damping_ratio[m] = mode.damping_ratio > 0.0 && mode.damping_ratio < 1.0 ? mode.damping_ratio : matching::kUnknown;
  }
  set.frequency_std_Hz =
      std_pct > 0.0 ? Eigen::VectorXd(std_pct / 100.0 * set.frequency_Hz) : Eigen::VectorXd::Constant(n, matching::kUnknown);
  const std::vector<Motion> motions = measured_motions(modes, nodes_of(modes, data, file));
  set.shapes.resize(std::ssize(motions), n);
  for (const auto& [node, axis] : motions) {
    matching::Channel channel;
    channel.point = std::to_string(node);
    channel.name = channel.point + "_" + kAxes[static_cast<std::size_t>(axis)];
    channel.x_m = data.nodes.at(node);
    channel.direction = Eigen::Vector3d::Unit(axis);
    for (Index m = 0; m < n; ++m)
      set.shapes(std::ssize(read.channels), m) = modes[static_cast<std::size_t>(m)].values.at(node)[axis];
    set.dofs.push_back({channel.point, channel.name});
    read.channels.push_back(channel);
  }
  if (read.channels.empty()) refuse(file, "has shapes that are zero everywhere", "export the mode shapes again");
  return read;
}

void write_channels(const std::vector<matching::Channel>& channels, const fs::path& file) {
  io::CsvWriter writer({"channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz"});
  for (const matching::Channel& channel : channels) {
    const Eigen::Vector3d x = channel.x_m.value_or(Eigen::Vector3d::Constant(matching::kUnknown));
    const auto known = [&](Index k) { return channel.x_m ? std::optional<double>(x[k]) : std::nullopt; };
    writer.row({channel.name, channel.point, known(0), known(1), known(2), channel.direction[0], channel.direction[1],
                channel.direction[2]});
  }
  writer.save(file);
}

}  // namespace twindeck::records
