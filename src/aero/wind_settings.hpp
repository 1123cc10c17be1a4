#pragma once

#include <string>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "aero/derivative_table.hpp"

namespace twindeck::aero {

/// Aerodynamic data of one deck.
struct DeckWind {
  std::string name;         ///< "foot"
  std::string cross_group;  ///< group of the elements across the deck
  double chord_m = 0.0;
  std::string polar, flutter;                               ///< files
  double arm_drag = 0.0, arm_lift = 0.0, arm_moment = 0.0;  ///< mu/B of quasi-steady derivatives of the rotational rate
  std::vector<std::string> exceptions;                      ///< "law: reason" of laws (aero/laws.hpp) that the data break
};

struct HybridZone {
  std::string deck;
  double beyond_deg = 90.0;
};

inline const std::string oblique_rule = "H_oblique";  ///< aero::oblique_rule_H, beside the published models

/// The wind, the decks that stand in it and the models that are compared: paper section 5.1, Tables 11 and 14.
struct WindSettings {
  double density_kg_m3 = 1.25;
  double direction_deg = 90.0;  ///< where the wind blows to, anticlockwise from +X
  double attack_deg = 0.0;
  long nodes_per_deck = 30;
  std::vector<DeckWind> decks;
  OutOfRange below_range = OutOfRange::refuse, above_range = OutOfRange::refuse;
  std::vector<std::string> sets = {"standin", "quasi_steady"};  ///< the first is the one whose level is reported as main
  std::string fit_model = "A";
  double fit_speed_m_s = 0.0;  ///< 0: level 1, nothing fitted
  std::vector<std::string> models = {"A", "C", "D", "G", "H", "I"};
  std::string hybrid_inner = "A", hybrid_outer = "D";
  std::vector<HybridZone> hybrid;
  double structural_damping = 0.005, identified_damping = 0.011;
  long n_modes = 20, followed_modes = 10, damped_modes = 10;
  double max_speed_m_s = 60.0, speed_step_m_s = 1.0, design_speed_m_s = 40.4;
  Equations equations = Equations::consistent;

  [[nodiscard]] Wind wind() const;
  [[nodiscard]] std::vector<std::string> deck_names() const;
  /// The rules of `models`, then the hybrid deployment of Table 14 where its zones are given.
  [[nodiscard]] std::vector<Deployment> deployments() const;
};

}  // namespace twindeck::aero
