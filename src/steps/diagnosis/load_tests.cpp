#include "steps/diagnosis/load_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "diagnosis/load_test_vectors.hpp"
#include "model_io/load_cases.hpp"

namespace twindeck::steps {

namespace {

using diagnosis::Row;

std::vector<diagnosis::NodalLoad> loads_in_use(const std::filesystem::path& model, const std::set<std::string>& used) {
  std::vector<diagnosis::NodalLoad> loads;
  for (const model_io::LoadEntry& entry : model_io::read_load_cases(model))
    if (used.contains(entry.load))
      loads.push_back({entry.load, entry.node, entry.direction, entry.value, entry.kind == model_io::LoadEntry::Kind::movement,
                       entry.line});
  return loads;
}

std::vector<diagnosis::Gauge> gauges_of(const DiagnosedModel& model, const diagnosis::Structure& structure,
                                        const std::set<int>& used) {
  std::vector<diagnosis::Gauge> gauges;
  for (std::size_t c = 0; c < model.channels.size(); ++c) {
    const Channel& channel = model.channels[c];
    gauges.emplace_back();
    if (!used.contains(static_cast<int>(c))) continue;  // what no row is of may sit anywhere
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

/// A row that no load could change says that its channel was mistaken.
void refuse_blind_channels(const diagnosis::LoadTests& tests, const diagnosis::FeatureSet& features,
                           const std::filesystem::path& channels_file) {
  for (const Row& row : features.rows) {
    if (!is_static(row.type) || row.type == diagnosis::RowType::static_force) continue;
    const double most = row.type == diagnosis::RowType::static_displacement
                            ? features.direction[static_cast<std::size_t>(row.channel)].norm()
                        : row.type == diagnosis::RowType::static_rotation ? tests.rotation.row(row.channel).norm()
                                                                          : tests.strain.row(row.channel).norm();
    if (most > 0.0) continue;
    const std::string& name = features.channels[static_cast<std::size_t>(row.channel)];
    throw InputError(
        {channels_file.string(), 0, name},
        fmt::format("shows nothing of the model's motion, but row {} of rows.csv is a {} of it", row.line, name_of(row.type)),
        "give its point and dx, dy, dz (of a rotation: the axis), or leave the row out");
  }
}

}  // namespace

diagnosis::LoadTests load_tests_in_use(const DiagnosedModel& model, const diagnosis::Structure& structure,
                                       const diagnosis::Places& places, const diagnosis::FeatureSet& features,
                                       const LoadTestFiles& files) {
  std::set<std::string> cases;
  std::set<int> channels;
  for (const Row& row : features.rows) {
    if (!is_static(row.type)) continue;
    cases.insert(features.conditions[static_cast<std::size_t>(row.condition)].load);
    channels.insert(row.channel);
  }
  if (cases.empty()) return {};
  const diagnosis::LoadTests tests =
      diagnosis::load_tests_of(structure, places, loads_in_use(files.model, cases), gauges_of(model, structure, channels),
                               (files.model / "loads.csv").string(), files.channels.string());
  refuse_blind_channels(tests, features, files.channels);
  return tests;
}

}  // namespace twindeck::steps
