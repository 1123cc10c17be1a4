#include "steps/updating/weighing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "steps/measured/measured_shapes.hpp"
#include "steps/updating/weighing_words.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

/// Position of each measured mode among the pairs; -1 for an unpaired one.
std::vector<int> target_of_mode(const Measured& measured, const Pairing& pairing) {
  std::vector<int> target(static_cast<std::size_t>(measured.modes.size()), -1);
  for (std::size_t t = 0; t < pairing.pairs.size(); ++t)
    target[static_cast<std::size_t>(pairing.pairs[t].experimental)] = static_cast<int>(t);
  return target;
}

/// A computed mode, and those whose frequencies lead to it in steps below the gap (as in matching/pairing).
std::vector<int> close_modes(const Eigen::VectorXd& frequency_Hz, Index mode, double gap) {
  const auto close = [&](Index upper) { return frequency_Hz[upper] - frequency_Hz[upper - 1] < gap * frequency_Hz[upper]; };
  std::vector<int> span = {static_cast<int>(mode)};
  for (Index i = mode; i > 0 && close(i); --i) span.push_back(static_cast<int>(i - 1));
  for (Index i = mode + 1; i < frequency_Hz.size() && close(i); ++i) span.push_back(static_cast<int>(i));
  return span;
}

double largest_component(const Measured& measured, Index mode) {
  double largest = 0.0;
  for (const std::complex<double> value : measured.modes.shapes.col(mode))
    if (!std::isnan(value.real())) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

void refuse_unweighable_shapes(const Measured& measured) {
  if (!measured.modes.has_shapes())
    throw InputError({measured.source, 0, "shape"}, "holds no measured shape, which `residuals` asks for",
                     "give shapes in rows.csv, or residuals = [\"frequency\"]");
  if (std::none_of(measured.rows.begin(), measured.rows.end(), [](const MeasuredRow& row) { return row.dof >= 0; }))
    throw InputError({measured.source, 0, "shapes.csv"}, "has no standard deviations, so that shapes can't be weighed",
                     "give the modes as a features folder (--features), whose rows.csv has them");
}

updating::MeasuredRows weighed_rows(const UpdatingConfig& config, const Measured& measured, const Pairing& pairing,
                                    const LoadedModel& loaded, const dynamics::EigenModes& modes) {
  updating::MeasuredRows rows;
  if (!config.weighs()) return rows;
  const std::vector<int> target = target_of_mode(measured, pairing);
  std::vector<Index> taken(pairing.pairs.size());
  std::vector<double> own_error(taken.size());  // of the model, in the row's unit
  for (std::size_t r = 0; r < measured.rows.size(); ++r) {
    const MeasuredRow& row = measured.rows[r];
    const int t = target[static_cast<std::size_t>(row.mode)];
    if (t < 0 || row.dof >= 0) continue;
    taken[static_cast<std::size_t>(t)] = static_cast<Index>(r);
    own_error[static_cast<std::size_t>(t)] = config.frequency_model_error * row.value;
  }
  if (config.weighs_shapes()) {
    rows.channels = sensor_vectors(measured, loaded, config.sensor_tolerance_m);
    for (const matching::ModePair& pair : pairing.pairs)
      rows.span.push_back(close_modes(modes.frequency_Hz, pair.numerical, config.cluster_gap));
    for (std::size_t r = 0; r < measured.rows.size(); ++r) {
      const MeasuredRow& row = measured.rows[r];
      const int t = target[static_cast<std::size_t>(row.mode)];
      if (t < 0 || row.dof < 0) continue;
      rows.shape.push_back({t, static_cast<int>(row.dof), row.imaginary, row.value});
      taken.push_back(static_cast<Index>(r));
      own_error.push_back(config.shape_model_error * largest_component(measured, row.mode));
    }
  }
  rows.covariance = measured.covariance(taken, taken);
  for (std::size_t i = 0; i < own_error.size(); ++i)
    rows.covariance(static_cast<Index>(i), static_cast<Index>(i)) += own_error[i] * own_error[i];
  return rows;
}

namespace {

const fe::Parameter& parameter_of(const Weighed& weighed, Index j) {
  return weighed.loaded.system.parameters[static_cast<std::size_t>(weighed.active[static_cast<std::size_t>(j)])];
}

void write_posterior(const Weighed& weighed, const updating::Posterior& posterior, const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "unit", "final_value", "std", "std_with_misfit", "prior_std", "held"});
  for (Index j = 0; j < posterior.std.size(); ++j) {
    const fe::Parameter& parameter = parameter_of(weighed, j);
    const bool held = posterior.is_held[static_cast<std::size_t>(j)];
    const std::optional<double> std = held ? std::nullopt : std::optional<double>(posterior.std[j]);
    csv.row({parameter.name, parameter.unit, weighed.result.theta(weighed.active[static_cast<std::size_t>(j)]), std,
             held ? std::nullopt : std::optional<double>(posterior.std[j] * posterior.misfit()), posterior.prior_std[j],
             held ? 1 : 0});
  }
  csv.save(file);
}

void write_correlations(const Weighed& weighed, const updating::Posterior& posterior, const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "other_parameter", "correlation"});
  for (Index j = 0; j < posterior.std.size(); ++j)
    for (Index k = j + 1; k < posterior.std.size(); ++k)
      if (!std::isnan(posterior.correlation(j, k)))
        csv.row({parameter_of(weighed, j).name, parameter_of(weighed, k).name, posterior.correlation(j, k)});
  csv.save(file);
}

void write_rows(const Weighed& weighed, const std::filesystem::path& file) {
  io::CsvWriter csv({"type", "experimental_mode", "numerical_mode", "channel", "value", "std", "computed_start",
                     "computed_updated", "difference_std"});
  const Eigen::VectorXd &start = weighed.result.at_start.predicted, &updated = weighed.result.at_optimum.predicted;
  for (const WeighedRow& row : weighed_row_list(weighed)) {
    const matching::ModePair& pair = weighed.pairing.pairs[row.target];
    const std::optional<double> before = start.size() > 0 ? std::optional<double>(start[row.at]) : std::nullopt;
    csv.row({row.type, weighed.measured.labels[static_cast<std::size_t>(pair.experimental)], numerical_label(pair.numerical),
             row.channel, row.value, row.std, before, updated[row.at], row.difference_std()});
  }
  csv.save(file);
}

void write_weighing(const Weighed& weighed, const updating::Posterior& posterior, const std::filesystem::path& file) {
  io::CsvWriter csv({"quantity", "value", "unit"});
  csv.row({"chi_squared", posterior.chi_squared, "-"});
  csv.row({"degrees_of_freedom", posterior.degrees, "-"});
  csv.row({"misfit", posterior.misfit(), "-"});
  csv.row({"rows", static_cast<long>(weighed.rows.covariance.rows()), "-"});
  csv.row({"free_scales", weighed.result.at_optimum.scales, "-"});
  csv.save(file);
}

}  // namespace

void report_weighing(StepContext& context, const Weighed& weighed) {
  const updating::UpdatingResult& result = weighed.result;
  if (!weighed.rows.given() || result.at_optimum.jacobian.size() == 0) return;
  Eigen::VectorXd x(result.scale.size());
  for (Index j = 0; j < x.size(); ++j) x[j] = result.theta(weighed.active[static_cast<std::size_t>(j)]) / result.scale[j];
  const updating::Posterior posterior = updating::posterior(result.at_optimum, x, result.box, result.scale);
  write_posterior(weighed, posterior, context.out / "posterior.csv");
  write_correlations(weighed, posterior, context.out / "correlations.csv");
  write_rows(weighed, context.out / "weighed_rows.csv");
  write_weighing(weighed, posterior, context.out / "weighing.csv");
  say_weighing(context, weighed, posterior);
}

}  // namespace twindeck::steps
