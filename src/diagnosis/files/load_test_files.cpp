#include "diagnosis/files/load_test_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "diagnosis/reduction/load_test_vectors.hpp"
#include "model_io/load_cases.hpp"

namespace twindeck::diagnosis {

namespace {

std::vector<NodalLoad> loads_in_use(const std::filesystem::path& model, const std::set<std::string>& used) {
  std::vector<NodalLoad> loads;
  for (const model_io::LoadEntry& entry : model_io::read_load_cases(model))
    if (used.contains(entry.load))
      loads.push_back({entry.load, entry.node, entry.direction, entry.value, entry.kind == model_io::LoadEntry::Kind::movement,
                       entry.line});
  return loads;
}

std::vector<Gauge> gauges_of(const DiagnosedModel& model, const Structure& structure, const std::set<int>& used) {
  std::vector<Gauge> gauges;
  for (std::size_t c = 0; c < model.channels.size(); ++c) {
    const matching::Channel& channel = model.channels[c];
    gauges.emplace_back();
    if (!used.contains(static_cast<int>(c))) continue;  // channels without rows of load tests may be anywhere
    gauges.back() = {channel.is_at_a_point() ? structure.sensor_nodes[c] : "",
                     channel.direction,
                     channel.element,
                     channel.xi,
                     channel.fibre_m,
                     channel.support,
                     channel.line};
  }
  return gauges;
}

/// Whether a node has no support, spring or link that the ground could move.
bool stands_on_nothing(const fe::Model& model, const std::string& id) {
  const auto is_it = [&](int node) {
    return node >= 0 && std::to_string(model.nodes[static_cast<std::size_t>(node)].id) == id;
  };
  return std::ranges::none_of(model.supports, [&](const fe::Support& s) { return is_it(s.node); }) &&
         std::ranges::none_of(model.springs, [&](const fe::Spring& s) { return is_it(s.node) || is_it(s.node2); }) &&
         std::ranges::none_of(model.links, [&](const fe::RigidLink& l) { return is_it(l.slave) || is_it(l.master); }) &&
         std::ranges::none_of(model.constraints, [&](const fe::Constraint& c) { return is_it(c.node); });
}

bool has_node(const dynamics::ReadModel& model, const std::string& id) {
  if (const fe::Model* fe = model.fe_model(); fe != nullptr)
    return std::ranges::any_of(fe->nodes, [&](const fe::Node& n) { return std::to_string(n.id) == id; });
  const auto& dofs = model.matrices.dofs;
  return std::ranges::any_of(dofs, [&](const auto& dof) { return dof.node == id; });
}

/// Refuses a row that no load could change: its channel must be mistaken.
void refuse_blind_channels(const LoadTests& tests, const FeatureSet& features, const std::filesystem::path& channels_file) {
  for (const Row& row : features.rows) {
    if (!is_static(row.type) || row.type == RowType::static_force) continue;
    const double most = row.type == RowType::static_displacement
                            ? features.direction[static_cast<std::size_t>(row.channel)].norm()
                        : row.type == RowType::static_rotation ? tests.rotation.row(row.channel).norm()
                                                               : tests.strain.row(row.channel).norm();
    if (most > 0.0) continue;
    const std::string& name = features.channels[static_cast<std::size_t>(row.channel)];
    throw InputError(
        {channels_file.string(), 0, name},
        fmt::format("shows nothing of the model's motion, but row {} of rows.csv is a {} of it", row.line, name_of(row.type)),
        "give its point and dx, dy, dz (of a rotation: the axis), or leave the row out");
  }
}

/// Names of the supports as in step 9: those of supports.csv, and springs to the ground.
std::vector<std::string> support_names(const fe::Model& model) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!contains(names, name)) names.push_back(name);
  };
  for (const fe::Support& s : model.supports)
    add(s.name.empty() ? fmt::format("node_{}", model.nodes[static_cast<std::size_t>(s.node)].id) : s.name);
  for (const fe::Spring& s : model.springs)
    if (s.node2 < 0) add(s.group.empty() ? s.name : s.group);
  return names;
}

/// Load cases and channels of the rows of load tests.
struct InUse {
  std::set<std::string> cases;
  std::set<int> channels;
};

InUse in_use(const FeatureSet& features) {
  InUse used;
  for (const Row& row : features.rows) {
    if (!is_static(row.type)) continue;
    used.cases.insert(features.condition_of(row).load);
    used.channels.insert(row.channel);
  }
  return used;
}

}  // namespace

void refuse_unplaced_load_tests(const FeatureSet& features, const std::vector<matching::Channel>& channels,
                                const dynamics::ReadModel& model, const LoadTestFiles& files) {
  const InUse used = in_use(features);
  if (used.cases.empty()) return;
  const fe::Model* fe = model.fe_model();
  for (const NodalLoad& load : loads_in_use(files.model, used.cases)) {
    const twindeck::Place at{(files.model / "loads.csv").string(), load.line, "node"};
    if (!has_node(model, load.node)) throw no_such_node(at, load.node);
    if (load.ground && fe != nullptr && stands_on_nothing(*fe, load.node))
      throw no_support_to_move(at, load.node, load.direction);
  }
  if (fe == nullptr) return;
  for (const int c : used.channels) {
    const auto channel = std::ranges::find_if(
        channels, [&](const matching::Channel& each) { return each.name == features.channels[static_cast<std::size_t>(c)]; });
    if (channel == channels.end()) continue;
    const auto is_it = [&](const fe::Element& e) {
      return e.name == channel->element || std::to_string(e.id) == channel->element;
    };
    if (!channel->element.empty() && std::ranges::none_of(fe->elements, is_it))
      throw no_such_element({files.channels.string(), channel->line, "element"}, channel->element);
    const std::vector<std::string> known = support_names(*fe);
    const auto is_support = [&](const std::string& name) {
      return name == channel->support || name + " fixed" == channel->support;  // springs may have the name of a support
    };
    if (!channel->support.empty() && std::ranges::none_of(known, is_support))
      throw no_such_support({files.channels.string(), channel->line, "support"}, channel->support, known);
  }
}

LoadTests load_tests_in_use(const DiagnosedModel& model, const Structure& structure, const Places& places,
                            const FeatureSet& features, const LoadTestFiles& files) {
  const auto& [cases, channels] = in_use(features);
  if (cases.empty()) return {};
  const LoadTests tests =
      load_tests_of(structure, places, loads_in_use(files.model, cases), gauges_of(model, structure, channels),
                    (files.model / "loads.csv").string(), files.channels.string());
  refuse_blind_channels(tests, features, files.channels);
  return tests;
}

}  // namespace twindeck::diagnosis
