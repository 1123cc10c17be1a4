#include "steps/wind/validation_config.hpp"

#include <fmt/format.h>

#include <optional>

#include "io/limits.hpp"
#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {
namespace {

/// The file of a law is given where the law is `table`, and only there.
std::optional<io::FieldTable::Broken> file_without_law(const std::string& key, const std::string& law,
                                                       const std::string& file) {
  if ((law == "table") == !file.empty()) return std::nullopt;
  if (file.empty())
    return io::FieldTable::Broken{key + "_file", "is not given, and the " + key + " is a table", "name the CSV file"};
  return io::FieldTable::Broken{key + "_file", "is given, and the " + key + " is " + law, "write " + key + " = \"table\""};
}

/// Three decays of a component, and not with davenport, which has one for all.
std::optional<io::FieldTable::Broken> wrong_decays(const std::string& letter, const std::vector<double>& decay,
                                                   const std::string& law) {
  if (decay.empty() || (decay.size() == 3 && law != "davenport")) return std::nullopt;
  if (law == "davenport")
    return io::FieldTable::Broken{"decay_" + letter, "is given, and the coherence is davenport, which has one decay",
                                  "give davenport_decay, or write coherence = \"exponential\""};
  return io::FieldTable::Broken{"decay_" + letter, fmt::format("has {} numbers, expected three", decay.size()),
                                "give the decays with separations along, across and vertical"};
}

/// Keys of the turbulence: its set and its laws.
void add_turbulence(io::FieldTable& t, ValidationConfig& c) {
  t.text("turbulence_file", c.turbulence_file, "file of turbulence sets")
      .text("turbulence_set", c.turbulence_set, "which of them")
      .choice(
          "spectrum", c.spectrum, {"von_karman", "kaimal", "en_1991_1_4", "table"},
          "spectrum of the turbulence over f L / V: von Karman's, Kaimal's (IEC 61400-1), that of EN 1991-1-4 B.1, or a table")
      .text("spectrum_file", c.spectrum_file, "table: file with component (v, u, w), f_L_over_V, f_S_over_variance")
      .choice("coherence", c.coherence, {"exponential", "davenport", "table"},
              "coherence of two points over x = f sqrt(sum (C d)^2) / V: exp(-x) with a decay C a component and direction; "
              "davenport: the same with one decay of the distance for all; or a table over x")
      .text("coherence_file", c.coherence_file, "table: file with component (v, u, w), reduced_separation (x), coherence")
      .number("davenport_decay", c.davenport_decay, "", io::positive(), "davenport: the decay; Davenport (1961) found about 7")
      .numbers("decay_v", c.decay_v, "", io::positive(),
               "decays C of v' with separations along the wind, across it and vertical; empty: the set's. With decays of 1, x "
               "is f d / V")
      .numbers("decay_u", c.decay_u, "", io::positive(), "the same of u', across the wind")
      .numbers("decay_w", c.decay_w, "", io::positive(), "the same of w', vertical")
      .boolean("across", c.across, "gusts u' across the wind load the decks too: they turn the wind in plan")
      .choice("frequencies", c.frequencies, {"single", "double_indexed"},
              "frequencies of the waves. single: all points share them, and a sample repeats after the record's length. "
              "double_indexed: Deodatis' own (1996), and a sample repeats after the record's length times the number of points")
      .rule([&c] { return file_without_law("spectrum", c.spectrum, c.spectrum_file); })
      .rule([&c] { return file_without_law("coherence", c.coherence, c.coherence_file); })
      .rule([&c] { return wrong_decays("v", c.decay_v, c.coherence); })
      .rule([&c] { return wrong_decays("u", c.decay_u, c.coherence); })
      .rule([&c] { return wrong_decays("w", c.decay_w, c.coherence); })
      .rule([&c]() -> std::optional<io::FieldTable::Broken> {
        if (c.repeats() || c.anchors > 0) return std::nullopt;
        return io::FieldTable::Broken{"anchors",
                                      "is 0: at all double-indexed frequencies the coherence would be factorised too often",
                                      "give at least 2; 40 is the default"};
      });
}

}  // namespace

io::FieldTable ValidationConfig::fields() {
  io::FieldTable t;
  t.text("aerodynamics", aerodynamics,
         "configuration of step 7, whose decks, data, wind direction and damping hold here; empty: the study's")
      .text("set", set, "aerodynamic set: standin or quasi_steady, at the level that step 7 fitted");
  add_turbulence(t, *this);
  t.number("height", height_m, "m", io::positive(), "height of the decks above ground, for intensity and length scale")
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
          rows_of(
              events,
              [](io::FieldTable& e, buffeting::WindEvent& event) {
                e.text("name", event.name, "name of the event", true)
                    .number(
                        "speed", event.speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true},
                        "mean speed at the decks; a run in which a mode grows at this speed has empty results and a warning",
                        true)
                    .text("condition", event.condition,
                          "condition of the campaign whose wind records are the measured side; empty: none");
              }),
          "a wind event", "name")
      .tables("run",
              rows_of(runs,
                      [](io::FieldTable& r, buffeting::ValidationRun& run) {
                        r.text("name", run.name, "name of the simulation", true)
                            .text("model", run.model, "model of Table 11 (A, C, D, G, H, I), or hybrid", true);
                      }),
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
