#include "steps/reliability/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "aero_io/turbulence_sets.hpp"
#include "buffeting/bridge_in_wind.hpp"
#include "core/error.hpp"
#include "io/csv.hpp"
#include "reliability/bridge_reliability.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {
namespace {

const std::string kParameter = "parameter:";

/// Step 6's laws of the parameters, and their correlations.
struct Posterior {
  std::vector<reliability::RandomInput> inputs;
  Eigen::MatrixXd correlation;
};

Posterior read_posterior(runner::StepContext& context, const std::vector<fe::Parameter>& parameters) {
  const std::filesystem::path folder = context.results / "s6_updating", file = folder / "posterior.csv";
  Posterior out;
  if (context.model || !std::filesystem::exists(file)) {
    context.warn(
        "step 6 wrote no posterior of the parameters (it does so where measured deviations weigh the update): they are taken "
        "as "
        "known; state their scatter by [[random]] tables with name = \"parameter:NAME\"");
    return out;
  }
  const io::CsvTable table =
      io::CsvTable::read(context.input(file), {"parameter", "final_value", "std_with_misfit", "held"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "held") == "1") continue;
    const std::string name = table.text(row, "parameter");
    const auto at = std::find_if(parameters.begin(), parameters.end(), [&](const fe::Parameter& p) { return p.name == name; });
    if (at == parameters.end())
      table.fail(row, "parameter", "is '" + name + "', which the model does not have", "run step 6 again");
    out.inputs.push_back({kParameter + name, reliability::LawKind::normal, table.number(row, "final_value"),
                          table.number(row, "std_with_misfit"), at->lower, at->upper, "identified",
                          "s6_updating/posterior.csv"});
  }
  const auto n = static_cast<Eigen::Index>(out.inputs.size());
  out.correlation = Eigen::MatrixXd::Identity(n, n);
  const auto position = [&](const std::string& name) {
    for (Eigen::Index i = 0; i < n; ++i)
      if (out.inputs[static_cast<std::size_t>(i)].name == kParameter + name) return i;
    return Eigen::Index{-1};
  };
  const io::CsvTable pairs =
      io::CsvTable::read(context.input(folder / "correlations.csv"), {"parameter", "other_parameter", "correlation"}, {}, true);
  for (std::size_t row = 0; row < pairs.rows(); ++row) {
    const Eigen::Index i = position(pairs.text(row, "parameter")), j = position(pairs.text(row, "other_parameter"));
    if (i >= 0 && j >= 0) out.correlation(i, j) = out.correlation(j, i) = pairs.number(row, "correlation");
  }
  return out;
}

/// A factor or ratio with a coefficient of variation.
reliability::RandomInput scattered(const std::string& name, double mean, double variation, const std::string& label,
                                   const std::string& source) {
  return {name, reliability::LawKind::lognormal, mean, variation * mean, std::nullopt, std::nullopt, label, source};
}

reliability::RandomInput stated(const StatedInput& input) {
  reliability::RandomInput out{
      input.name,  *reliability::law_kind(input.law), input.mean, input.deviation, std::nullopt, std::nullopt, input.label,
      input.source};
  if (input.bounded) {
    out.low = input.low_value;
    out.high = input.high_value;
  }
  return out;
}

}  // namespace

ReliabilityInputs read_reliability_inputs(const ReliabilityConfig& config, runner::StepContext& context) {
  if (context.study.empty())
    throw InputError({"", 0, "--study"}, "was not given: steps 7 and 8 of a study say what the wind is",
                     "give --study workflows/<study>");
  AerodynamicsConfig aerodynamics = read_step_7("", context);
  ValidationConfig validation;
  io::FieldTable fields = validation.fields();
  fields.load(context.input(context.study / "s8_validation.toml"));
  fields.require();
  wind::TurbulenceSet turbulence =
      aero_io::read_turbulence_set(context.input(validation.turbulence_file), validation.turbulence_set);
  std::vector<aero::DeckAerodynamics> data = read_deck_aerodynamics(aerodynamics, context);
  const double level = fitted_level(context, validation.set);
  for (const std::string& model : config.models) static_cast<void>(buffeting::deployment_of(aerodynamics, model));
  static_cast<void>(buffeting::deployment_of(aerodynamics, config.response_model));
  dynamics::ReadModel model = load_model(context, context.results / "s6_updating" / "model");
  static_cast<void>(aero::aero_nodes_of(aerodynamics, model.fe_model(), model.source));

  Posterior posterior = read_posterior(context, model.parameters());
  std::vector<reliability::RandomInput> inputs = posterior.inputs;
  inputs.push_back(scattered(reliability::kDamping, aerodynamics.structural_damping, config.damping_variation, "assumed",
                             "damping_variation"));
  inputs.push_back(scattered(reliability::kSlope, 1.0, config.level_variation, "assumed", "level_variation"));
  inputs.push_back(scattered(reliability::kDampers, 1.0, config.damper_variation, "paper", "Table 1"));
  inputs.push_back(scattered(reliability::kTurbulence, 1.0, config.turbulence_variation, "assumed", "turbulence_variation"));
  std::vector<int> parameters;
  for (const StatedInput& own : config.random) {
    const auto at = std::find_if(inputs.begin(), inputs.end(), [&](const auto& input) { return input.name == own.name; });
    if (at != inputs.end())
      *at = stated(own);
    else
      inputs.insert(inputs.begin() + static_cast<std::ptrdiff_t>(posterior.inputs.size()), stated(own));
  }
  std::vector<std::string> known = {reliability::kDamping, reliability::kSlope, reliability::kDampers,
                                    reliability::kTurbulence};
  for (const fe::Parameter& parameter : model.parameters()) known.push_back(kParameter + parameter.name);
  for (const reliability::RandomInput& input : inputs) {
    const auto at = std::find(known.begin(), known.end(), input.name);
    if (at == known.end())
      throw InputError({"", 0, "random"},
                       "names '" + input.name + "', which is no random input" + did_you_mean(input.name, known),
                       "write \"parameter:NAME\" with a parameter of model.toml, or structural_damping, aerodynamic_level, "
                       "damper_constants, turbulence_intensity");
    if (at - known.begin() >= 4) parameters.push_back(static_cast<int>(at - known.begin()) - 4);
  }
  const auto n = static_cast<Eigen::Index>(inputs.size());
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  if (posterior.correlation.size() > 0)
    correlation.topLeftCorner(posterior.correlation.rows(), posterior.correlation.cols()) = posterior.correlation;
  return {std::move(aerodynamics),
          std::move(validation),
          std::move(turbulence),
          std::move(data),
          level,
          std::move(model),
          reliability::RandomVector(inputs, correlation),
          parameters};
}

}  // namespace twindeck::steps
