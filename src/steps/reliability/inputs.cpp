#include "steps/reliability/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "buffeting/bridge_in_wind.hpp"
#include "core/error.hpp"
#include "io/csv.hpp"
#include "matching/mode_name.hpp"
#include "reliability/bridge_reliability.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/config_parts.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {
namespace {

void add_wall(io::FieldTable& t, StatedWall& wall) {
  t.texts("sections", wall.sections, "sections of sections.csv that corrode by the same law")
      .number("thickness", wall.thickness_m, "m", {0.0, 10.0},
              "thickness of the wall; 0: round ropes or rods, or the shell's own thickness")
      .integer("sides", wall.sides, {1.0, 2.0}, "number of surfaces of the wall that corrode")
      .choice("category", wall.category, {"C1", "C2", "C3", "C4", "C5", "CX"}, "corrosivity of the atmosphere, ISO 9223")
      .number("first_year", wall.first_year_m, "m", {0.0, 0.1},
              "loss of thickness in the first year; 0: the middle of the category's range")
      .number("exponent", wall.exponent, "", {0.0, 1.0, true}, "exponent b of D = r t^b, ISO 9224: 0.523, upper bound 0.575")
      .number("coating_life_years", wall.coating_life_years, "", {0.0, 1000.0}, "years until the coating is gone");
}

void add_fault(io::FieldTable& t, StatedFault& fault) {
  t.text("damper", fault.damper, "name of the damper in springs.csv", true)
      .choice("kind", fault.kind, {"held", "lost"}, "fault: held by static friction, or removed");
}

void add_comfort(io::FieldTable& t, StatedComfort& limit) {
  t.text("name", limit.name, "name of the limit, such as its guideline", true)
      .number("vertical", limit.vertical_m_s2, "m/s2", {0.0, 100.0}, "limit of the vertical acceleration; 0: none")
      .number("lateral", limit.lateral_m_s2, "m/s2", {0.0, 100.0}, "limit of the lateral acceleration; 0: none");
}

void add_random(io::FieldTable& t, StatedInput& input) {
  t.text("name", input.name,
         "parameter of the model as \"parameter:NAME\", or one of the four inputs above by its name in random.csv", true)
      .choice("law", input.kind, reliability::law_names, "probability law of the input")
      .number("mean", input.mean, "", {-1e300, 1e300}, "mean, in the input's own unit", true)
      .number("deviation", input.deviation, "", {-1e300, 1e300}, "standard deviation, in the same unit; 0 keeps it fixed", true)
      .boolean("bounded", input.bounded, "whether the law is truncated to the range from low to high")
      .number("low", input.low_value, "", {-1e300, 1e300}, "least value of a bounded law")
      .number("high", input.high_value, "", {-1e300, 1e300}, "largest value of a bounded law")
      .choice("label", input.label, {"paper", "code", "assumed", "identified", "user"}, "kind of source of the numbers")
      .text("source", input.source, "source of the numbers");
}

void add_tables(ReliabilityConfig& config, io::FieldTable& t) {
  t.texts("rare", config.rare,
          "limit states of crossings.csv whose probability is also computed by FORM and by subset simulation (rare.csv)")
      .numbers("years", config.years, "", {0.0, 1000.0}, "years in service that are computed; the first must be 0")
      .tables("wall", rows_of(config.walls, add_wall), "sections that lose thickness by corrosion")
      .tables("fault", rows_of(config.faults, add_fault), "one damper with a fault, computed as a further case")
      .tables("comfort", rows_of(config.comfort, add_comfort), "comfort limits in addition to those of step 8", "name")
      .choice("wind_law.kind", config.wind_law.kind_name, {"none", "weibull", "table", "gumbel", "code"},
              "your probability law of the mean wind at the deck: weibull and table for all ten-minute means, gumbel and code "
              "for the annual maximum; none: no annual probability")
      .number("wind_law.scale", config.wind_law.scale_m_s, "m/s", io::non_negative(), "weibull: scale parameter")
      .number("wind_law.shape", config.wind_law.shape, "", io::positive(), "weibull: shape parameter")
      .number("wind_law.mode", config.wind_law.mode_m_s, "m/s", io::non_negative(), "gumbel: mode")
      .number("wind_law.gumbel_scale", config.wind_law.gumbel_scale_m_s, "m/s", io::non_negative(), "gumbel: scale parameter")
      .number("wind_law.basic_speed", config.wind_law.basic_m_s, "m/s", io::non_negative(),
              "code: basic wind speed v_b of EN 1991-1-4")
      .choice("wind_law.terrain", config.wind_law.terrain, {"0", "I", "II", "III", "IV"}, "code: terrain category, EN 1991-1-4")
      .text("wind_law.file", config.wind_law.file,
            "table: file with speed_m_s, direction_deg (towards which the wind blows, as in step 7), probability")
      .number(
          "wind_law.sector", config.wind_law.sector_deg, "", {1.0, 360.0},
          "table: width in degrees of the sectors about step 7's direction and its opposite; winds outside them count as calm");
}

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
        "step 6 wrote no posterior of the parameters (it does so where the measured frequencies have standard deviations): "
        "they are taken as known; state their scatter by [[random]] tables with name = \"parameter:NAME\"");
    return out;
  }
  const io::CsvTable table =
      io::CsvTable::read(context.input(file), {"parameter", "final_value", "std_with_misfit", "held", "label"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "held") == "1") continue;
    const std::string name = table.text(row, "parameter");
    const auto at = std::ranges::find(parameters, name, &fe::Parameter::name);
    if (at == parameters.end())
      table.fail(row, "parameter", "is '" + name + "', which the model does not have", "run step 6 again");
    out.inputs.push_back({kParameter + name, reliability::LawKind::normal, table.number(row, "final_value"),
                          table.number(row, "std_with_misfit"), at->lower, at->upper, table.text(row, "label"),
                          "s6_updating/posterior.csv"});
  }
  const auto n = std::ssize(out.inputs);
  out.correlation = Eigen::MatrixXd::Identity(n, n);
  const auto position = [&](const std::string& name) -> Eigen::Index {  // n for a parameter that is not random
    return std::ranges::find(out.inputs, kParameter + name, &reliability::RandomInput::name) - out.inputs.begin();
  };
  const io::CsvTable pairs =
      io::CsvTable::read(context.input(folder / "correlations.csv"), {"parameter", "other_parameter", "correlation"}, {}, true);
  for (std::size_t row = 0; row < pairs.rows(); ++row) {
    const Eigen::Index i = position(pairs.text(row, "parameter")), j = position(pairs.text(row, "other_parameter"));
    if (i < n && j < n) out.correlation(i, j) = out.correlation(j, i) = pairs.number(row, "correlation");
  }
  return out;
}

reliability::RandomInput scattered(const std::string& name, double mean, double variation, const std::string& label,
                                   const std::string& source) {
  return {name, reliability::LawKind::lognormal, mean, variation * mean, std::nullopt, std::nullopt, label, source};
}

reliability::RandomInput stated(const StatedInput& input) {
  reliability::RandomInput out = input;
  if (input.bounded) {
    out.low = input.low_value;
    out.high = input.high_value;
  }
  return out;
}

std::vector<reliability::Wall> walls_of(const ReliabilityConfig& config) {
  std::vector<reliability::Wall> out;
  for (const StatedWall& wall : config.walls) {
    const double first = wall.first_year_m > 0.0 ? wall.first_year_m : *reliability::first_year_loss_m(wall.category);
    out.push_back(
        {wall.sections, wall.thickness_m, static_cast<int>(wall.sides), {first, wall.exponent, wall.coating_life_years}});
  }
  return out;
}

/// Winds of a table that come from within the sector about step 7's direction, with the share of the time for each speed. All
/// other winds count as calm.
void read_wind_table(const StatedWindLaw& stated, double direction_deg, runner::StepContext& context,
                     reliability::WindLaw& law) {
  if (stated.file.empty())
    throw InputError({"", 0, "wind_law.file"}, "is not given, and a law of kind table is a file", "give wind_law.file");
  const io::CsvTable table =
      io::CsvTable::read(context.input(context.resolved(stated.file)), {"speed_m_s", "direction_deg", "probability"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double apart = std::abs(std::remainder(table.number(row, "direction_deg") - direction_deg, 180.0));
    law.speed_m_s.push_back(apart <= 0.5 * stated.sector_deg ? table.number(row, "speed_m_s") : 0.0);
    law.probability.push_back(table.number(row, "probability"));
    if (const double p = law.probability.back(); p < 0.0)
      table.fail(row, "probability", fmt::format("is {}, expected zero or more", p), "give each class its share of the time");
  }
}

std::optional<reliability::WindLaw> read_wind_law(const StatedWindLaw& stated, double direction_deg, double height_m,
                                                  runner::StepContext& context) {
  using Kind = reliability::WindLaw::Kind;
  if (stated.kind_name == "none") return std::nullopt;
  reliability::WindLaw law = stated;
  law.kind = stated.kind_name == "weibull"  ? Kind::weibull
             : stated.kind_name == "table"  ? Kind::table
             : stated.kind_name == "gumbel" ? Kind::gumbel
                                            : Kind::code;
  law.label = law.kind == Kind::code ? "code" : "user";
  if (law.kind == Kind::code) law.exposure = *reliability::roughness_factor(stated.terrain, height_m);
  if (law.kind == Kind::table) read_wind_table(stated, direction_deg, context, law);
  reliability::check_wind_law(law, law.kind == Kind::table ? stated.file : "");
  return law;
}

/// Refuses empty or unordered lists, and walls and faults that the model cannot have, before anything is computed.
void check_lists(const ReliabilityConfig& config, const std::vector<reliability::Wall>& walls, const fe::Model* model) {
  const auto rises = [](const std::vector<double>& list) {
    return !list.empty() && std::ranges::adjacent_find(list, std::greater_equal<>()) == list.end();
  };
  if (!rises(config.speed_m_s))
    throw InputError({"", 0, "speeds"}, "is empty or does not rise", "write speeds = [\"5 m/s\", \"10 m/s\"]");
  if (!rises(config.years) || config.years.front() != 0.0)
    throw InputError({"", 0, "years"}, "do not begin with 0 and rise: all changes are told against the year 0",
                     "write years = [0, 25, 50]");
  for (const StatedComfort& limit : config.comfort)
    if (limit.vertical_m_s2 == 0.0 && limit.lateral_m_s2 == 0.0)
      throw InputError({"", 0, "comfort"}, "states no limit under '" + limit.name + "'", "give vertical or lateral, in m/s2");
  for (const StatedWall& wall : config.walls)
    if (wall.sections.empty())
      throw InputError({"", 0, "wall.sections"}, "are none", "name the sections of sections.csv that corrode");
  if (model == nullptr) return;
  static_cast<void>(reliability::worn_model(*model, walls, config.years.back()));
  for (const StatedFault& fault : config.faults)
    static_cast<void>(reliability::with_damper_fault(*model, fault.damper, reliability::DamperFault::lost, 0.0));
}

/// Refuses factors, ratios and rates that are not positive one deviation below their median: their logarithms are needed.
void check_positive(const reliability::RandomVector& random) {
  const Eigen::VectorXd below = random.values(Eigen::VectorXd::Constant(random.dimension(), -1.0));
  for (std::size_t i = 0; i < random.inputs().size(); ++i) {
    const reliability::RandomInput& input = random.inputs()[i];
    const double value = below[static_cast<Eigen::Index>(i)];
    if (!input.name.starts_with(kParameter) && input.deviation > 0.0 && !(value > 0.0))
      throw InputError({"", 0, input.name},
                       fmt::format("is {:.3g} one deviation below its median, expected a positive number", value),
                       "give law = \"lognormal\", or bounded = true with a positive low");
  }
}

/// All random inputs: step 6's, then the step's own, then those that the configuration states.
struct Inputs {
  reliability::RandomVector random;
  std::vector<int> parameters;
};
Inputs random_inputs(const ReliabilityConfig& config, double structural_damping, bool corrodes,
                     const std::vector<fe::Parameter>& of_model, runner::StepContext& context) {
  Posterior posterior = read_posterior(context, of_model);
  std::vector<reliability::RandomInput> inputs = posterior.inputs;
  inputs.push_back(
      scattered(reliability::kDamping, structural_damping, config.damping_variation, "assumed", "damping_variation"));
  inputs.push_back(scattered(reliability::kSlope, 1.0, config.level_variation, "assumed", "level_variation"));
  inputs.push_back(scattered(reliability::kDampers, 1.0, config.damper_variation, "paper", "Table 1"));
  inputs.push_back(scattered(reliability::kTurbulence, 1.0, config.turbulence_variation, "assumed", "turbulence_variation"));
  if (corrodes)
    inputs.push_back(scattered(reliability::kCorrosion, 1.0, config.corrosion_variation, "assumed", "corrosion_variation"));
  std::vector<int> parameters;
  for (const StatedInput& own : config.random) {
    if (const auto at = std::ranges::find(inputs, own.name, &reliability::RandomInput::name); at != inputs.end())
      *at = stated(own);
    else
      inputs.insert(inputs.begin() + std::ssize(posterior.inputs), stated(own));
  }
  std::vector<std::string> known = {reliability::kDamping, reliability::kSlope, reliability::kDampers, reliability::kTurbulence,
                                    reliability::kCorrosion};
  const auto own_inputs = std::ssize(known);
  for (const fe::Parameter& parameter : of_model) known.push_back(kParameter + parameter.name);
  for (reliability::RandomInput& input : inputs) {
    const auto at = std::ranges::find(known, input.name);
    if (at == known.end())
      throw InputError({"", 0, "random"},
                       "names '" + input.name + "', which is no random input" + did_you_mean(input.name, known),
                       "write \"parameter:NAME\" with a parameter of model.toml, or structural_damping, aerodynamic_level, "
                       "damper_constants, turbulence_intensity, corrosion_rate");
    if (at - known.begin() < own_inputs) continue;
    parameters.push_back(static_cast<int>(at - known.begin() - own_inputs));
    if (input.low || input.high) continue;
    // An input without bounds takes those of the model's parameter.
    input.low = of_model[static_cast<std::size_t>(parameters.back())].lower;
    input.high = of_model[static_cast<std::size_t>(parameters.back())].upper;
  }
  const auto n = std::ssize(inputs);
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  if (posterior.correlation.size() > 0)
    correlation.topLeftCorner(posterior.correlation.rows(), posterior.correlation.cols()) = posterior.correlation;
  Inputs out{reliability::RandomVector(inputs, correlation), parameters};
  check_positive(out.random);
  return out;
}

/// The pairs of step 6's comparison.csv whose measured frequency has a standard deviation. A warning says so where there are
/// none.
/// @param condition  of the measured features, as in step 6
std::vector<MonitoredName> read_monitored(runner::StepContext& context, const std::string& condition) {
  std::vector<MonitoredName> out;
  const std::filesystem::path file = context.results / "s6_updating" / "comparison.csv";
  const bool compared = !context.model && std::filesystem::exists(file);
  if (const auto measured = compared ? find_measured(context, condition) : std::nullopt) {
    const io::CsvTable table =
        io::CsvTable::read(context.input(file), {"stage", "experimental_mode", "numerical_mode"}, {}, true);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const auto at = std::ranges::find(measured->labels, table.text(row, "experimental_mode"));
      const auto mode = matching::numerical_position(table.text(row, "numerical_mode"));
      if (table.text(row, "stage") != "after" || at == measured->labels.end() || !mode) continue;
      const auto i = static_cast<Eigen::Index>(at - measured->labels.begin());
      const double deviation = measured->modes.frequency_std_Hz[i] / measured->modes.frequency_Hz[i];
      if (deviation > 0.0) out.push_back({*at, {*mode, deviation}});
    }
  }
  if (out.empty())
    context.warn(
        "no pair of step 6 has a measured frequency with a standard deviation: what monitoring would see of corrosion is not "
        "computed (visible.csv)");
  return out;
}

}  // namespace

io::FieldTable ReliabilityConfig::fields() {
  const io::Range variation = {0.0, 2.0};
  io::FieldTable t;
  t.numbers("speeds", speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true}, "mean wind speeds of the fragility curves")
      .texts("models", models, "models whose critical speeds are computed; empty: all of step 7")
      .text("response_model", response_model, "model for the response to turbulence")
      .number("duration", duration_s, "s", {0.0, io::longest_record_s, true},
              "reference time of the probability that a limit is exceeded")
      .integer("samples", samples, {100.0, 1000000.0}, "samples of the random inputs, for the spread of the probabilities")
      .integer("form_iterations", form_iterations, {1.0, 1e5}, "most iterations of FORM in one search for the design point")
      .integer("subset_levels", subset_levels, {1.0, 100.0},
               "largest number of levels of subset simulation; each reaches probabilities ten times smaller")
      .number("damping_variation", damping_variation, "", variation,
              "coefficient of variation of the structural damping (lognormal about step 7's value); assumed")
      .number("level_variation", level_variation, "", variation,
              "coefficient of variation of the aerodynamic set's level (lognormal about 1); assumed")
      .number("damper_variation", damper_variation, "", variation,
              "coefficient of variation of the dampers' constants (lognormal about 1); paper, Table 1: 5 %")
      .number("turbulence_variation", turbulence_variation, "", variation,
              "coefficient of variation of the turbulence intensity (lognormal about 1); assumed")
      .tables("random", rows_of(random, add_random),
              "a random input of your own; it replaces the input of the same name, or adds a parameter of the model", "name")
      .number("corrosion_variation", corrosion_variation, "", variation,
              "coefficient of variation of the rate of corrosion (lognormal about 1); assumed")
      .number("held_stiffness", held_stiffness_N_m, "N/m", {0.0, 1e12, true},
              "stiffness of the mounts of a held damper without a spring in series; assumed")
      .number("damper_stroke", damper_stroke_m, "m", {0.0, 10.0},
              "largest stroke of a damper in either direction; 0: stroke is not checked")
      .choice("stay_class", stay_class, {"bar", "coil_rope", "spiral_strand", "parallel"},
              "fatigue category of the stays, EN 1993-1-11:2006, table 9.1: bars 105 MPa, locked coil ropes and spiral strands "
              "150 MPa, parallel wires and strands 160 MPa");
  t.text("condition", condition,
         "condition of the measured features, whose standard deviations give the detectability by monitoring; empty: the only "
         "condition");
  add_tables(*this, t);
  return t;
}

ReliabilityInputs read_reliability_inputs(const ReliabilityConfig& config, runner::StepContext& context) {
  if (context.study.empty())
    throw InputError({"", 0, "--study"}, "was not given: steps 7 and 8 of a study say what the wind is",
                     "give --study workflows/<study>");
  AerodynamicsConfig aerodynamics = read_step_7("", context);
  ValidationConfig validation;
  io::FieldTable fields = validation.fields();
  std::string model_of_8, campaign_of_8;  // keys that only step 8 reads; no inputs of this step
  fields.text("model", model_of_8, "of step 8").text("campaign", campaign_of_8, "of step 8");
  fields.load(context.input(context.study / "s8_validation.toml"));
  fields.require();
  wind::TurbulenceSet turbulence = read_turbulence(validation, context);
  std::vector<aero::DeckAerodynamics> data = read_deck_aerodynamics(aerodynamics, context);
  const double level = fitted_level(context, validation.set);
  std::vector<std::string> models = config.models;
  for (const std::string& model : models) static_cast<void>(buffeting::deployment_of(aerodynamics, model));
  if (models.empty())
    for (const aero::Deployment& deployment : aerodynamics.deployments()) models.push_back(deployment.name);
  static_cast<void>(buffeting::deployment_of(aerodynamics, config.response_model));
  dynamics::ReadModel model = load_model(context, context.results / "s6_updating" / "model");
  static_cast<void>(aero::aero_nodes_of(aerodynamics, model.fe_model(), model.source));

  std::vector<reliability::Wall> walls = walls_of(config);
  check_lists(config, walls, model.fe_model());
  std::optional<reliability::WindLaw> law =
      read_wind_law(config.wind_law, aerodynamics.direction_deg, validation.height_m, context);

  std::vector<MonitoredName> monitored;
  if (!walls.empty()) monitored = read_monitored(context, config.condition);
  Inputs inputs = random_inputs(config, aerodynamics.structural_damping, !walls.empty(), model.parameters(), context);
  return {std::move(aerodynamics), std::move(models),        std::move(validation),
          std::move(turbulence),   std::move(data),          level,
          std::move(model),        std::move(inputs.random), std::move(inputs.parameters),
          std::move(walls),        std::move(law),           std::move(monitored)};
}

}  // namespace twindeck::steps
