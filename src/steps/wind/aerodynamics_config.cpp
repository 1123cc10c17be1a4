#include "steps/wind/aerodynamics_config.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/limits.hpp"
#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {
namespace {

std::vector<std::string> all_models() {
  std::vector<std::string> names = aero::published_yaw_rule_names();
  names.push_back(aero::oblique_rule);
  return names;
}

/// Each zone of the hybrid deployment lies on a deck.
std::optional<io::FieldTable::Broken> zone_without_a_deck(const AerodynamicsConfig& config) {
  const std::vector<std::string> known = config.deck_names();
  for (const aero::HybridZone& zone : config.hybrid)
    if (!contains(known, zone.deck))
      return io::FieldTable::Broken{
          "hybrid.deck", fmt::format("'{}' is no [[deck]]{}", zone.deck, did_you_mean(zone.deck, known)),
          known.empty() ? "add its [[deck]]" : fmt::format("choose one of {}", fmt::join(known, ", "))};
  return std::nullopt;
}

}  // namespace

io::FieldTable AerodynamicsConfig::fields() {
  const std::vector<std::string> published = aero::published_yaw_rule_names();
  io::FieldTable t;
  t.number("density", density_kg_m3, "kg/m3", io::positive(), "density of air")
      .number("direction_deg", direction_deg, "", {-360.0, 360.0},
              "where the wind blows to, degrees anticlockwise from +X in plan")
      .number("attack_deg", attack_deg, "", {-45.0, 45.0},
              "angle of attack of the wind itself (beta_2 of Fig. 17), degrees, nose-up")
      .integer("nodes_per_deck", nodes_per_deck, {2.0, 1000.0}, "aerodynamic nodes between the end stays of each deck")
      .tables("deck",
              rows_of(decks,
                      [](io::FieldTable& d, aero::DeckWind& deck) {
                        d.text("name", deck.name, "name of the deck", true)
                            .text("cross_group", deck.cross_group,
                                  "group of the elements across the deck, where the model names no aerodynamic nodes")
                            .number("chord", deck.chord_m, "m", io::positive(), "chord B", true)
                            .text("polar", deck.polar, "file of static coefficients", true)
                            .text("flutter", deck.flutter,
                                  "file of flutter derivatives; empty: the polar alone, for the set quasi_steady")
                            .number("arm_drag", deck.arm_drag, "", {}, "quasi-steady p2*/p1*")
                            .number("arm_lift", deck.arm_lift, "", {}, "quasi-steady h2*/h1*")
                            .number("arm_moment", deck.arm_moment, "", {}, "quasi-steady a2*/a1*")
                            .texts("exceptions", deck.exceptions,
                                   "laws that the data break, each with its reason: \"quasi_steady: only h1 was measured\"");
                      }),
              "a deck's aerodynamic data", "name")
      .choice("below_range", below_range, {"refuse", "hold"}, "what a derivative table does below its reduced velocities")
      .choice("above_range", above_range, {"refuse", "hold"}, "what a derivative table does above its reduced velocities")
      .texts("sets", sets,
             "aerodynamic sets: standin (the files), quasi_steady (derivatives from the polars); the first is the main one")
      .choice("fit_model", fit_model, published, "model of Table 11 at which a set's level is fitted")
      .number("fit_speed", fit_speed_m_s, "m/s", io::non_negative(),
              "critical speed to fit it to; 0: take the sets as they are")
      .choices("models", models, all_models(), "models of Table 11")
      .choice("hybrid_inner", hybrid_inner, published, "model of Table 14 at the decks' middle")
      .choice("hybrid_outer", hybrid_outer, published, "model of Table 14 towards the ends")
      .tables("hybrid",
              rows_of(hybrid,
                      [](io::FieldTable& d, aero::HybridZone& zone) {
                        d.text("deck", zone.deck, "name of the deck", true)
                            .number("beyond_deg", zone.beyond_deg, "", {0.0, 90.0},
                                    "yaw beyond which the outer model holds, degrees", true);
                      }),
              "Table 14, a deck", "deck")
      .number("structural_damping", structural_damping, "", {0.0, 0.2}, "damping ratio of each mode without wind")
      .number("identified_damping", identified_damping, "", {0.0, 0.2}, "damping ratio of mode 1 as identified, for comparison")
      .integer("n_modes", n_modes, {1.0, 200.0}, "modes of the reduced structure")
      .integer("followed_modes", followed_modes, {1.0, 200.0}, "modes that are followed over the wind speed")
      .integer("damped_modes", damped_modes, {1.0, 200.0}, "modes that are followed with dampers")
      .number("max_speed", max_speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true}, "highest wind speed")
      .number("speed_step", speed_step_m_s, "m/s", {1e-3, io::highest_wind_m_s}, "step of the wind speed")
      .number("design_speed", design_speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true},
              "design wind speed: of the static comparison and the check with dampers")
      .choice("equations", equations, {"consistent", "as_printed"},
              "Eq. (7) of the moment with its missing chord put in, or as printed")
      .rule([this] { return zone_without_a_deck(*this); });
  return t;
}

}  // namespace twindeck::steps
