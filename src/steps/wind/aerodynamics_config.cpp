#include "steps/wind/aerodynamics_config.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
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
              "direction towards which the wind blows, degrees anticlockwise from +X in plan")
      .number("attack_deg", attack_deg, "", {-45.0, 45.0}, "angle of attack of the wind (beta_2 of Fig. 17), degrees, nose-up")
      .integer("nodes_per_deck", nodes_per_deck, {2.0, 1000.0}, "aerodynamic nodes between the end stays of each deck")
      .tables("deck",
              rows_of(decks,
                      [](io::FieldTable& d, aero::DeckWind& deck) {
                        d.text("name", deck.name, "name of the deck", true)
                            .text("cross_group", deck.cross_group,
                                  "group of the elements across the deck, needed if the model names no aerodynamic nodes")
                            .number("chord", deck.chord_m, "m", io::positive(), "chord B", true)
                            .text("polar", deck.polar, "file of static coefficients", true)
                            .text("flutter", deck.flutter, "file of flutter derivatives; empty: none, for the set quasi_steady")
                            .number("arm_drag", deck.arm_drag, "", {}, "ratio p2*/p1* of the quasi-steady derivatives")
                            .number("arm_lift", deck.arm_lift, "", {}, "ratio h2*/h1* of the quasi-steady derivatives")
                            .number("arm_moment", deck.arm_moment, "", {}, "ratio a2*/a1* of the quasi-steady derivatives")
                            .texts("exceptions", deck.exceptions,
                                   "laws that the data may break, each with a reason: \"quasi_steady: only h1 was measured\"");
                      }),
              "aerodynamic data of one deck", "name")
      .choice("below_range", below_range, {"refuse", "hold"},
              "use of a derivative table below its lowest reduced velocity: refuse, or hold the first value")
      .choice("above_range", above_range, {"refuse", "hold"},
              "use of a derivative table above its highest reduced velocity: refuse, or hold the last value")
      .texts("sets", sets,
             "aerodynamic sets: standin (derivatives from the files), quasi_steady (derivatives from the polars); the first is "
             "the main set")
      .choice("fit_model", fit_model, published, "model of Table 11 whose critical speed the level of each set is fitted to")
      .number("fit_speed", fit_speed_m_s, "m/s", io::non_negative(),
              "critical speed of fit_model to which the level of each set is fitted; 0: no fit")
      .choices("models", models, all_models(), "models of Table 11 that are computed")
      .choice("hybrid_inner", hybrid_inner, published, "hybrid model of Table 14: model of Table 11 at the middle of the decks")
      .choice("hybrid_outer", hybrid_outer, published, "hybrid model of Table 14: model of Table 11 towards the ends")
      .tables("hybrid",
              rows_of(hybrid,
                      [](io::FieldTable& d, aero::HybridZone& zone) {
                        d.text("deck", zone.deck, "name of the deck", true)
                            .number("beyond_deg", zone.beyond_deg, "", {0.0, 90.0},
                                    "hybrid model: yaw angle above which the outer model holds, degrees", true);
                      }),
              "hybrid model of Table 14 on one deck", "deck")
      .number("structural_damping", structural_damping, "", {0.0, 0.2}, "damping ratio of each mode without wind")
      .number("identified_damping", identified_damping, "", {0.0, 0.2}, "identified damping ratio of mode 1, for comparison")
      .integer("n_modes", n_modes, {1.0, 200.0}, "number of modes of the reduced structure")
      .integer("followed_modes", followed_modes, {1.0, 200.0}, "number of modes that are followed over the wind speed")
      .integer("damped_modes", damped_modes, {1.0, 200.0}, "number of modes that are followed over the wind speed with dampers")
      .number("max_speed", max_speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true}, "highest wind speed")
      .number("speed_step", speed_step_m_s, "m/s", {1e-3, io::highest_wind_m_s}, "step of the wind speed")
      .number("design_speed", design_speed_m_s, "m/s", {0.0, io::highest_wind_m_s, true},
              "design wind speed, for the static comparison and the check with dampers")
      .choice("equations", equations, {"consistent", "as_printed"},
              "moment of Eq. (7): consistent (with the chord that is missing in print), or as printed")
      .rule([this] { return zone_without_a_deck(*this); });
  return t;
}

}  // namespace twindeck::steps
