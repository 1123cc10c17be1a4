/// Fits the bridge's unknown sizes to printed frequencies within ranges of engineering sense (data/<study>/calibration.toml),
/// and writes them into bridge.toml on request.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "io/csv.hpp"
#include "steps/calibration/calibration.hpp"
#include "steps/shared/run_step_threads.hpp"

namespace {

using namespace twindeck;

constexpr double kEdge = 1e-3;  ///< part of a range within which a value counts as on its edge

const char* edge_of(double part) { return part < kEdge ? "lower" : part > 1.0 - kEdge ? "upper" : ""; }

void write_values(const steps::Calibration& calibration, const steps::CalibrationResult& result,
                  const std::filesystem::path& file) {
  io::CsvWriter csv({"value", "unit", "untuned", "lower", "upper", "fitted", "edge", "reason"});
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const steps::CalibrationValue& value = calibration.values[v];
    const double part = result.part[static_cast<Eigen::Index>(v)];
    csv.row({value.name, value.unit, value.start, value.lower, value.upper, value.at(part), edge_of(part), value.reason});
  }
  csv.save(file);
}

void write_frequencies(const steps::Calibration& calibration, const steps::CalibrationResult& result,
                       const std::filesystem::path& file) {
  io::CsvWriter csv(
      {"variant", "source", "mode", "printed_Hz", "untuned_Hz", "untuned_error_pct", "fitted_Hz", "fitted_error_pct"});
  Eigen::Index row = 0;
  for (const steps::CalibrationTarget& target : calibration.targets) {
    for (std::size_t i = 0; i < target.modes.size(); ++i, ++row) {
      const double printed = target.frequency_Hz[i];
      csv.row({target.variant, target.source, static_cast<long>(target.modes[i]), printed, result.untuned[row],
               100 * (result.untuned[row] / printed - 1), result.fitted[row], 100 * (result.fitted[row] / printed - 1)});
    }
  }
  csv.save(file);
}

/// The values as bridge.toml has them now, as parts of their ranges: where a fit that is continued begins.
Eigen::VectorXd parts_in(const std::filesystem::path& file, const steps::Calibration& calibration) {
  const io::CsvTable table =
      io::CsvTable::read(file, {"value", "fitted"}, {"unit", "untuned", "lower", "upper", "edge", "reason"});
  Eigen::VectorXd part(std::ssize(calibration.values));
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const steps::CalibrationValue& value = calibration.values[v];
    bool found = false;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, "value") != value.name) continue;
      part[static_cast<Eigen::Index>(v)] = std::clamp(value.part_of(table.number(row, "fitted")), 0.0, 1.0);
      found = true;
    }
    if (!found) throw InputError({file.string(), 0, value.name}, "is not in this file", "begin without --from");
  }
  return part;
}

int run(const std::filesystem::path& definition, const std::filesystem::path& bridge, const std::filesystem::path& out,
        const std::string& mesh, const std::string& search_mesh, const std::string& from, bool write) {
  const steps::Calibration calibration = steps::read_calibration(definition);
  Eigen::VectorXd first(std::ssize(calibration.values));
  for (Eigen::Index v = 0; v < first.size(); ++v) {
    const steps::CalibrationValue& value = calibration.values[static_cast<std::size_t>(v)];
    first[v] = value.part_of(value.start);
  }
  if (!from.empty()) first = parts_in(from, calibration);
  const steps::CalibrationResult result =
      steps::calibrate(calibration, bridge, mesh, search_mesh, first,
                       [](const std::string& line) { std::fprintf(stderr, "calibrate_bridge: %s\n", line.c_str()); });
  if (result.part.size() == 0) throw InputError({bridge.string(), 0, ""}, result.status.message, "check the starting values");
  std::filesystem::create_directories(out);
  write_values(calibration, result, out / "values.csv");
  write_frequencies(calibration, result, out / "frequencies.csv");
  if (write) {
    std::map<std::string, std::string> units;
    for (const steps::CalibrationValue& value : calibration.values) {
      for (const std::string& path : value.paths) {
        if (!units.contains(path) || units[path] == "-") units[path] = value.unit;
      }
    }
    ponte::write_values(bridge, steps::bridge_values(calibration, result.part), units);
  }
  return result.status.converged ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits the bridge's unknown sizes to printed frequencies within ranges of engineering sense.",
               "calibrate_bridge");
  app.footer(
      "Examples:\n  calibrate_bridge --out results/calibration\n"
      "  calibrate_bridge --from results/calibration/values.csv --out results/calibration --write");
  std::string definition = "data/ponte_del_mare/calibration.toml", bridge = "data/ponte_del_mare/bridge.toml";
  std::string out = "results/calibration", mesh, search_mesh = "coarse", from;
  int threads = 0;
  bool write = false;
  app.add_option("--definition", definition, "ranges and targets")->capture_default_str();
  app.add_option("--bridge", bridge, "definition of the bridge")->capture_default_str();
  app.add_option("--out", out, "folder for values.csv and frequencies.csv")->capture_default_str();
  app.add_option("--mesh", mesh, "mesh of the bridge by name; default: its own");
  app.add_option("--search-mesh", search_mesh, "quick mesh that the search runs on")->capture_default_str();
  app.add_option("--from", from, "values.csv of an earlier fit to go on from; default: the untuned starts");
  app.add_option("--threads", threads, "default: one a core");
  app.add_flag("--write", write, "write the fitted values into the definition of the bridge");
  CLI11_PARSE(app, argc, argv);
  try {
    twindeck::steps::set_threads(threads);
    return run(definition, bridge, out, mesh, search_mesh, from, write);
  } catch (const twindeck::InputError& error) {
    std::fprintf(stderr, "calibrate_bridge: %s\n", error.what());
    return 2;
  }
}
