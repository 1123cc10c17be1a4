#include "steps/wind/validation_config.hpp"

#include "io/limits.hpp"

namespace twindeck::steps {

io::FieldTable ValidationConfig::fields() {
  events.reserve(64);  // rows are bound to their fields, so they must not move
  runs.reserve(64);
  io::FieldTable t;
  t.text("aerodynamics", aerodynamics,
         "configuration of step 7, whose decks, data, wind direction and damping hold here; empty: the study's")
      .text("set", set, "aerodynamic set: standin or quasi_steady, at the level that step 7 fitted")
      .text("turbulence_file", turbulence_file, "file of turbulence sets")
      .text("turbulence_set", turbulence_set, "which of them")
      .number("height", height_m, "m", io::positive(), "height of the decks above ground, for intensity and length scale")
      .boolean("frozen", frozen, "gusts drift with the wind (Taylor's hypothesis): points behind each other meet them later")
      .boolean("dampers", dampers, "the dampers are fitted")
      .integer("seeds", seeds, {2.0, 1000.0}, "samples of the turbulence, each of all events and runs")
      .integer("n_modes", n_modes, {1.0, 200.0}, "modes of the reduced structure")
      .integer("static_shapes", static_shapes, {0.0, 200.0}, "static shapes of the wind loads beside them")
      .integer("point_shapes", point_shapes, {0.0, 10.0},
               "shapes of each monitoring point's own direction: static (1), of its inertia (2), of the inertia of that (3)")
      .integer("anchors", anchors, {0.0, 100000.0}, "frequencies at which the coherence is factorised; 0: all")
      .number("duration", duration_s, "s", {0.0, io::longest_record_s, true}, "length of a record")
      .number("lead_in", lead_in_s, "s", {0.0, io::longest_record_s}, "time before the record in which the response builds up")
      .number("step", step_s, "s", {1e-5, 1.0 / 64.0}, "time step; at most 1/64 s")
      .number("cutoff", cutoff_Hz, "Hz", {0.0, io::highest_rate_Hz, true}, "no wind at or above this frequency")
      .number("level", level, "", {0.5, 0.9999}, "level of the confidence intervals over seeds")
      .choice("equations", equations, {"consistent", "as_printed"}, "Eq. (10) with signs that can hold together, or as printed")
      .tables(
          "event",
          [this] {
            events.emplace_back();
            buffeting::WindEvent& event = events.back();
            io::FieldTable e;
            e.text("name", event.name, "name of the event", true)
                .number("speed", event.speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true},
                        "mean speed at the decks; a run in which a mode grows at this speed has empty results and a warning",
                        true)
                .text("condition", event.condition,
                      "condition of the campaign whose wind records are the measured side; empty: none");
            return e;
          },
          "a wind event", "name")
      .tables(
          "run",
          [this] {
            runs.emplace_back();
            buffeting::ValidationRun& run = runs.back();
            io::FieldTable r;
            r.text("name", run.name, "name of the simulation", true)
                .text("model", run.model, "model of Table 11 (A, C, D, G, H, I), or hybrid", true);
            return r;
          },
          "a numerical simulation of Table 13", "name")
      .number("comfort_vertical", comfort_vertical_m_s2, "m/s^2", io::positive(),
              "comfort limit of vertical acceleration (EN 1990 A2.4.3.2)")
      .number("comfort_lateral", comfort_lateral_m_s2, "m/s^2", io::positive(),
              "comfort limit of lateral acceleration, as the paper has it")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "largest distance of a measured channel from the monitoring point whose name it has")
      .number("full_model_check", full_model_check_s, "s", {0.0, io::longest_record_s},
              "length of the record on which the reduced structure is compared with the full model; 0: not compared");
  return t;
}

}  // namespace twindeck::steps
