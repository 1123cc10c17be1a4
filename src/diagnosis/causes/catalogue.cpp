#include "diagnosis/causes/catalogue.hpp"

#include "core/lists.hpp"

namespace twindeck::diagnosis {

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
  return contains(known, name) || name.starts_with("x_") || name.starts_with("node_") || name == "least_change" ||
         name == "most_change";
}

const std::vector<std::string>& location_sets() {
  static const std::vector<std::string> sets = {
      "elements",    "nodes",  "stays",     "dampers",  "damper_types", "damper_moves", "supports",        "support_moves",
      "foundations", "groups", "all_stays", "channels", "modes",        "global",       "pairs(channels)", "pairs(nodes)"};
  return sets;
}

}  // namespace twindeck::diagnosis
