#include "steps/updating/weighing_tables.hpp"

#include <cmath>
#include <filesystem>
#include <optional>

#include "io/csv.hpp"
#include "updating/undetermined.hpp"
#include "updating/weighing_words.hpp"

namespace twindeck::steps {

using Eigen::Index;

namespace {

const fe::Parameter& parameter_of(const updating::Weighed& weighed, Index j) {
  return weighed.loaded.system.parameters[static_cast<std::size_t>(weighed.active[static_cast<std::size_t>(j)])];
}

void write_posterior(const updating::Weighed& weighed, const updating::Posterior& posterior,
                     const std::filesystem::path& file) {
  io::CsvWriter csv({"parameter", "unit", "final_value", "std", "std_with_misfit", "prior_std", "held", "label"});
  for (Index j = 0; j < posterior.std.size(); ++j) {
    const fe::Parameter& parameter = parameter_of(weighed, j);
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
        csv.row({parameter_of(weighed, j).name, parameter_of(weighed, k).name, posterior.correlation(j, k)});
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
