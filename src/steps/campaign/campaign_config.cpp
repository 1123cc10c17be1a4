#include "steps/campaign/campaign_config.hpp"

#include "aero/yaw_rule.hpp"
#include "core/error.hpp"
#include "io/limits.hpp"

namespace twindeck::steps {

namespace {

/// Lists grow while their elements are bound to fields: room is made before, so that they stay where they are.
template <typename T>
std::function<io::FieldTable()> appending(std::vector<T>& list, std::function<void(io::FieldTable&, T&)> bind) {
  return [&list, bind] {
    if (list.size() == list.capacity())
      throw InputError({"", 0, ""}, "has more than " + std::to_string(list.size()) + " tables of a kind", "shorten the list");
    list.emplace_back();
    io::FieldTable table;
    bind(table, list.back());
    return table;
  };
}

constexpr std::size_t kMost = 256;

void bind_condition(io::FieldTable& t, ponte::ConditionSettings& c) {
  t.path_name("name", c.name, "condition", "name, as records refer to it", true)
      .boolean("dampers", c.dampers, "whether the dampers are fitted")
      .number("temperature", c.temperature_C, "degC", {-30.0, 60.0}, "of the structure")
      .number("wind", c.wind_m_s, "m/s", io::non_negative(), "mean wind, for conditions.toml alone")
      .integer("people", c.people, io::non_negative(), "on the bridge, for conditions.toml alone")
      .number("force.deck", c.force_deck, "", io::non_negative(),
              "N/sqrt(Hz), white force on each edge point of the decks, in each of three directions")
      .number("force.stay", c.force_stay, "", io::non_negative(), "N/sqrt(Hz), the same on each inner node of a stay")
      .number("force.mast", c.force_mast, "", io::non_negative(), "N/sqrt(Hz), the same on the head of the mast");
}

void bind_record(io::FieldTable& t, ponte::RecordSettings& r) {
  t.path_name("setup", r.setup, "setup", "setup of the layout file", true)
      .choice("kind", r.kind, {"ambient", "free_decay", "wind"},
              "ambient, the decay after a hung mass is let go, or a wind event")
      .path_name("condition", r.condition, "condition", "condition", true)
      .number("duration", r.duration_s, "s", {0.0, io::longest_record_s, true}, "length", true)
      .number("mass", r.mass_kg, "kg", io::non_negative(), "free_decay: mass that is let go")
      .text("point", r.point, "free_decay: point that it hangs from")
      .number("speed", r.speed_m_s, "m/s", {0.0, io::highest_wind_m_s}, "wind: mean speed at the decks")
      .number("direction_deg", r.direction_deg, "", {-360.0, 360.0}, "wind: where it blows to, degrees anticlockwise from +X");
}

void bind_stay(io::FieldTable& t, ponte::StayTest& s) {
  t.path_name("stay", s.stay, "stay", "name of the stay", true)
      .path_name("condition", s.condition, "condition", "condition of the record", true)
      .number("pull", s.pull_N, "N", io::positive(), "T", true)
      .number("lambda_squared", s.lambda_squared, "", io::non_negative(),
              "Irvine's parameter; the axial stiffness follows from it", true)
      .number("damping", s.damping_ratio, "", {0.0, 0.2, true}, "of every mode", true)
      .numbers("imposed", s.imposed_Hz, "Hz", io::positive(),
               "frequencies of the first in-plane modes, where they are not a string's");
}

}  // namespace

io::FieldTable CampaignConfig::fields() {
  named.reserve(kMost);
  temperature.reserve(kMost);
  dampers.reserve(kMost);
  conditions.reserve(kMost);
  records.reserve(kMost);
  stays.reserve(kMost);
  io::FieldTable table;
  table.text("bridge", bridge, "definition of the virtual bridge (variant as_built)", true)
      .text("corrections", corrections, "factors on its parameters, found by --calibrate; empty: none")
      .text("points", points, "points that sensors may stand on", true)
      .text("setups", setups, "setups: channels at points", true)
      .integer("modes", modes, {10.0, 1000.0}, "modes in the basis of the time histories")
      .integer("zones", zones, {1.0, 50.0},
               "stretches from mid-length to the ends whose members and masses are corrected on their own")
      .texts("vibrating_stays", vibrating_stays,
             "stays that are chains of pieces with modes of their own; the others are springs")
      .integer("stay_pieces", stay_pieces, {2.0, 100.0}, "pieces of each stay")
      .number("unevenness", unevenness, "", {0.0, 0.3}, "standard deviation of the slabs' thickness over its nominal value")
      .number("unevenness_wavelength", unevenness_wavelength_m, "m", io::positive(), "longest wavelength of the unevenness")
      .number("reference_temperature", reference_temperature_C, "degC", {-30.0, 60.0}, "at which the named frequencies hold")
      .number("damping.structure", other_damping, "", {0.0, 0.2, true}, "of modes that are not named")
      .number("damping.stays", stay_damping, "", {0.0, 0.2, true}, "of stays; a mode gets a mean by shares of kinetic energy")
      .number("damping.corrections", correction_damping, "", {0.0, 1.0, true}, "of the static corrections")
      .tables("mode",
              appending<ponte::NamedMode>(
                  named,
                  [](io::FieldTable& t, ponte::NamedMode& m) {
                    t.text("name", m.name, "as in the paper's Table 4", true)
                        .number("frequency", m.frequency_Hz, "Hz", io::positive(), "undamped", true)
                        .number("damping", m.damping_ratio, "", {0.0, 0.2, true}, "imposed without dampers", true)
                        .integer("deck_mode", m.deck_mode, {1.0, 1000.0},
                                 "calibration starts here: position among the uncorrected modes that are not mostly stays",
                                 true);
                  }),
              "a named mode", "name")
      .tables("temperature_effect",
              appending<ponte::TemperatureEffect>(temperature,
                                                  [](io::FieldTable& t, ponte::TemperatureEffect& e) {
                                                    t.text("parameter", e.parameter, "parameter of the definition", true)
                                                        .number("per_K", e.per_K, "", {-0.1, 0.1}, "relative change per kelvin",
                                                                true);
                                                  }),
              "what the temperature changes", "parameter")
      .tables("damper",
              appending<ponte::DamperSettings>(dampers,
                                               [](io::FieldTable& t, ponte::DamperSettings& d) {
                                                 t.text("type", d.type, "type as in the definition", true)
                                                     .number("mount_stiffness", d.mount_stiffness_N_m, "N/m",
                                                             io::non_negative(), "of the anchorage; 0: the damper's own spring")
                                                     .number("mount_loss_factor", d.mount_loss_factor, "", {0.0, 2.0},
                                                             "loss factor of the mount at 1 Hz")
                                                     .number("friction", d.friction_N, "N", io::non_negative(),
                                                             "force below which the dashpot stands still");
                                               }),
              "what the definition does not say about a type of damper", "type")
      .tables("condition", appending<ponte::ConditionSettings>(conditions, bind_condition), "a condition", "name")
      .tables("record", appending<ponte::RecordSettings>(records, bind_record), "a record")
      .tables("stay_test", appending<ponte::StayTest>(stays, bind_stay), "a test of a stay by an accelerometer on it")
      .number("stay.duration", stay_duration_s, "s", {0.0, io::longest_record_s, true}, "length of a stay's record")
      .number("stay.force", stay_force, "", io::positive(), "N/sqrt(Hz), white force on each node of the stay")
      .number("stay.sensor", stay_sensor, "", {0.01, 0.5}, "place of the accelerometer over the stay's length")
      .number("logger.rate", rate_Hz, "Hz", {0.0, io::highest_rate_Hz, true}, "sampling rate")
      .integer("logger.substeps", substeps, {1.0, 100.0}, "steps of integration between two samples")
      .integer("logger.second_lag", second_logger_lag, {0.0, 100.0},
               "steps of integration by which the second logger (second half of the channels) lags")
      .number("logger.noise", noise, "m/s^2", io::non_negative(), "RMS of each sensor's noise")
      .number("logger.step", converter_step, "m/s^2", io::non_negative(), "step of the converter")
      .number("logger.range", range, "m/s^2", io::non_negative(), "readings are clipped here; 0: nowhere")
      .number("logger.drift", drift, "m/s^2", io::non_negative(), "drift of the zero over a record")
      .text("wind.aerodynamics", wind_aerodynamics, "wind events: configuration of step 7 whose decks and data hold")
      .text("wind.turbulence_file", wind_turbulence_file, "wind events: file of turbulence sets")
      .text("wind.turbulence_set", wind_turbulence_set, "wind events: which of them")
      .choice("wind.model", wind_model, aero::published_yaw_rule_names(),
              "wind events: model of Table 11 that holds on the virtual bridge")
      .number("wind.height", wind_height_m, "m", io::positive(), "wind events: height of the decks above ground")
      .number("wind.level", wind_level, "", io::positive(), "wind events: level of the synthetic aerodynamic set")
      .number("calibration.spread", correction_spread, "", io::positive(),
              "standard deviation of the logarithm of a correction: how dear it is")
      .number("calibration.frequency", frequency_weight, "", io::positive(),
              "relative standard deviation of the named frequencies in the fit");
  return table;
}

}  // namespace twindeck::steps
