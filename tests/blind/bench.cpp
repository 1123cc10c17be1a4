#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "blind/trial.hpp"
#include "diagnosis/files/catalogue_files.hpp"
#include "ponte/generator.hpp"
#include "test_places.hpp"

namespace twindeck::blind {

namespace {

using diagnosis::Condition;
using diagnosis::FeatureSet;
using diagnosis::Row;
using diagnosis::RowType;
using Eigen::Index;

const std::filesystem::path kRoot = TWINDECK_SOURCE_DIR;

/// The bridge on a mesh of its own: bridge.toml with other slab elements.
fe::Model bridge(int along) {
  std::ifstream in(kRoot / "data/ponte_del_mare/bridge.toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string toml = text.str();
  const auto set = [&](const std::string& key, int value) {
    toml = std::regex_replace(toml, std::regex("\n" + key + " *= *[0-9]+"), "\n" + key + " = " + std::to_string(value));
  };
  set("shells_across", 4);
  set("shells_per_panel_along", along);
  set("members_per_panel", 1);
  const auto file = std::filesystem::temp_directory_path() /
                    ("twindeck_blind_" + std::to_string(along) + "_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << toml;
  fe::Model model = ponte::generate(file, "refined");
  std::filesystem::remove(file);
  return model;
}

std::vector<Eigen::Vector3d> positions(const std::vector<diagnosis::Place>& places) {
  std::vector<Eigen::Vector3d> x;
  for (const diagnosis::Place& place : places) x.push_back(place.x_m);
  return x;
}

Side make_side(int along, const std::vector<matching::Channel>& channels, const diagnosis::PlaceOptions& options) {
  Side side;
  side.model = diagnosis::prepare_model(dynamics::from_model(bridge(along)), channels, 0.6);
  const diagnosis::Structure structure = side.model->structure();
  side.places = diagnosis::find_places(structure, options);
  diagnosis::ReductionOptions reduction;
  reduction.modes = 24;
  side.reduced = std::make_unique<diagnosis::ReducedModel>(structure, side.places, reduction);
  return side;
}

/// Permanent points M1 to M8, each upwards and across (global y).
std::vector<matching::Channel> sixteen_channels(const fe::Model& model) {
  std::vector<matching::Channel> channels;
  for (const auto& [name, node] : model.monitoring_points) {
    if (name.size() != 2 || name[0] != 'M') continue;  // the model names other points too
    for (const bool up : {true, false}) {
      matching::Channel channel;
      channel.name = name + (up ? "z" : "y");
      channel.point = name;
      channel.x_m = model.nodes[static_cast<std::size_t>(node)].x_m;
      channel.direction = up ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
      channels.push_back(channel);
    }
  }
  return channels;
}

/// The campaign: states, amplitudes, temperatures, a crowd; deviations as ten-minute records give them.
FeatureSet campaign(const Bench& bench) {
  FeatureSet f;
  for (const matching::Channel& channel : bench.channels) {
    f.channels.push_back(channel.name);
    f.direction.push_back(channel.direction);
  }
  const diagnosis::ReducedModel& model = *bench.diagnosing.reduced;
  const int modes = 8;
  const auto add = [&](const std::string& name, std::optional<bool> dampers, double amplitude, double temperature,
                       double people) {
    Condition c;
    c.name = name;
    c.dampers_on = dampers;
    if (amplitude > 0.0) {
      c.amplitude_m = amplitude;
      c.amplitude_channel = f.channels[4];  // M3 upwards
    }
    if (temperature > -50.0) c.temperature_C = temperature;
    if (people > 0.0) c.people = people;
    f.conditions.push_back(c);
    return static_cast<int>(f.conditions.size()) - 1;
  };
  const auto row = [&](RowType type, int mode, int channel, int condition, double value, double std, bool held) {
    f.rows.push_back({type, mode >= 0 ? std::to_string(mode + 1) : "", channel, "", condition, value, std, held});
  };
  const auto modal = [&](int condition, int count, double f_std, bool damping, int shapes, int imaginary, bool held) {
    for (int m = 0; m < count; ++m) {
      const bool out = held || (m == modes - 1 && count == modes);
      row(RowType::frequency, m, -1, condition, model.frequency_Hz[m], f_std * model.frequency_Hz[m], out);
      if (damping) row(RowType::damping, m, -1, condition, 0.5, 0.1, out);
      if (m >= shapes) continue;
      const Eigen::VectorXd shape = model.sensors.leftCols(model.common) * model.mode_coordinates.col(m);
      double largest = 0.0;
      for (Index c = 0; c < static_cast<Index>(f.channels.size()); ++c) largest = std::max(largest, std::abs(shape[4 * c]));
      for (Index c = 0; c < static_cast<Index>(f.channels.size()); ++c) {
        row(RowType::shape, m, static_cast<int>(c), condition, shape[4 * c] / largest, 0.03, out);
        if (m < imaginary) row(RowType::shape_imag, m, static_cast<int>(c), condition, 0.0, 0.03, out);
      }
    }
  };
  const int off = add("off", false, 0.0003, 15.0, 0.0);
  modal(off, modes, 0.004, true, modes, 3, false);
  for (std::size_t c = 0; c < f.channels.size(); ++c) row(RowType::psd_floor, -1, static_cast<int>(c), off, 1e-8, 1e-9, false);
  // The first frequency of every stay, by a sensor that is carried from one to the next.
  for (const diagnosis::ReducedPlace& stay : model.sets.at("stays"))
    if (const auto f_cable = stay.attributes.find("f_cable"); f_cable != stay.attributes.end())
      f.rows.push_back(
          {RowType::stay_frequency, "1", -1, stay.id.substr(5), off, f_cable->second, 0.01 * f_cable->second, false});
  modal(add("on_small", true, 0.0003, 15.0, 0.0), modes, 0.004, true, 5, 0, false);
  modal(add("on_medium", true, 0.002, 15.0, 0.0), 4, 0.004, true, 0, 0, false);
  modal(add("on_large", true, 0.010, 15.0, 0.0), 4, 0.004, true, 0, 0, true);
  modal(add("release", false, 0.008, 15.0, 0.0), 3, 0.003, true, 0, 0, false);
  modal(add("frost", false, 0.0003, -5.0, 0.0), 6, 0.003, false, 0, 0, false);
  modal(add("warm", false, 0.0003, 25.0, 0.0), 6, 0.003, false, 0, 0, false);
  modal(add("hot", false, 0.0003, 38.0, 0.0), 6, 0.003, false, 0, 0, true);
  modal(add("crowd", false, 0.0003, 15.0, 60.0), 6, 0.003, false, 0, 0, false);
  return f;
}

/// Takes the truth's own predictions as the rows' nominal values, so that labels are those of the truth's modes.
void take_nominal(Bench& bench) {
  for (int pass = 0; pass < 2; ++pass) {
    const diagnosis::FeatureMap map(*bench.truth.reduced, bench.rows, bench.scatter);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Index>(map.nuisances().size()));
    const diagnosis::Prediction p = map.predict(map.base(zero), {}, false);
    for (std::size_t r = 0; r < bench.rows.rows.size(); ++r) {
      Row& row = bench.rows.rows[r];
      const double g = p.g[static_cast<Index>(r)];
      if (row.type == RowType::shape || row.type == RowType::shape_imag) {
        row.value = g;
      } else {
        const double relative = row.std / row.value;
        row.value = row.type == RowType::psd_floor ? 1e-8 : std::exp(g);
        row.std = relative * row.value;
      }
    }
  }
}

}  // namespace

Bench make_bench() {
  Bench bench;
  bench.catalogue = diagnosis::read_catalogue(kRoot / "workflows/common/hypotheses");
  const fe::Model coarse = bridge(2);
  bench.channels = sixteen_channels(coarse);
  diagnosis::PlaceOptions options;
  options.max_zones = 16;
  options.max_nodes = 12;
  bench.diagnosing = make_side(2, bench.channels, options);
  options.zone_centres = positions(bench.diagnosing.places.sets.at("zones"));
  options.node_positions = positions(bench.diagnosing.places.sets.at("nodes"));
  bench.truth = make_side(4, bench.channels, options);
  bench.rows = campaign(bench);
  take_nominal(bench);
  return bench;
}

}  // namespace twindeck::blind
