#include "diagnosis/causes/catalogue.hpp"

#include <algorithm>

namespace twindeck::diagnosis {

const std::map<std::string, std::vector<std::string>>& action_kinds() {
  static const std::map<std::string, std::vector<std::string>> kinds = {
      {"scale.stiffness", {"factor"}},                          // of the place's own stiffness
      {"scale.mass", {"factor"}},                               // of the place's own mass
      {"field.stiffness", {"rate", "reference"}},               // factor 1 + rate (v - reference), v = `variable`
      {"step.stiffness", {"factor", "below"}},                  // factor where v < below
      {"slip.stiffness", {"factor", "above"}},                  // factor where v > above
      {"soften.stiffness", {"half"}},                           // factor 1/(1 + v/half): half is left at v = half
      {"support.move", {"position"}},                           // to another place on its line of beams
      {"support.settle", {"rise"}},                             // of the ground under it, upwards, as load tests see it
      {"mass.add", {"mass"}},                                   // point mass
      {"mass.per_count", {"mass", "assumed"}},                  // mass per person instead of the assumed one
      {"person.oscillator", {"mass", "frequency", "damping"}},  // people as masses on springs
      {"element.spring", {"stiffness"}},                        // to the ground, or between two nodes
      {"element.oscillator", {"mass", "frequency"}},            // tuned mass
      {"element.string", {"mass", "frequency"}},                // first mode of a cable on the moving anchorage
      {"damper.friction", {"stiffness", "threshold"}},          // the damper's mount, held by friction below a force
      {"damper.damping", {"factor"}},
      {"damper.series", {"stiffness"}},  // a spring in series with the dashpot
      {"damper.absent", {}},
      {"damper.move", {}},                     // to where the study says that it might stand
      {"frequency.amplitude", {"curvature"}},  // f (1 + curvature A²)
      {"damping.add", {"ratio"}},              // of critical
      {"stay.pull", {"factor"}},               // of its tension: its frequency goes with the root
      {"stay.frequency", {"factor"}},          // of a stay's own frequencies
      {"channel.gain", {"factor"}},
      {"channel.sign", {}},
      {"channel.swap", {}},
      {"channel.rotate", {"angle"}},           // degrees, towards the horizontal direction beside it
      {"channel.delay", {"delay"}},            // seconds
      {"channel.floor", {"factor"}},           // of the noise floor
      {"channel.limit", {"factor"}},           // RMS of records above `above`
      {"modes.exchange", {}},                  // shapes of a mode and the next one under wrong names
      {"wind.speed_power", {"exponent"}},      // RMS ~ V^(2 + exponent)
      {"wind.skew_power", {"exponent"}},       // RMS ~ |cos beta|^exponent beyond the base's 1
      {"wind.drag", {"factor"}},               // horizontal against vertical motion
      {"wind.lift", {"factor"}},               // vertical against horizontal motion
      {"wind.length_scale", {"factor"}},       // spectrum of turbulence
      {"wind.intensity", {"factor"}},          // of turbulence at winds above the middle one
      {"wind.coherence", {"factor"}},          // decay of coherence
      {"wind.resonance", {"speed", "ratio"}},  // extra response of a mode about a wind speed
      {"wind.damping", {"rate"}},              // damping ratio per m/s
      {"wind.sheltered", {"factor"}},          // places on the lee side of others
  };
  return kinds;
}

const std::vector<std::string>& condition_keys() {
  static const std::vector<std::string> keys = {"amplitude_m",   "temperature_C", "wind_m_s",
                                                "direction_deg", "people",        "dampers"};
  return keys;
}

const std::vector<std::string>& condition_demands() {
  static const std::vector<std::string> demands = {"known", "on", "off", "above_zero"};
  return demands;
}

const std::vector<std::string>& place_numbers() {
  static const std::vector<std::string> names = {
      "damping",   "stiffness", "series", "k_drive", "cable_mass", "length",  "pull",   "f_cable", "deck_mass", "total_mass",
      "always_on", "friction",  "type",   "f_low",   "f_soft",     "f_stiff", "f_high", "f_own",   "f_own_low", "f_own_high"};
  return names;
}

bool is_place_number(const std::string& name) {
  const std::vector<std::string>& known = place_numbers();
  return std::find(known.begin(), known.end(), name) != known.end() || name.starts_with("x_") || name.starts_with("node_") ||
         name == "least_change" || name == "most_change";
}

const std::vector<std::string>& location_sets() {
  static const std::vector<std::string> sets = {
      "elements",    "nodes",  "stays",     "dampers",  "damper_types", "damper_moves", "supports",        "support_moves",
      "foundations", "groups", "all_stays", "channels", "modes",        "global",       "pairs(channels)", "pairs(nodes)"};
  return sets;
}

}  // namespace twindeck::diagnosis
