#include "steps/sensitivity/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "matching/mode_name.hpp"

namespace twindeck::steps {
namespace {

bool is_published(const SensitivityConfig& config, const std::string& name) {
  return contains(config.published_selection, name);
}

bool is_resolved(const sensitivity::Identifiability& identified, const SensitivityConfig& config, Eigen::Index p) {
  return identified.resolution(p) >= config.resolution_cutoff;
}

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// Largest difference in a column over the column's largest entry, worst of all columns.
double worst_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& reference) {
  double worst = 0.0;
  for (Eigen::Index p = 0; p < a.cols(); ++p) {
    const double largest = reference.col(p).cwiseAbs().maxCoeff();
    if (largest > 0.0) worst = std::max(worst, (a.col(p) - reference.col(p)).cwiseAbs().maxCoeff() / largest);
  }
  return worst;
}

/// truncation = Eq. (6) minus extrapolated central difference; relative = d ln f / d ln p.
void write_sensitivity(const std::vector<fe::Parameter>& parameters, const sensitivity::Sensitivities& found,
                       const std::filesystem::path& file) {
  io::CsvWriter csv({"mode", "parameter", "unit", "exact_Hz_per_unit", "relative", "richardson_Hz_per_unit",
                     "forward_eq6_Hz_per_unit", "forward_truncation_Hz_per_unit"});
  const Eigen::MatrixXd relative = found.relative();
  for (Eigen::Index i = 0; i < found.exact.rows(); ++i) {
    for (Eigen::Index p = 0; p < found.exact.cols(); ++p) {
      const fe::Parameter& parameter = parameters[static_cast<std::size_t>(p)];
      csv.row({static_cast<long>(i + 1), parameter.name, parameter.unit, found.exact(i, p), relative(i, p),
               found.richardson(i, p), found.forward(i, p), found.forward(i, p) - found.richardson(i, p)});
    }
  }
  csv.save(file);
}

void write_selection(const std::vector<fe::Parameter>& parameters, const std::vector<sensitivity::SelectedParameter>& selection,
                     const SensitivityConfig& config, const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "unit", "score", "rank", "selected", "published", "reason"});
  for (std::size_t p = 0; p < parameters.size(); ++p)
    csv.row({parameters[p].name, parameters[p].unit, selection[p].score, selection[p].rank, selection[p].selected ? 1 : 0,
             is_published(config, parameters[p].name) ? 1 : 0, selection[p].reason});
  csv.save(file);
}

void write_singular_values(const sensitivity::Identifiability& identified, const SensitivityConfig& config,
                           const std::filesystem::path& file) {
  io::CsvWriter csv({"index", "value", "relative", "identifiable"});
  const Eigen::VectorXd& values = identified.singular_values;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    csv.row({static_cast<long>(i + 1), values(i), values(0) > 0.0 ? values(i) / values(0) : 0.0,
             values(i) >= config.singular_value_cutoff ? 1 : 0});
  csv.save(file);
}

void write_identifiability(const std::vector<fe::Parameter>& parameters, const sensitivity::Identifiability& identified,
                           const SensitivityConfig& config, const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "identifiable", "resolution"});
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    csv.row({parameters[p].name, is_resolved(identified, config, at) ? 1 : 0, identified.resolution(at)});
  }
  csv.save(file);
}

}  // namespace

io::FieldTable SensitivityConfig::fields() {
  io::FieldTable table;
  table.integer("n_modes", n_modes, {1.0, 200.0}, "number of modes in the sensitivity matrix, from the lowest")
      .choice("compared_modes_from", compared_modes_from, {"list", "s4_refinement"},
              "source of the modes compared with a measurement: the list `compared_modes`, or the pairs of s4_refinement")
      .numbers("compared_modes", compared_modes, "", {1.0, 200.0},
               "numbers (from 1) of the modes compared with a measurement; selection and identifiability use these modes; "
               "empty: all")
      .number("forward_step", forward_step, "", {1e-6, 0.5}, "finite-difference step of Eq. (6), relative to the parameter")
      .number("frequency_std_pct", frequency_std_pct, "", io::positive(),
              "standard deviation of a measured frequency in percent; smaller shifts count as not observable")
      .number("selection_threshold", selection_threshold, "", io::positive(),
              "least frequency change by a selected parameter that no other parameter can produce, in standard deviations")
      .number("singular_value_cutoff", singular_value_cutoff, "", io::positive(),
              "singular value, in standard deviations, below which a direction of parameters counts as not identifiable")
      .number("resolution_cutoff", resolution_cutoff, "", {0.0, 1.0},
              "least diagonal entry of the resolution matrix of an identifiable parameter")
      .texts("published_selection", published_selection, "parameters that the paper kept, for the column `published`");
  return table;
}

std::vector<double> paired_modes(const std::filesystem::path& file) {
  const io::CsvTable table = io::CsvTable::read(file, {"numerical_mode"}, {}, true);
  std::set<double> modes;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string label = table.text(row, "numerical_mode");  // "7N"
    const auto position = matching::numerical_position(label);
    if (!position)
      table.fail(row, "numerical_mode", "is '" + label + "', expected a mode such as 7N", "run s4_refinement again");
    modes.insert(static_cast<double>(*position + 1));
  }
  if (modes.empty())
    throw InputError({file.string(), 0, ""}, "has no pair", "see why s4_refinement paired none, or list compared_modes");
  return {modes.begin(), modes.end()};
}

std::vector<std::string> parameter_names(const std::vector<fe::Parameter>& parameters) {
  return each_of(parameters, &fe::Parameter::name);
}

void check_sensitivity_config(const SensitivityConfig& config, const std::vector<fe::Parameter>& parameters,
                              const std::string& source) {
  if (parameters.empty())
    throw InputError({source, 0, "parameter"}, "the model has no parameters", "define [[parameter]] tables in its model.toml");
  for (const double mode : config.compared_modes)
    if (mode != std::floor(mode) || mode > static_cast<double>(config.n_modes))
      throw InputError({"", 0, "compared_modes"},
                       fmt::format("has {}, expected whole numbers from 1 to n_modes = {}", mode, config.n_modes),
                       "raise n_modes or leave the mode out");
  const std::vector<std::string> names = parameter_names(parameters);
  for (const std::string& name : config.published_selection)
    if (!contains(names, name))
      throw InputError({"", 0, "published_selection"},
                       fmt::format("'{}' is no parameter of {}{}", name, source, did_you_mean(name, names)),
                       "the model has " + joined(names));
}

void write_tables(const SensitivityOutcome& outcome, const SensitivityConfig& config, const std::filesystem::path& folder) {
  const auto& [parameters, found, selection, identified] = outcome;
  write_sensitivity(parameters, found, folder / "sensitivity.csv");
  write_selection(parameters, selection, config, folder / "selection.csv");
  write_singular_values(identified, config, folder / "singular_values.csv");
  write_identifiability(parameters, identified, config, folder / "identifiability.csv");
}

std::vector<std::string> sensitivity_report(const SensitivityOutcome& outcome, const SensitivityConfig& config) {
  const auto& [parameters, found, selection, identified] = outcome;
  std::vector<std::string> kept, only_here, only_there, resolved, lines;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const std::string& name = parameters[p].name;
    if (selection[p].selected) kept.push_back(name);
    if (selection[p].selected && !is_published(config, name)) only_here.push_back(name);
    if (!selection[p].selected && is_published(config, name)) only_there.push_back(name);
    if (is_resolved(identified, config, static_cast<Eigen::Index>(p))) resolved.push_back(name);
  }
  lines.push_back(
      fmt::format("{} modes x {} parameters; of each column's largest entry, exact differs by {:.1e} from extrapolated "
                  "differences, Eq. (6) by {:.1e}",
                  found.exact.rows(), found.exact.cols(), worst_difference(found.richardson, found.exact),
                  worst_difference(found.forward, found.exact)));
  lines.push_back("selected: " + joined(kept));
  if (!config.published_selection.empty())
    lines.push_back("published but not selected: " + joined(only_there) + "; selected but not published: " + joined(only_here));
  lines.push_back(fmt::format("{} of {} directions identifiable; parameters seen: {}", identified.retained, parameters.size(),
                              joined(resolved)));
  return lines;
}

}  // namespace twindeck::steps
