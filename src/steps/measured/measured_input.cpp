#include "steps/measured/measured_input.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/spreadsheet.hpp"
#include "matching/mode_name.hpp"
#include "matching/shapes_at_sensors.hpp"
#include "model_io/modes_io.hpp"
#include "runner/study.hpp"

namespace twindeck::steps {

std::vector<runner::Flag> measured_flags() {
  return {{"condition", true, "condition of the measurement to look at: a table of conditions.toml"},
          {"state", true, "state of the structure to look at: the key `state` in conditions.toml (missing there: reference)"},
          {"correct", true,
           "file of corrections of single channels, as s9_diagnosis writes it (corrections.toml), made before anything else"}};
}

void add_pairing_keys(io::FieldTable& table, matching::PairingSettings& settings) {
  table
      .number("minimum_mac", settings.minimum_mac, "", {0.0, 1.0},
              "pairing by MAC: least MAC of a pair; other modes stay unpaired")
      .number("least_paired", settings.least_paired, "", {0.0, 1.0},
              "pairing by MAC: least share of the measured modes with a partner; below it the step refuses")
      .number("maximum_frequency_error", settings.maximum_frequency_error, "", io::positive(),
              "largest relative frequency difference of a pair; pairing by MAC excludes other pairs, pairing by order warns of "
              "them")
      .number("cluster_gap", settings.cluster_gap, "", io::non_negative(),
              "pairing by MAC: relative frequency gap below which modes count as close")
      .number("sensor_tolerance", settings.sensor_tolerance_m, "m", io::non_negative(),
              "largest distance between a sensor and its nearest node");
}

namespace {

/// What `--correct FILE` asks for, registered as an input and written into the manifest. Empty without the option.
/// @throws InputError  see read_corrections; a missing file
std::vector<records::Correction> asked_corrections(runner::StepContext& context) {
  const std::optional<std::string> file = context.flag("correct");
  if (!file) return {};
  if (!std::filesystem::is_regular_file(*file))
    throw InputError({"command line", 0, "--correct"}, "'" + *file + "' is no file",
                     "name a corrections.toml, as s9_diagnosis writes it");
  std::vector<records::Correction> corrections = records::read_corrections(context.input(*file));
  for (const records::Correction& correction : corrections) context.corrections_.push_back(words_of(correction));
  return corrections;
}

/// Warns that rows of load tests are not used by comparison and updating.
void warn_of_load_tests(const std::filesystem::path& folder, runner::StepContext& context) {
  const auto table = io::CsvTable::read(folder / "rows.csv", {"type"}, {}, true);
  int count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) count += table.text(row, "type").starts_with("static_") ? 1 : 0;
  if (count > 0) context.warn(fmt::format("{} rows of load tests are not used here: s9_diagnosis compares them", count));
}

}  // namespace

records::MeasuredChoice asked_choice(runner::StepContext& context, const std::string& condition) {
  records::MeasuredChoice choice;
  const auto name = [&](const char* flag) {
    const std::optional<std::string> given = context.flag(flag);
    if (given && given->empty())
      throw InputError({"command line", 0, std::string("--") + flag}, "is empty", "give a name, or leave the option out");
    return given.value_or("");
  };
  choice.conditions = {name("condition"), name("state")};
  if (choice.conditions.condition.empty() && choice.conditions.state.empty()) choice.conditions.condition = condition;
  choice.corrections = asked_corrections(context);
  return choice;
}

matching::Measured read_measured_modes(const std::filesystem::path& folder, const records::MeasuredChoice& choice) {
  matching::Measured measured;
  measured.source = folder.string();
  std::vector<long> lines;
  measured.modes = model_io::read_modes(folder, &lines);
  for (Eigen::Index i = 0; i < measured.modes.size(); ++i) {
    const std::string& name = measured.modes.names[static_cast<std::size_t>(i)];
    if (!(measured.modes.frequency_std_Hz[i] > 0.0))
      throw InputError({(folder / "modes.csv").string(), lines[static_cast<std::size_t>(i)], "frequency_std_Hz"},
                       fmt::format("mode {} has no standard deviation", name),
                       "state it; a frequency without one can't be weighed");
    if (!(measured.modes.frequency_Hz[i] > 0.0))
      throw InputError({(folder / "modes.csv").string(), lines[static_cast<std::size_t>(i)], "frequency_Hz"},
                       fmt::format("mode {} has no frequency above 0 Hz", name), "");
    measured.labels.push_back(matching::experimental_label(name));
    measured.rows.push_back({i, -1, false, measured.modes.frequency_Hz[i]});
  }
  measured.covariance = measured.modes.frequency_std_Hz.cwiseAbs2().asDiagonal();
  if (io::has_table(folder / "channels.csv")) measured.channels = records::read_channels(folder / "channels.csv");
  correct(choice.corrections, measured.modes, (folder / "shapes.csv").string());
  return measured;
}

std::optional<matching::Measured> find_measured(runner::StepContext& context, const std::string& condition) {
  if (context.modes) {
    for (const char* flag : {"condition", "state"})
      if (context.has_flag(flag))
        throw InputError({"command line", 0, std::string("--") + flag},
                         "does not go with --modes: modes.csv knows no conditions", "leave it out, or give --features");
    return read_measured_modes(context.input(*context.modes), asked_choice(context));
  }
  std::filesystem::path folder;
  if (context.features)
    folder = *context.features;
  else if (!context.study.empty())
    folder = runner::read_study(context.study).features;
  const records::MeasuredChoice choice = asked_choice(context, condition);
  if (!folder.empty()) {
    matching::Measured measured = records::read_measured_features(context.input(folder), choice);
    warn_of_load_tests(folder, context);
    return measured;
  }
  for (const runner::Flag& flag : measured_flags())
    if (context.has_flag(flag.name))
      throw InputError({"command line", 0, "--" + flag.name}, "is given, but no measured modes are",
                       "give --features DIR or --modes DIR");
  return std::nullopt;
}

Eigen::MatrixXd mac_for_units(const Eigen::MatrixXcd& phi_n, const Eigen::MatrixXcd& phi_x) {
  constexpr Eigen::Index fewest_channels = 3;
  std::vector<Eigen::Index> known, moving;
  for (Eigen::Index i = 0; i < phi_x.cols(); ++i)
    if ((phi_x.col(i).array() == phi_x.col(i).array()).count() >= fewest_channels) known.push_back(i);
  for (Eigen::Index i = 0; i < phi_n.cols(); ++i)
    if (phi_n.col(i).norm() > 0.0) moving.push_back(i);
  Eigen::MatrixXd mac = Eigen::MatrixXd::Constant(phi_n.cols(), phi_x.cols(), matching::kUnknown);
  if (known.empty() || moving.empty()) return mac;
  matching::PairingOptions single;
  single.cluster_gap = -1.0;  // no mode counts as close to another
  mac(moving, known) = matching::likeness_of(Eigen::VectorXd::Ones(std::ssize(known)), phi_x(Eigen::all, known),
                                             Eigen::VectorXd::Ones(std::ssize(moving)), phi_n(Eigen::all, moving), single)
                           .value.transpose();
  return mac;
}

std::vector<dynamics::MeasuredFrequencies> frequencies_of(const std::optional<matching::Measured>& measured,
                                                          const matching::PairingSettings& settings,
                                                          const dynamics::LoadedModel& loaded,
                                                          const dynamics::EigenModes& modes) {
  if (!measured) return {};
  dynamics::MeasuredFrequencies found{measured->modes.names, measured->modes.frequency_Hz};
  const Eigen::Index n = modes.frequency_Hz.size();
  if (measured->modes.has_shapes()) {
    try {
      Eigen::MatrixXcd phi_n = matching::shapes_at_sensors(*measured, loaded, modes, settings.sensor_tolerance_m);
      for (Eigen::Index i = 0; i < n; ++i)  // what no sensor sees is rounding
        if (phi_n.col(i).norm() < unseen * modes.shapes.col(i).cwiseAbs().maxCoeff()) phi_n.col(i).setZero();
      found.mac = mac_for_units(phi_n, measured->modes.shapes);
    } catch (const InputError&) {  // a channel that cannot be placed is refused where modes are paired by it, not here
      return {found};
    }
  } else if (!settings.pairs.empty()) {
    found.mac = Eigen::MatrixXd::Zero(n, measured->modes.size());
    for (const matching::ModePair& pair : matching::pair_as_published(*measured, n, settings.pairs, {"", 0, "pairs"}).pairs)
      found.mac(pair.numerical, pair.experimental) = 1.0;
  }
  return {found};
}

}  // namespace twindeck::steps
