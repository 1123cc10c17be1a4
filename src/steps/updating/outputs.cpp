#include "steps/updating/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>

#include "core/lists.hpp"
#include "io/csv.hpp"
#include "matching/hollow_fit.hpp"
#include "steps/measured/comparison_tables.hpp"
#include "updating/weighing_words.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;

const char* bound_name(int side) { return side < 0 ? "lower" : side > 0 ? "upper" : "none"; }

std::optional<double> change_pct(double initial, double final_value) {
  if (initial == 0.0) return std::nullopt;
  return 100.0 * (final_value / initial - 1.0);
}

std::vector<std::string> with_parameter_names(std::vector<std::string> columns, const Update& of) {
  for (std::size_t j = 0; j < of.active.size(); ++j) columns.push_back(of.parameter(j).name);
  return columns;
}

double error_left_out_pct(const updating::LeftOut& left, double measured_Hz) {
  return 100.0 * (left.frequency_Hz / measured_Hz - 1.0);
}

double mean_left_out_pct(const updating::UpdatingResult& result, const std::vector<matching::ComparisonRow>& comparison) {
  double sum = 0.0;
  for (std::size_t i = 0; i < result.left_out.size(); ++i)
    sum += std::abs(error_left_out_pct(result.left_out[i], comparison.at(i).measured_Hz));
  return sum / static_cast<double>(result.left_out.size());
}

// Position of a start's optimum among the distinct ones, from 1; 0 where it did not converge.
int optimum_number(const updating::UpdatingResult& result, const updating::StartResult& start) {
  const auto at = std::ranges::find(result.optima, start.optimum);
  return at == result.optima.end() ? 0 : static_cast<int>(at - result.optima.begin()) + 1;
}

void write_parameters(const Update& of, const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "unit", "initial_value", "final_value", "change_pct", "lower", "upper", "bound"});
  for (std::size_t j = 0; j < of.active.size(); ++j) {
    const fe::Parameter& parameter = of.parameter(j);
    const double value = of.result.theta(of.active[j]);
    csv.row({parameter.name, parameter.unit, parameter.initial, value, change_pct(parameter.initial, value), parameter.lower,
             parameter.upper, bound_name(of.result.on_bound.at(j))});
  }
  csv.save(file);
}

void write_smooth_bounds(const Update& of, const std::filesystem::path& file) {
  if (of.result.smooth.theta.size() == 0) return;
  io::CsvWriter csv({"parameter", "unit", "final_value", "smooth_bounds_value", "difference_of_range"});
  for (std::size_t j = 0; j < of.active.size(); ++j) {
    const fe::Parameter& parameter = of.parameter(j);
    const double value = of.result.theta(of.active[j]), smooth = of.result.smooth.theta(static_cast<Eigen::Index>(j));
    csv.row({parameter.name, parameter.unit, value, smooth, (smooth - value) / (parameter.upper - parameter.lower)});
  }
  csv.save(file);
}

void write_history(const Update& of, const std::filesystem::path& file) {
  io::CsvWriter csv(
      with_parameter_names({"start", "outer", "iteration", "cost", "projected_gradient", "step_norm", "trust_radius"}, of));
  for (const updating::IterationRecord& record : of.result.history) {
    std::vector<io::Cell> cells = {record.start,    record.outer, record.iteration, record.cost,
                                   record.gradient, record.step,  record.radius};
    for (const double x : record.theta) cells.emplace_back(x);
    csv.row(cells);
  }
  csv.save(file);
}

void write_starts(const Update& of, const std::filesystem::path& file) {
  io::CsvWriter csv(with_parameter_names(
      {"start", "cost", "projected_gradient_relative", "iterations", "converged", "optimum", "message"}, of));
  for (std::size_t k = 0; k < of.result.starts.size(); ++k) {
    const updating::StartResult& start = of.result.starts[k];
    const int optimum = optimum_number(of.result, start);
    std::vector<io::Cell> cells = {k,
                                   start.cost,
                                   start.relative_projected_gradient,
                                   start.iterations,
                                   start.converged ? 1 : 0,
                                   optimum > 0 ? io::Cell(optimum) : io::Cell(""),
                                   start.message};
    for (Index j = 0; j < start.theta.size(); ++j) cells.emplace_back(start.theta(j) / of.result.scale(j));
    csv.row(cells);
  }
  csv.save(file);
}

void write_costs(const updating::UpdatingResult& result, const std::filesystem::path& file) {
  io::CsvWriter csv({"point", "cost"});
  csv.row({"start", result.cost_before});
  for (const updating::CostElsewhere& there : result.elsewhere)
    if (there.valid) csv.row({"published", there.cost});
  csv.row({"optimum", result.starts.at(static_cast<std::size_t>(result.best)).cost});
  csv.save(file);
}

void write_leave_one_out(const std::vector<matching::ComparisonRow>& comparison, std::size_t pairs,
                         const updating::UpdatingResult& result, const std::filesystem::path& file) {
  if (result.left_out.empty()) return;
  io::CsvWriter csv({"experimental_mode", "numerical_mode", "measured_Hz", "before_Hz", "fitted_Hz", "predicted_Hz",
                     "error_before_pct", "error_fitted_pct", "error_predicted_pct", "parameters_on_bounds", "followed_mac",
                     "converged"});
  for (std::size_t i = 0; i < pairs; ++i) {
    const matching::ComparisonRow &before = comparison.at(i), &after = comparison.at(pairs + i);
    const updating::LeftOut& left = result.left_out.at(i);
    csv.row({before.experimental, before.numerical, before.measured_Hz, before.computed_Hz, after.computed_Hz,
             left.frequency_Hz, before.error_pct(), after.error_pct(), error_left_out_pct(left, before.measured_Hz),
             left.on_bounds, left.followed_mac, left.converged ? 1 : 0});
  }
  csv.save(file);
}

void write_updating_summary(const std::vector<matching::ComparisonRow>& comparison, const std::vector<std::string>& common,
                            const updating::UpdatingResult& result, const std::filesystem::path& file) {
  std::vector<matching::ComparisonRow> alike;
  std::ranges::copy_if(comparison, std::back_inserter(alike),
                       [&](const matching::ComparisonRow& row) { return contains(common, row.experimental); });
  io::CsvWriter csv({"quantity", "value", "unit"});
  csv.row({"mean_abs_error_before_pct", matching::mean_abs_error_pct(comparison, "before"), "%"});
  csv.row({"mean_abs_error_after_pct", matching::mean_abs_error_pct(comparison, "after"), "%"});
  csv.row({"pairs", comparison.size() / 2, "-"});
  if (!alike.empty()) {
    csv.row({"mean_abs_error_common_before_pct", matching::mean_abs_error_pct(alike, "before"), "%"});
    csv.row({"mean_abs_error_common_after_pct", matching::mean_abs_error_pct(alike, "after"), "%"});
    csv.row({"pairs_common", alike.size() / 2, "-"});
  }
  if (!result.left_out.empty()) csv.row({"mean_abs_error_left_out_pct", mean_left_out_pct(result, comparison), "%"});
  const updating::StartResult& best = result.starts.at(static_cast<std::size_t>(result.best));
  csv.row({"cost", best.cost, "-"});
  csv.row({"projected_gradient_relative", best.relative_projected_gradient, "-"});
  csv.row({"starts", result.starts.size(), "-"});
  csv.row({"starts_converged",
           static_cast<long>(std::ranges::count_if(result.starts, [](const auto& s) { return s.converged; })), "-"});
  csv.row({"distinct_optima", result.optima.size(), "-"});
  csv.row({"parameters_on_bounds",
           static_cast<long>(std::ranges::count_if(result.on_bound, [](int side) { return side != 0; })), "-"});
  csv.row({"smallest_followed_mac", result.followed_mac.minCoeff(), "-"});
  if (result.smooth.theta.size() > 0) {
    csv.row({"smooth_bounds_cost", result.smooth.cost, "-"});
    csv.row({"smooth_bounds_largest_difference_of_range", result.smooth.largest_difference, "-"});
  }
  csv.save(file);
}

// Errors of both predictions, in a sentence.
std::string words_of_regularised(const std::vector<matching::ComparisonRow>& comparison,
                                 const updating::UpdatingResult& result) {
  const double error = 100.0 * result.regularised->model_error;
  return fmt::format(
      "the update predicts worse than none: pairs that are left out of it are {:.2f} % off in the mean, without updating "
      "{:.2f} %. Held to the ranges (maximum a posteriori{}) it is {:.2f} %: regularised.csv, regularised_model",
      mean_left_out_pct(result, comparison), matching::mean_abs_error_pct(comparison, "before"),
      error > 0.0 ? fmt::format(", model error {:.1f} %", error) : "", mean_left_out_pct(*result.regularised, comparison));
}

// Another update of the same pairs: `name`.csv and leave_one_out_`name`.csv. Returns the comparison with its frequencies.
std::vector<matching::ComparisonRow> write_another(const std::string& name, const Update& other,
                                                   const std::vector<matching::ComparisonRow>& comparison,
                                                   const std::filesystem::path& folder) {
  write_parameters(other, folder / (name + ".csv"));
  std::vector<matching::ComparisonRow> own = comparison;
  const std::size_t pairs = own.size() / 2;
  for (std::size_t i = 0; i < pairs; ++i)
    own[pairs + i].computed_Hz = other.result.frequency_after_Hz(static_cast<Eigen::Index>(i));
  write_leave_one_out(own, pairs, other.result, folder / ("leave_one_out_" + name + ".csv"));
  return own;
}

void write_posterior(const updating::Weighed& weighed, const updating::Posterior& posterior,
                     const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "unit", "final_value", "std", "std_with_misfit", "prior_std", "held", "label"});
  for (Index j = 0; j < posterior.std.size(); ++j) {
    const fe::Parameter& parameter = weighed.parameter(j);
    const bool held = posterior.is_held[static_cast<std::size_t>(j)];
    const std::optional<double> std = held ? std::nullopt : std::optional<double>(posterior.std[j]);
    csv.row({parameter.name, parameter.unit, weighed.result.theta(weighed.active[static_cast<std::size_t>(j)]), std,
             held ? std::nullopt : std::optional<double>(posterior.std[j] * posterior.misfit()), posterior.prior_std[j],
             held ? 1 : 0, weighed.rows.given() ? "identified" : "assumed"});
  }
  csv.save(file);
}

void write_correlations(const updating::Weighed& weighed, const updating::Posterior& posterior,
                        const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "other_parameter", "correlation"});
  for (Index j = 0; j < posterior.std.size(); ++j)
    for (Index k = j + 1; k < posterior.std.size(); ++k)
      if (!std::isnan(posterior.correlation(j, k)))
        csv.row({weighed.parameter(j).name, weighed.parameter(k).name, posterior.correlation(j, k)});
  csv.save(file);
}

void write_rows(const updating::Weighed& weighed, const std::filesystem::path& file) {
  io::CsvWriter csv({"type", "experimental_mode", "numerical_mode", "channel", "value", "std", "computed_start",
                     "computed_updated", "difference_std"});
  const Eigen::VectorXd &start = weighed.result.at_start.predicted, &updated = weighed.result.at_optimum.predicted;
  for (const updating::WeighedRow& row : updating::weighed_row_list(weighed)) {
    const matching::ModePair& pair = weighed.pairing.pairs[row.target];
    const std::optional<double> before = start.size() > 0 ? std::optional<double>(start[row.at]) : std::nullopt;
    csv.row({row.type, weighed.measured.labels[static_cast<std::size_t>(pair.experimental)],
             matching::numerical_label(pair.numerical), row.channel, row.value, row.std, before, updated[row.at],
             row.difference_std()});
  }
  csv.save(file);
}

void write_weighing(const updating::Weighed& weighed, const updating::Posterior& posterior, const std::filesystem::path& file) {
  io::CsvWriter csv({"quantity", "value", "unit"});
  csv.row({"chi_squared", posterior.chi_squared, "-"});
  csv.row({"degrees_of_freedom", posterior.degrees, "-"});
  csv.row({"misfit", posterior.misfit(), "-"});
  csv.row({"rows", static_cast<long>(weighed.rows.covariance.rows()), "-"});
  csv.row({"free_scales", weighed.result.at_optimum.scales, "-"});
  csv.save(file);
}

}  // namespace

void write_updating(const Update& of, const std::vector<matching::ComparisonRow>& comparison,
                    const std::vector<std::string>& common, runner::StepContext& context) {
  const updating::UpdatingResult& result = of.result;
  const std::filesystem::path& folder = context.out;
  write_parameters(of, folder / "parameters.csv");
  write_comparison(comparison, folder);
  write_smooth_bounds(of, folder / "smooth_bounds.csv");
  write_history(of, folder / "history.csv");
  write_starts(of, folder / "starts.csv");
  write_costs(result, folder / "costs.csv");
  write_leave_one_out(comparison, comparison.size() / 2, result, folder / "leave_one_out.csv");
  if (result.regularised) {
    write_another("regularised", {of.parameters, of.active, *result.regularised}, comparison, folder);
    context.warn(words_of_regularised(comparison, result));
  }
  write_updating_summary(comparison, common, result, folder / "summary.csv");
}

void write_selected(const Update& of, const std::vector<matching::ComparisonRow>& comparison, runner::StepContext& context) {
  const updating::UpdatingResult& result = of.result;
  if (result.starts.empty() || result.mode_after.empty()) {
    context.warn("the update of the parameters that s5_sensitivity selected did not end: " + result.status.message);
    return;
  }
  const auto own = write_another("selected", of, comparison, context.out);
  const auto names = with_parameter_names({}, of);
  const std::string left_out =
      result.left_out.empty() ? "" : fmt::format(", {:.2f} % where left out", mean_left_out_pct(result, own));
  context.say(fmt::format("with the parameters that s5_sensitivity selected ({}): mean |error| {:.2f} %{}",
                          fmt::join(names, ", "), matching::mean_abs_error_pct(own, "after"), left_out));
}

void warn_of_fit(Reporter& reporter, const matching::Measured& measured, const std::vector<matching::ComparisonRow>& comparison,
                 const Update& of) {
  const updating::UpdatingResult& result = of.result;
  std::vector<std::string> on_bounds;
  for (std::size_t j = 0; j < of.active.size(); ++j)
    if (result.on_bound.at(j) != 0)
      on_bounds.push_back(fmt::format("{} ({})", of.parameter(j).name, bound_name(result.on_bound[j])));
  matching::warn_of_hollow_fit(reporter, measured, comparison, on_bounds);
}

std::vector<std::string> report_lines(const Update& of) {
  const updating::UpdatingResult& result = of.result;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:<14} {:>13} {:>13} {:>9}  {}", "parameter", "initial", "final", "change", "bound"));
  for (std::size_t j = 0; j < of.active.size(); ++j) {
    const fe::Parameter& parameter = of.parameter(j);
    const double value = result.theta(of.active[j]);
    const std::optional<double> change = change_pct(parameter.initial, value);
    const std::string percent = change ? fmt::format("{:+.2f} %", *change) : "";
    lines.push_back(fmt::format("{:<14} {:>13.6g} {:>13.6g} {:>9}  {}", parameter.name, parameter.initial, value, percent,
                                result.on_bound.at(j) == 0 ? "" : bound_name(result.on_bound[j])));
  }
  lines.push_back(
      fmt::format("{:<5} {:>13} {:>9} {:>6} {:>7} {:>7}  {}", "start", "cost", "gradient", "steps", "solves", "optimum", ""));
  for (std::size_t k = 0; k < result.starts.size(); ++k) {
    const updating::StartResult& start = result.starts[k];
    lines.push_back(fmt::format("{:<5} {:>13.6e} {:>9.1e} {:>6} {:>7} {:>7}  {}", k, start.cost,
                                start.relative_projected_gradient, start.iterations, start.solves,
                                start.converged ? fmt::format("{}", optimum_number(result, start)) : "-",
                                start.converged ? (static_cast<int>(k) == result.best ? "best" : "") : start.message));
  }
  if (result.smooth.theta.size() > 0)
    lines.push_back(fmt::format(
        "by a smooth map of the bounds from start {}: cost {:.6e}, parameters within {:.2g} of their range after {} steps",
        result.best, result.smooth.cost, result.smooth.largest_difference, result.smooth.iterations));
  return lines;
}

void report_weighing(runner::StepContext& context, const updating::Weighed& weighed) {
  updating::warn_of_undetermined(context, weighed);
  const updating::UpdatingResult& result = weighed.result;
  if (result.at_optimum.jacobian.size() == 0) return;
  const std::optional<updating::Posterior> found =
      weighed.rows.given() ? updating::posterior(result.at_optimum, weighed.normalised(), result.box, result.scale)
                           : updating::posterior_of_frequencies(weighed);
  if (!found) return;
  const updating::Posterior& posterior = *found;
  write_posterior(weighed, posterior, context.out / "posterior.csv");
  write_correlations(weighed, posterior, context.out / "correlations.csv");
  if (!weighed.rows.given()) return updating::say_flat_frequencies(context, weighed, posterior);
  write_rows(weighed, context.out / "weighed_rows.csv");
  write_weighing(weighed, posterior, context.out / "weighing.csv");
  updating::say_weighing(context, weighed, posterior);
}

}  // namespace twindeck::steps
