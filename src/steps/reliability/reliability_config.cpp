#include "steps/reliability/reliability_config.hpp"

#include "io/limits.hpp"
#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {

namespace {

void add_wall(io::FieldTable& t, StatedWall& wall) {
  t.texts("sections", wall.sections, "sections of sections.csv that corrode alike")
      .number("thickness", wall.thickness_m, "m", {0.0, 10.0},
              "thickness of the wall; 0: round ropes or rods, or a shell's own")
      .integer("sides", wall.sides, {1.0, 2.0}, "surfaces of the wall that corrode")
      .choice("category", wall.category, {"C1", "C2", "C3", "C4", "C5", "CX"}, "category of the atmosphere, ISO 9223")
      .number("first_year", wall.first_year_m, "m", {0.0, 0.1}, "loss of the first year; 0: the middle of the category's range")
      .number("exponent", wall.exponent, "", {0.0, 1.0, true}, "b of D = r t^b, ISO 9224: 0.523, upper bound 0.575")
      .number("coating_life_years", wall.coating_life_years, "", {0.0, 1000.0}, "years until the coating is gone");
}

void add_fault(io::FieldTable& t, StatedFault& fault) {
  t.text("damper", fault.damper, "name of the damper in springs.csv", true)
      .choice("kind", fault.kind, {"held", "lost"}, "held by static friction, or taken out");
}

void add_comfort(io::FieldTable& t, StatedComfort& limit) {
  t.text("name", limit.name, "of the guideline or of your own", true)
      .number("vertical", limit.vertical_m_s2, "m/s2", {0.0, 100.0}, "limit of the vertical acceleration; 0: none")
      .number("lateral", limit.lateral_m_s2, "m/s2", {0.0, 100.0}, "limit of the lateral acceleration; 0: none");
}

void add_random(io::FieldTable& t, StatedInput& input) {
  t.text("name", input.name, "\"parameter:NAME\" of the model, or one of the four above by its name in random.csv", true)
      .choice("law", input.law, {"normal", "lognormal", "uniform", "gumbel", "weibull"}, "law of the input")
      .number("mean", input.mean, "", {-1e300, 1e300}, "mean, in the input's own unit", true)
      .number("deviation", input.deviation, "", {-1e300, 1e300}, "standard deviation, in the same unit; 0 keeps it fixed", true)
      .boolean("bounded", input.bounded, "the law is cut to low and high")
      .number("low", input.low_value, "", {-1e300, 1e300}, "least value, where it is bounded")
      .number("high", input.high_value, "", {-1e300, 1e300}, "largest value, where it is bounded")
      .choice("label", input.label, {"paper", "code", "assumed", "identified", "user"}, "kind of the numbers")
      .text("source", input.source, "where they come from");
}

void add_tables(ReliabilityConfig& config, io::FieldTable& t) {
  t.texts("rare", config.rare,
          "limit states of crossings.csv whose excursion is also found by FORM and by subset simulation (rare.csv)")
      .numbers("years", config.years, "", {0.0, 1000.0}, "years in service that are computed, the first of them 0")
      .tables("wall", rows_of(config.walls, add_wall), "sections that lose thickness")
      .tables("fault", rows_of(config.faults, add_fault), "one damper at fault: a further case with dampers")
      .tables("comfort", rows_of(config.comfort, add_comfort), "comfort limits beside those of step 8", "name")
      .choice("wind_law.kind", config.wind_law.kind_name, {"none", "weibull", "table", "gumbel", "code"},
              "your law of the mean wind at the deck: weibull and table hold all ten-minute means, gumbel and code the largest "
              "of a year; none: no annual figure")
      .number("wind_law.scale", config.wind_law.scale_m_s, "m/s", io::non_negative(), "weibull: scale")
      .number("wind_law.shape", config.wind_law.shape, "", io::positive(), "weibull: shape")
      .number("wind_law.mode", config.wind_law.mode_m_s, "m/s", io::non_negative(), "gumbel: mode")
      .number("wind_law.gumbel_scale", config.wind_law.gumbel_scale_m_s, "m/s", io::non_negative(), "gumbel: scale")
      .number("wind_law.basic_speed", config.wind_law.basic_m_s, "m/s", io::non_negative(),
              "code: basic wind speed v_b of EN 1991-1-4")
      .choice("wind_law.terrain", config.wind_law.terrain, {"0", "I", "II", "III", "IV"}, "code: category of the terrain")
      .text("wind_law.file", config.wind_law.file,
            "table: file with speed_m_s, direction_deg (where the wind blows to, as step 7's), "
            "probability")
      .number("wind_law.sector", config.wind_law.sector_deg, "", {1.0, 360.0},
              "table: winds within half this angle of step 7's direction or its opposite count, others as calm, degrees");
}

}  // namespace

io::FieldTable ReliabilityConfig::fields() {
  const io::Range variation = {0.0, 2.0};
  io::FieldTable t;
  t.numbers("speeds", speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true}, "mean wind speeds of the fragility curves")
      .texts("models", models, "deployments whose critical speeds are asked for; empty: all that step 7 has")
      .text("response_model", response_model, "deployment of the response to turbulence")
      .number("duration", duration_s, "s", {0.0, io::longest_record_s, true}, "time in which a limit may be exceeded")
      .integer("samples", samples, {100.0, 1000000.0}, "samples of the random inputs for the spread of probabilities")
      .integer("form_iterations", form_iterations, {1.0, 1e5}, "iterations of one search of FORM for the design point")
      .integer("subset_levels", subset_levels, {1.0, 100.0},
               "levels of subset simulation; each reaches probabilities ten times smaller")
      .number("damping_variation", damping_variation, "", variation,
              "coefficient of variation of the structural damping (lognormal about step 7's value); assumed")
      .number("level_variation", level_variation, "", variation,
              "coefficient of variation of the aerodynamic set's level (lognormal about 1); assumed")
      .number("damper_variation", damper_variation, "", variation,
              "coefficient of variation of the dampers' constants (lognormal about 1); paper, Table 1: 5 %")
      .number("turbulence_variation", turbulence_variation, "", variation,
              "coefficient of variation of the turbulence intensity (lognormal about 1); assumed")
      .tables("random", rows_of(random, add_random),
              "a random input of your own: it replaces the one of the same name, or adds a parameter of the model", "name")
      .number("corrosion_variation", corrosion_variation, "", variation,
              "coefficient of variation of the rate of corrosion (lognormal about 1); assumed")
      .number("held_stiffness", held_stiffness_N_m, "N/m", {0.0, 1e12, true},
              "stiffness of a held damper that has no spring in series: of its mounts; assumed")
      .number("damper_stroke", damper_stroke_m, "m", {0.0, 10.0}, "largest stroke of a damper to either side; 0: not asked")
      .choice("stay_class", stay_class, {"bar", "coil_rope", "spiral_strand", "parallel"},
              "fatigue category of the stays, EN 1993-1-11:2006, table 9.1: bars 105 MPa, locked coil ropes and spiral strands "
              "150 MPa, parallel wires and strands 160 MPa");
  t.text("condition", condition,
         "condition of the measured features whose standard deviations say what monitoring would see; empty: the only one");
  add_tables(*this, t);
  return t;
}

}  // namespace twindeck::steps
