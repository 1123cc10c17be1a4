/// Fits the bridge's unknown sizes to printed frequencies, known cable forces and masses per metre within ranges of engineering
/// sense (data/<study>/calibration.toml), and writes them into bridge.toml on request.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "ponte/calibration/calibration_files.hpp"
#include "runner/threads.hpp"

namespace {

using namespace twindeck;

struct Options {
  std::string definition = "data/ponte_del_mare/calibration.toml", bridge = "data/ponte_del_mare/bridge.toml";
  std::string out = "results/calibration", mesh, search_mesh = "coarse", from, trial;
  bool all_trials = false, write = false;
};

void write_into_bridge(const ponte::Calibration& calibration, const Eigen::VectorXd& part,
                       const std::filesystem::path& bridge) {
  std::map<std::string, std::string> units;
  for (const ponte::CalibrationValue& value : calibration.values)
    for (const std::string& path : value.paths)
      if (!units.contains(path) || units[path] == "-") units[path] = value.unit;
  for (const auto& [path, number] : calibration.set) units[path] = "-";  // SI, as the file reads a number without a unit
  ponte::write_values(bridge, ponte::bridge_values(calibration, part), units);
}

ponte::CalibrationResult fit(const ponte::Calibration& calibration, const Options& options, const std::filesystem::path& out) {
  const Eigen::VectorXd first = options.from.empty() ? ponte::starts(calibration) : ponte::parts_in(options.from, calibration);
  ponte::CalibrationResult result =
      ponte::calibrate(calibration, options.bridge, options.mesh, options.search_mesh, first,
                       [](const std::string& line) { std::fprintf(stderr, "calibrate_bridge: %s\n", line.c_str()); });
  if (result.answers.empty()) throw InputError({options.bridge, 0, ""}, result.status.message, "check the starting values");
  std::filesystem::create_directories(out);
  ponte::write_calibration_values(calibration, result, out / "values.csv");
  ponte::write_calibration_frequencies(calibration, result, out / "frequencies.csv");
  ponte::write_calibration_known(calibration, result, out / "known.csv");
  return result;
}

int run(const Options& options) {
  const ponte::Calibration all = ponte::read_calibration(options.definition);
  if (!options.all_trials && options.trial.empty()) {
    const ponte::CalibrationResult result = fit(all, options, options.out);
    if (options.write) write_into_bridge(all, result.part, options.bridge);
    return result.status.converged ? 0 : 1;
  }
  if (!options.all_trials) static_cast<void>(ponte::for_trial(all, options.trial));  // refuses an unknown name
  ponte::TradeTable trade(all);
  for (const ponte::CalibrationTrial& trial : all.trials) {
    if (!options.all_trials && trial.name != options.trial) continue;
    const ponte::Calibration calibration = ponte::for_trial(all, trial.name);
    const ponte::CalibrationResult result = fit(calibration, options, std::filesystem::path(options.out) / trial.name);
    trade.add(trial, options.mesh.empty() ? "full" : options.mesh, calibration, result);
    if (options.write) write_into_bridge(calibration, result.part, options.bridge);
  }
  trade.save(std::filesystem::path(options.out) / "trade.csv");
  return 0;  // the table shows which trials settled
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits the bridge's unknown sizes to what is known of it within ranges of engineering sense.",
               "calibrate_bridge");
  app.footer(
      "Examples:\n  calibrate_bridge --out results/calibration\n"
      "  calibrate_bridge --from results/calibration/values.csv --out results/calibration --write\n"
      "  calibrate_bridge --trials --mesh coarse --out results/calibration_trade");
  Options options;
  int threads = 0;
  app.add_option("--definition", options.definition, "ranges, targets and trials")->capture_default_str();
  app.add_option("--bridge", options.bridge, "definition of the bridge")->capture_default_str();
  app.add_option("--out", options.out, "folder for values.csv, frequencies.csv and known.csv")->capture_default_str();
  app.add_option("--mesh", options.mesh, "mesh of the bridge by name; default: its own");
  app.add_option("--search-mesh", options.search_mesh, "quick mesh that the search runs on")->capture_default_str();
  app.add_option("--from", options.from, "values.csv of an earlier fit to go on from; default: the untuned starts");
  app.add_option("--threads", threads, "default: one a core");
  app.add_option("--trial", options.trial,
                 "run this [[trial]] of the definition, with its form and data: OUT/NAME and trade.csv");
  CLI::Option* trials = app.add_flag("--trials", options.all_trials, "run every [[trial]]");
  app.add_flag("--write", options.write, "write the fitted values into the definition of the bridge")->excludes(trials);
  CLI11_PARSE(app, argc, argv);
  try {
    runner::set_threads(threads);
    return run(options);
  } catch (const InputError& error) {
    std::fprintf(stderr, "calibrate_bridge: %s\n", error.what());
    return 2;
  }
}
