#include "steps/reliability/reliability_config.hpp"

#include "io/limits.hpp"

namespace twindeck::steps {

io::FieldTable ReliabilityConfig::fields() {
  random.reserve(256);  // rows are bound to their fields, so they must not move
  const io::Range variation = {0.0, 2.0};
  io::FieldTable t;
  t.numbers("speeds", speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true}, "mean wind speeds of the fragility curves")
      .texts("models", models, "deployments of Table 11 (or hybrid) whose critical speeds are asked for")
      .text("response_model", response_model, "deployment of the response to turbulence")
      .number("duration", duration_s, "s", {0.0, io::longest_record_s, true}, "time in which a limit may be exceeded")
      .integer("samples", samples, {100.0, 1000000.0}, "samples of the random inputs for the spread of probabilities")
      .number("damping_variation", damping_variation, "", variation,
              "coefficient of variation of the structural damping (lognormal about step 7's value); assumed")
      .number("level_variation", level_variation, "", variation,
              "coefficient of variation of the aerodynamic set's level (lognormal about 1); assumed")
      .number("damper_variation", damper_variation, "", variation,
              "coefficient of variation of the dampers' constants (lognormal about 1); paper, Table 1: 5 %")
      .number("turbulence_variation", turbulence_variation, "", variation,
              "coefficient of variation of the turbulence intensity (lognormal about 1); assumed")
      .tables(
          "random",
          [this] {
            random.emplace_back();
            StatedInput& input = random.back();
            io::FieldTable r;
            r.text("name", input.name, "\"parameter:NAME\" of the model, or one of the four above by its name in random.csv",
                   true)
                .choice("law", input.law, {"normal", "lognormal", "uniform", "gumbel", "weibull"}, "law of the input")
                .number("mean", input.mean, "", {-1e300, 1e300}, "mean, in the input's own unit", true)
                .number("deviation", input.deviation, "", {-1e300, 1e300},
                        "standard deviation, in the same unit; 0 keeps it fixed", true)
                .boolean("bounded", input.bounded, "the law is cut to low and high")
                .number("low", input.low_value, "", {-1e300, 1e300}, "least value, where it is bounded")
                .number("high", input.high_value, "", {-1e300, 1e300}, "largest value, where it is bounded")
                .choice("label", input.label, {"paper", "code", "assumed", "identified", "user"}, "kind of the numbers")
                .text("source", input.source, "where they come from");
            return r;
          },
          "a random input of your own: it replaces the one of the same name, or adds a parameter of the model", "name");
  return t;
}

}  // namespace twindeck::steps
