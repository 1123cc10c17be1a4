#include "steps/wind/validation_config.hpp"

#include <fmt/format.h>

#include <optional>

#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {
namespace {

/// A file must be given for the law `table`, and only for this law.
std::optional<io::FieldTable::Broken> file_without_law(const std::string& key, const std::string& law,
                                                       const std::string& file) {
  if ((law == "table") == !file.empty()) return std::nullopt;
  if (file.empty())
    return io::FieldTable::Broken{key + "_file", "is not given, and the " + key + " is a table", "name the CSV file"};
  return io::FieldTable::Broken{key + "_file", "is given, and the " + key + " is " + law, "write " + key + " = \"table\""};
}

/// Refuses other than three decays, and any decay with davenport, which has one decay for all.
std::optional<io::FieldTable::Broken> wrong_decays(const std::string& letter, const std::vector<double>& decay,
                                                   const std::string& law) {
  if (decay.empty() || (decay.size() == 3 && law != "davenport")) return std::nullopt;
  if (law == "davenport")
    return io::FieldTable::Broken{"decay_" + letter, "is given, and the coherence is davenport, which has one decay",
                                  "give davenport_decay, or write coherence = \"exponential\""};
  return io::FieldTable::Broken{"decay_" + letter, fmt::format("has {} numbers, expected three", decay.size()),
                                "give the decays with separations along, across and vertical"};
}

void add_turbulence(io::FieldTable& t, ValidationConfig& c) {
  t.text("turbulence_file", c.turbulence_file, "file of turbulence sets")
      .text("turbulence_set", c.turbulence_set, "name of the set in turbulence_file")
      .choice("spectrum", c.spectrum, {"von_karman", "kaimal", "en_1991_1_4", "table"},
              "turbulence spectrum as a function of f L / V: von Karman, Kaimal (IEC 61400-1), EN 1991-1-4 B.1, or a table")
      .text("spectrum_file", c.spectrum_file, "table: file with component (v, u, w), f_L_over_V, f_S_over_variance")
      .choice("coherence", c.coherence, {"exponential", "davenport", "table"},
              "coherence of two points as a function of x = f sqrt(sum (C d)^2) / V. exponential: exp(-x), a decay C for each "
              "component and direction; davenport: exp(-x), one decay for all; table: read from coherence_file")
      .text("coherence_file", c.coherence_file, "table: file with component (v, u, w), reduced_separation (x), coherence")
      .number("davenport_decay", c.davenport_decay, "", io::positive(), "davenport: decay C; Davenport (1961) found about 7")
      .numbers("decay_v", c.decay_v, "", io::positive(),
               "decays C of v' for separations along the wind, across it and vertical; empty: those of the set. With decays of "
               "1, x is f d / V")
      .numbers("decay_u", c.decay_u, "", io::positive(),
               "decays C of u', the gust across the wind, in the same three directions; empty: those of the set")
      .numbers("decay_w", c.decay_w, "", io::positive(),
               "decays C of w', the vertical gust, in the same three directions; empty: those of the set")
      .boolean("across", c.across, "gusts u' across the wind also load the decks, because they turn the wind in plan")
      .choice(
          "frequencies", c.frequencies, {"single", "double_indexed"},
          "frequencies of the simulated waves. single: the same at all points; a sample repeats after the length of the "
          "record. double_indexed: Deodatis (1996); a sample repeats after the length of the record times the number of points")
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
         "configuration file of step 7, which gives decks, data, wind direction and damping; empty: the study's")
      .text("set", set, "aerodynamic set, standin or quasi_steady, at the level fitted in step 7");
  add_turbulence(t, *this);
  t.number("height", height_m, "m", io::positive(), "height of the decks above ground, for intensity and length scale")
      .boolean("frozen", frozen, "gusts travel with the mean wind and reach points downwind later (Taylor's hypothesis)")
      .boolean("dampers", dampers, "whether the dampers are fitted")
      .integer("seeds", seeds, {2.0, 1000.0}, "number of turbulence samples of each event and run")
      .integer("n_modes", n_modes, {1.0, 200.0}, "number of modes of the reduced structure")
      .integer("static_shapes", static_shapes, {0.0, 200.0}, "number of static shapes under wind load added to the modes")
      .integer("point_shapes", point_shapes, {0.0, 10.0},
               "number of shapes added for each monitoring point: the static shape under a unit force there (1), then under "
               "the inertia force of the previous shape (2, 3, …)")
      .integer("anchors", anchors, {0.0, 100000.0}, "number of frequencies at which the coherence is factorised; 0: all")
      .number("duration", duration_s, "s", {0.0, io::longest_record_s, true}, "length of a simulated record")
      .number("lead_in", lead_in_s, "s", {0.0, io::longest_record_s}, "time before the record in which the response builds up")
      .number("step", step_s, "s", {1e-5, 1.0 / 64.0}, "time step; at most 1/64 s")
      .number("cutoff", cutoff_Hz, "Hz", {0.0, io::highest_rate_Hz, true}, "frequency from which on the wind has no gusts")
      .number("level", level, "", {0.5, 0.9999}, "probability of the confidence intervals over seeds")
      .choice("equations", equations, {"consistent", "as_printed"}, "Eq. (10) with consistent signs, or as printed")
      .tables(
          "event",
          rows_of(
              events,
              [](io::FieldTable& e, buffeting::WindEvent& event) {
                e.text("name", event.name, "name of the event", true)
                    .number(
                        "speed", event.speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true},
                        "mean wind speed at the decks; a run that is unstable at this speed has empty results and a warning",
                        true)
                    .text("condition", event.condition,
                          "condition of the campaign whose wind records are compared with the simulation; empty: none");
              }),
          "one wind event", "name")
      .tables("run",
              rows_of(runs,
                      [](io::FieldTable& r, buffeting::ValidationRun& run) {
                        r.text("name", run.name, "name of the simulation", true)
                            .text("model", run.model, "model of Table 11 (A, C, D, G, H, I), or hybrid", true);
                      }),
              "one numerical simulation of Table 13", "name")
      .number("comfort_vertical", comfort_vertical_m_s2, "m/s^2", io::positive(),
              "comfort limit of vertical acceleration (EN 1990 A2.4.3.2)")
      .number("comfort_lateral", comfort_lateral_m_s2, "m/s^2", io::positive(), "comfort limit of lateral acceleration (paper)")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "largest distance between a measured channel and the monitoring point of the same name")
      .number("full_model_check", full_model_check_s, "s", {0.0, io::longest_record_s},
              "length of the record for the comparison of the reduced structure with the full model; 0: no comparison");
  return t;
}

}  // namespace twindeck::steps
