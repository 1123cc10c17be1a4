#include "steps/sensors/sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/model_check.hpp"
#include "io/csv.hpp"
#include "sensors/blind_test.hpp"
#include "sensors/setup_scores.hpp"
#include "steps/layout/layout_files.hpp"
#include "steps/shared/config_parts.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;

io::FieldTable SensorsConfig::fields() {
  io::FieldTable table;
  table.text("points", points, "file of possible sensor points: point,line,s_m,x_m,y_m,z_m,rx,ry,rz", true)
      .text("setups", setups, "file of sensor setups: setup,family,channel,point,direction", true)
      .integer("n_modes", n_modes, {2.0, 200.0}, "number of modes that the sensors must tell apart")
      .integer("channels", channels, {2.0, 1000.0}, "number of sensors in each setup that the step draws or searches for")
      .integer("draws", draws, {1.0, 1e6}, "number of random setups drawn for each family")
      .integer("free_setups", free_setups, {0.0, 100.0}, "number of freely drawn setups that are kept, as DC1, DC2, …")
      .number("sensor_tolerance", tolerance_m, "m", io::positive(), "largest distance between a point and its nearest node")
      .texts("blind.setups", blind_setups, "setups of the blind test; empty: no blind test")
      .number("blind.duration", duration_s, "s", {0.0, io::longest_record_s, true}, "length of the signals")
      .number("blind.rate", rate_Hz, "Hz", {0.0, io::highest_rate_Hz, true},
              "time steps per second of the simulated signals (trapezoidal rule)")
      .number("blind.damping", damping_ratio, "", {0.0, 0.2, true}, "damping ratio of every mode")
      .number("blind.warm_up", warm_up_s, "s", {0.0, io::longest_record_s}, "discarded time before the signals begin")
      .integer("blind.downsample", downsample, {1.0, 1000.0}, "factor of decimation, after a low-pass filter")
      .integer("blind.frames", frames, {1.0, 900.0}, "number of frames, each identified on its own")
      .integer("blind.minimum_order", minimum_order, {2.0, 500.0}, "smallest model order")
      .integer("blind.maximum_order", maximum_order, {2.0, 500.0}, "largest model order")
      .integer("blind.order_step", order_step, {1.0, 100.0}, "step between model orders")
      .integer("blind.block_rows", block_rows, {2.0, 500.0}, "block rows of the Toeplitz matrix")
      .integer("blind.welch_segment", welch_segment, {8.0, 1e7}, "samples of a Welch segment, after downsampling")
      .number("stable.frequency", criteria.frequency, "", io::positive(), "largest relative change of a stable frequency")
      .number("stable.damping", criteria.damping, "", io::positive(), "largest change of a stable damping ratio between orders")
      .number("stable.mac", criteria.mac, "", {0.0, 1.0}, "least MAC of a stable shape between orders")
      .number("cleaning.mac", cleaning.mac, "", {0.0, 1.0}, "paper Eq. (3): least MAC of two shapes that count as the same")
      .number("cleaning.frequency", cleaning.frequency, "", io::positive(),
              "largest relative distance of two frequencies that count as the same")
      .number("cleaning.recursion", cleaning.recursion, "", io::non_negative(),
              "paper Eq. (4): recursion index that a mode must exceed")
      .rule([this] { return orders_exchanged("blind.", minimum_order, maximum_order); });
  return table;
}

namespace {

void write_setups(const std::vector<sensors::ScoredSetup>& setups, const std::vector<sensors::LayoutChannel>& candidates,
                  const fs::path& folder) {
  std::vector<std::size_t> order(setups.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return setups[a].score < setups[b].score; });
  std::vector<long> rank(setups.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<long>(i) + 1;
  io::CsvWriter csv({"setup", "family", "channels", "R_k", "rank", "log_determinant", "draws", "best_drawn_R_k",
                     "median_drawn_R_k", "better_drawn_pct"});
  io::CsvWriter layout({"setup", "channel", "point", "direction", "x_m", "y_m", "z_m", "dx", "dy", "dz"});
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const sensors::ScoredSetup& s = setups[i];
    const std::optional<double> none;
    const auto drawn = [&](double value) { return s.draws > 0 ? std::optional<double>(value) : none; };
    csv.row({s.name, s.family, s.rows.size(), s.score, rank[i],
             std::isfinite(s.log_determinant) ? std::optional<double>(s.log_determinant) : none, s.draws, drawn(s.best_drawn),
             drawn(s.median_drawn), drawn(s.better_drawn_pct)});
    for (std::size_t c = 0; c < s.rows.size(); ++c) {
      const sensors::LayoutChannel& at = candidates[static_cast<std::size_t>(s.rows[c])];
      layout.row({s.name, s.channels[c], at.point, at.direction, at.x_m.x(), at.x_m.y(), at.x_m.z(), at.cosines.x(),
                  at.cosines.y(), at.cosines.z()});
    }
  }
  csv.save(folder / "setups.csv");
  layout.save(folder / "layout.csv");
}

void write_auto_mac(const std::vector<sensors::ScoredSetup>& setups, const MatrixXd& phi, const fs::path& folder) {
  io::CsvWriter csv({"setup", "mode", "other_mode", "mac"});
  for (const sensors::ScoredSetup& s : setups) {
    const MatrixXd mac = sensors::auto_mac(phi(s.rows, Eigen::all));
    for (Index i = 0; i < mac.rows(); ++i)
      for (Index j = 0; j < mac.cols(); ++j) csv.row({s.name, static_cast<long>(i + 1), static_cast<long>(j + 1), mac(i, j)});
  }
  csv.save(folder / "automac.csv");
}

/// Writes the blind test. The partner of a true mode is an identified mode within 5 % in frequency that no other mode has. Of
/// several it is the one with the highest MAC, reduced by 0.01 for each 10 % of frequency difference.
void write_blind_test(const SensorsConfig& config, const sensors::BlindTestResult& result,
                      const std::vector<sensors::ScoredSetup>& setups, const Eigen::VectorXd& frequency_Hz, const MatrixXd& phi,
                      const fs::path& folder) {
  io::CsvWriter csv({"setup", "mode", "frequency_Hz", "damping_ratio_pct", "found", "identified_frequency_Hz",
                     "identified_damping_ratio_pct", "frequency_error_pct", "damping_ratio_error_pct", "mac", "recursion"});
  io::CsvWriter poles({"setup", "frame", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping",
                       "stable_shape", "cluster"});
  io::CsvWriter psd({"setup", "channel", "frequency_Hz", "psd_m2_s3"});
  for (std::size_t i = 0; i < result.tests.size(); ++i) {
    const sensors::BlindTest& test = result.tests[i];
    const sensors::ScoredSetup& setup = *std::ranges::find(setups, test.setup, &sensors::ScoredSetup::name);
    std::vector<bool> taken(test.modes.size(), false);
    for (Index m = 0; m < frequency_Hz.size(); ++m) {
      const Eigen::VectorXd shape = phi(setup.rows, m);
      const auto mac = [&](std::size_t k) {
        const Eigen::VectorXcd& found = test.modes[k].shape;
        return std::norm(found.dot(shape.cast<std::complex<double>>())) / (found.squaredNorm() * shape.squaredNorm());
      };
      double best = -1.0;
      std::size_t at = 0;
      for (std::size_t k = 0; k < test.modes.size(); ++k) {
        const double distance = std::abs(test.modes[k].frequency_Hz / frequency_Hz[m] - 1.0);
        if (const double merit = mac(k) - 10.0 * distance; !taken[k] && distance < 0.05 && merit > best) {
          best = merit;
          at = k;
        }
      }
      const double zeta = 100.0 * config.damping_ratio;
      if (best < 0.0) {
        csv.row({test.setup, static_cast<long>(m + 1), frequency_Hz[m], zeta, 0, "", "", "", "", "", ""});
        continue;
      }
      taken[at] = true;
      const identification::Cluster& mode = test.modes[at];
      csv.row({test.setup, static_cast<long>(m + 1), frequency_Hz[m], zeta, 1, mode.frequency_Hz, 100.0 * mode.damping_ratio,
               100.0 * (mode.frequency_Hz / frequency_Hz[m] - 1.0), 100.0 * mode.damping_ratio - zeta, mac(at),
               mode.members.size()});
    }
    for (std::size_t k = 0; k < test.modes.size(); ++k)
      if (!taken[k])
        csv.row({test.setup, "spurious", "", "", 0, test.modes[k].frequency_Hz, 100.0 * test.modes[k].damping_ratio, "", "", "",
                 test.modes[k].members.size()});
    for (const identification::DiagramPole& p : test.diagram)
      poles.row({test.setup, static_cast<long>(p.pole.order / 1000 + 1), static_cast<long>(p.pole.order % 1000),
                 p.pole.frequency_Hz, 100.0 * p.pole.damping_ratio, p.stable_frequency ? 1 : 0, p.stable_damping ? 1 : 0,
                 p.stable_shape ? 1 : 0, p.mode < 0 ? std::string() : std::to_string(p.mode + 1)});
    for (std::size_t c = 0; c < setup.channels.size(); ++c)
      for (Index f = 0; f < result.psd_frequency_Hz.size(); ++f)
        psd.row({test.setup, setup.channels[c], result.psd_frequency_Hz[f], result.psd_m2_s3[i](f, static_cast<Index>(c))});
  }
  csv.save(folder / "blind_test.csv");
  poles.save(folder / "blind_poles.csv");
  psd.save(folder / "blind_psd.csv");
}

struct SensorsInputs {
  std::vector<sensors::LayoutPoint> points;
  std::vector<sensors::LayoutChannel> setups, candidates;
  dynamics::ReadModel model;
  std::vector<int> nodes;  ///< node of the model for each point
};

Status run_sensors(runner::StepContext& context, const SensorsConfig& config, const SensorsInputs& read) {
  // 1. The model's modes at the candidates.
  const auto& [points, setups, candidates, model, nodes] = read;
  const dynamics::LoadedModel loaded = dynamics::solvable(model);
  dynamics::ModalSolver solver(loaded.system);
  const dynamics::EigenModes modes = solver.solve_available(loaded.theta, static_cast<int>(config.n_modes));
  if (!modes.status.converged) return modes.status;
  dynamics::refuse_more_modes_than_there_are(config.n_modes, loaded, modes);
  const MatrixXd full = loaded.system.expand(modes.shapes);
  MatrixXd translations(3 * std::ssize(points), config.n_modes);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    translations.middleRows(3 * static_cast<Index>(i), 3) = full.middleRows(6 * nodes[i], 3);
  MatrixXd phi(std::ssize(candidates), config.n_modes);
  for (Index c = 0; c < phi.rows(); ++c)
    phi.row(c) = candidates[static_cast<std::size_t>(c)].cosines.transpose() * translations.middleRows(3 * (c / 2), 3);

  // 2. Scores and searches.
  const std::vector<sensors::ScoredSetup> scored = sensors::score_setups(config, points, candidates, setups, phi, context.seed);
  for (const sensors::ScoredSetup& s : scored) context.say(fmt::format("{:<24} R_k {:.4f}", s.name, s.score));

  // 3. The blind test.
  const sensors::BlindTestResult blind = sensors::blind_test(config, modes.frequency_Hz, scored, phi, context.seed);
  for (const sensors::BlindTest& test : blind.tests)
    context.say(fmt::format("blind test with {}: {} modes", test.setup, test.modes.size()));

  write_setups(scored, candidates, context.out);
  write_auto_mac(scored, phi, context.out);
  write_blind_test(config, blind, scored, modes.frequency_Hz, phi, context.out);
  return {};
}

}  // namespace

runner::Computation read_sensors(runner::StepContext& context, const SensorsConfig& config) {
  SensorsInputs read;
  read.points = read_points(context.input(config.points));
  read.setups = read_setups(context.input(config.setups), read.points);
  read.candidates = sensors::candidate_channels(read.points);
  if (config.channels > std::ssize(read.candidates))
    throw InputError({"", 0, "channels"},
                     fmt::format("is {}, but {} has {} candidates", config.channels, config.points, read.candidates.size()),
                     "ask for fewer channels, or give more points");
  sensors::refuse_unknown_blind_setups(config, read.setups);
  read.model = load_model(context, context.results / "s1_model" / "model");
  const fe::Model* model = read.model.fe_model();
  if (model == nullptr)
    throw InputError({read.model.source, 0, ""}, "is a matrix model, whose points have no place",
                     "give a model of finite elements");
  read.nodes = sensors::nodes_at(*model, each_of(read.points, &sensors::LayoutPoint::x_m), config.tolerance_m);
  return [&context, &config, read = std::move(read)] { return run_sensors(context, config, read); };
}

}  // namespace twindeck::steps
