#include "steps/updating/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/units.hpp"
#include "io/csv.hpp"
#include "matching/comparison.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"
#include "updating/weighing.hpp"

namespace twindeck::steps {

namespace {

std::vector<std::string> selected_by_sensitivity(runner::StepContext& context) {
  const std::filesystem::path file = context.results / "s5_sensitivity" / "selection.csv";
  if (!std::filesystem::is_regular_file(file))
    throw InputError({file.string(), 0, ""}, "is not there, but parameters_from or beside_selection asks for it",
                     "run s5_sensitivity first, or list the parameters");
  const io::CsvTable table = io::CsvTable::read(context.input(file), {"parameter", "selected"}, {}, true);
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.integer(row, "selected") != 0) names.push_back(table.text(row, "parameter"));
  return names;
}

bool has_range(const fe::Parameter& parameter) { return parameter.lower < parameter.upper; }

std::vector<int> positions_of(const std::vector<std::string>& names, const dynamics::ReadModel& model) {
  const std::vector<fe::Parameter>& parameters = model.parameters();
  std::vector<std::string> known = each_of(parameters, &fe::Parameter::name);
  std::vector<int> active;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(known, name);
    if (at == known.end())
      throw InputError({"", 0, "parameters"},
                       fmt::format("'{}' is no parameter of {}{}", name, model.source, did_you_mean(name, known)),
                       "list parameters of the model");
    const auto p = static_cast<int>(at - known.begin());
    if (contains(active, p))
      throw InputError({"", 0, "parameters"}, fmt::format("names '{}' twice", name), "list each parameter once");
    if (!has_range(parameters[static_cast<std::size_t>(p)]))
      throw InputError({model.source, 0, name}, "is fixed (its bounds coincide), but is listed for updating",
                       "give it a range in the model, or take it off the list");
    active.push_back(p);
  }
  return active;
}

std::vector<int> active_parameters(const UpdatingConfig& config, const dynamics::ReadModel& model,
                                   runner::StepContext& context) {
  const bool from_s5 = config.parameters_from == "s5_sensitivity";
  std::vector<int> active = positions_of(from_s5 ? selected_by_sensitivity(context) : config.parameters, model);
  if (active.empty() && !from_s5)
    for (std::size_t p = 0; p < model.parameters().size(); ++p)
      if (has_range(model.parameters()[p])) active.push_back(static_cast<int>(p));
  if (active.empty())
    throw InputError({model.source, 0, "parameter"}, "no parameter to update: none is listed or selected, or none has a range",
                     "define parameters with lower < upper in model.toml");
  return active;
}

/// Values of the updated parameters in somebody else's result: `parameter,unit,final_value`, in units of its own; a parameter
/// that it does not name stays at its initial value. Empty where none is given.
/// @throws InputError  for a name that is not updated, or a unit of another kind
std::vector<Eigen::VectorXd> published_values(const UpdatingConfig& config, const std::vector<fe::Parameter>& parameters,
                                              const std::vector<int>& active, runner::StepContext& context) {
  if (config.published_values.empty()) return {};
  const io::CsvTable table =
      io::CsvTable::read(context.input(config.published_values), {"parameter", "unit", "final_value"}, {}, true);
  std::vector<std::string> updated;
  Eigen::VectorXd values(std::ssize(active));
  for (std::size_t j = 0; j < active.size(); ++j) {
    updated.push_back(parameters[static_cast<std::size_t>(active[j])].name);
    values(static_cast<Eigen::Index>(j)) = parameters[static_cast<std::size_t>(active[j])].initial;
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "parameter");
    const auto at = std::ranges::find(updated, name);
    if (at == updated.end())
      table.fail(row, "parameter", "'" + name + "' is not updated here" + did_you_mean(name, updated), "take the row out");
    const auto j = at - updated.begin();
    const std::string unit = table.text(row, "unit"),
                      own = parameters[static_cast<std::size_t>(active[static_cast<std::size_t>(j)])].unit;
    const auto plain = [](const std::string& text) { return text == "-" ? std::string() : text; };
    values(j) =
        parse_quantity(table.text(row, "final_value") + " " + plain(unit), plain(own), {table.file().string(), 0, name});
  }
  return {values};
}

std::optional<io::FieldTable::Broken> broken_weights(const UpdatingConfig& config) {
  if (!contains(config.residuals, "frequency"))
    return io::FieldTable::Broken{"residuals", "lacks \"frequency\"",
                                  "write residuals = [\"frequency\"] or [\"frequency\", \"shape\"]"};
  if (config.weighs_shapes() && config.weights == "relative")
    return io::FieldTable::Broken{"weights", "is \"relative\", which says nothing of shapes",
                                  "write weights = \"covariance\", or residuals = [\"frequency\"]"};
  if (config.frequency_model_error > 0.0 && !config.weighs())
    return io::FieldTable::Broken{"frequency_model_error", "is set, but the weights are relative and know no deviations",
                                  "write weights = \"covariance\", or leave the key out"};
  if (config.shape_model_error > 0.0 && !config.weighs_shapes())
    return io::FieldTable::Broken{"shape_model_error", "is set, but shapes are not fitted",
                                  "write residuals = [\"frequency\", \"shape\"], or leave the key out"};
  return std::nullopt;
}

}  // namespace

UpdatingInputs read_updating(const UpdatingConfig& config, runner::StepContext& context) {
  UpdatingInputs read;
  read.model = load_model(context, context.results / "s4_refinement" / "model");
  std::optional<matching::Measured> measured = find_measured(context, config.condition);
  if (!measured)
    throw InputError({"", 0, ""}, "no measured modes were given", "give --features DIR or --modes DIR, or a study");
  read.measured = std::move(*measured);
  matching::check_pairing(read.measured, read.model, config.pairs, {"", 0, "pairs"}, config.n_modes, config.sensor_tolerance_m);
  if (config.weighs_shapes()) updating::refuse_unweighable_shapes(read.measured);
  read.active = active_parameters(config, read.model, context);
  if (config.beside_selection) read.selected = positions_of(selected_by_sensitivity(context), read.model);
  read.published = published_values(config, read.model.parameters(), read.active, context);
  return read;
}

UpdatingConfig UpdatingConfig::for_band_of(const matching::Measured& measured, const dynamics::LoadedModel& model) const {
  UpdatingConfig out = *this;
  if (measured.modes.has_shapes())
    out.n_modes =
        dynamics::modes_for_band(model.system, model.theta, n_modes, measured.modes.frequency_Hz, maximum_frequency_error);
  return out;
}

io::FieldTable UpdatingConfig::fields() {
  io::FieldTable table;
  table
      .choice("parameters_from", parameters_from, {"list", "s5_sensitivity"},
              "source of the updated parameters: the list `parameters`, or the selection of s5_sensitivity")
      .texts("parameters", parameters, "names of the parameters to update; empty: all that have a range")
      .boolean(
          "beside_selection", beside_selection,
          "also updates the parameters that s5_sensitivity selected, for comparison (selected.csv, leave_one_out_selected.csv)")
      .texts("pairs", pairs,
             "published pairs, measured-numerical (\"7X-8N\"), used if no shapes were measured; empty: pairs by order of "
             "frequency")
      .texts("common_pairs", common_pairs,
             "measured modes (\"7X\") of a second mean error, over the pairs that an earlier table also has")
      .text("condition", condition,
            "condition of the measured features (--condition or --state override it); empty: the only condition, or the only "
            "one without dampers")
      .number("trust_radius", trust_radius, "", io::positive(), "initial trust radius of the dogleg, in normalised parameters")
      .integer("starts", starts, {1.0, 1000.0},
               "number of searches: one from the initial values, the others from random points inside the bounds")
      .integer("n_modes", n_modes, {1.0, 200.0},
               "number of modes solved for, which include the paired ones; raised if measured modes with shapes lie above them")
      .integer("max_iterations", max_iterations, {1.0, 1e5}, "largest number of steps of one solve at fixed prestress")
      .integer("outer_iterations", outer_iterations, {1.0, 1000.0}, "largest number of prestress states of one search")
      .number("optimality_tolerance", optimality_tolerance, "", {1e-12, 1e-2, true},
              "projected gradient at convergence of a solve, relative to the gradient at its start");
  add_pairing_keys(table, *this);
  table
      .boolean("leave_one_out", leave_one_out,
               "leaves out each pair in turn and predicts it by an update to the other pairs (leave_one_out.csv)")
      .choices(
          "residuals", residuals, {"frequency", "shape"},
          "fitted residuals: frequencies, or frequencies and shapes (each shape with a free scale; docs/updating_on_shapes.md)")
      .choice("weights", weights, {"automatic", "relative", "covariance"},
              "relative: relative frequency errors, the paper's Eq. (5); covariance: standard deviations or covariance.npy of "
              "the features; automatic: covariance if shapes are fitted, else relative")
      .number(
          "frequency_model_error", frequency_model_error, "", io::non_negative(),
          "relative standard deviation of the model's error in frequency, added to the measurement's (weights by covariance)")
      .number("shape_model_error", shape_model_error, "", io::non_negative(),
              "standard deviation of the model's error in shape components, relative to the largest component, added to the "
              "measurement's")
      .rule([this] { return broken_weights(*this); })
      .text("published_values", published_values,
            "file with the result of another updating (parameter,unit,final_value); costs.csv states its cost in this model");
  return table;
}

}  // namespace twindeck::steps
