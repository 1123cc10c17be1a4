#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "aero/derivative_table.hpp"
#include "aero/wind_model.hpp"
#include "aero/wind_settings.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"

/// A deck that is one simply supported beam along X in wind along Y, with closed forms of its own. Its aerodynamic nodes are
/// named points at the odd nodes of the mesh, so each stands in the middle of its length.
namespace twindeck::tests {

struct BeamDeck {
  int strips = 8;
  double length = 40.0, E = 200e9, G = 80e9, density = 2000.0, area = 0.75;  // 1500 kg/m
  double I_vertical = 0.01, I_lateral = 0.5, torsion = 0.02;
  double chord = 4.5;

  [[nodiscard]] double mass() const { return density * area; }
  [[nodiscard]] double omega(int j) const {
    return std::pow(j * std::numbers::pi / length, 2) * std::sqrt(E * I_vertical / mass());
  }
  [[nodiscard]] double strip_length() const { return length / strips; }
  [[nodiscard]] double strip_x(int i) const { return (i + 0.5) * strip_length(); }
  [[nodiscard]] int middle() const { return strips; }  ///< node in the middle; the mesh has 2 strips + 1 nodes

  /// Displacement at x under a unit force at a (Euler beam of bending inertia I).
  [[nodiscard]] double influence(double x, double a, double I) const {
    if (x > a) return influence(a, x, I);
    const double b = length - a;
    return b * x * (length * length - b * b - x * x) / (6.0 * length * E * I);
  }
  /// Rotation about X at x under a unit couple at a; both ends are held.
  [[nodiscard]] double twist(double x, double a) const {
    return std::min(x, a) * (length - std::max(x, a)) / (length * G * torsion);
  }

  [[nodiscard]] fe::Model model() const {
    fe::Model m;
    m.source = "beam_deck";
    m.formulation.shear_flexible = false;
    m.formulation.beam_rotary_inertia = false;
    m.materials.push_back({"steel", E, G, 0.25, density});
    fe::Section section;
    section.name = "deck";
    section.area_m2 = area;
    section.inertia_y_m4 = I_vertical;
    section.inertia_z_m4 = I_lateral;
    section.torsion_m4 = torsion;
    m.sections.push_back(section);
    for (int i = 0; i <= 2 * strips; ++i) m.nodes.push_back({i + 1, {0.5 * strip_length() * i, 0.0, 0.0}});
    for (int i = 0; i < 2 * strips; ++i) {
      fe::Element e;
      e.id = i + 1;
      e.group = "deck";
      e.material = e.section = 0;
      e.nodes = {i, i + 1};
      m.elements.push_back(e);
    }
    m.supports.push_back({"left", 0, {true, true, true, true, false, false}});
    m.supports.push_back({"right", 2 * strips, {false, true, true, true, false, false}});
    for (int i = 0; i < strips; ++i)
      m.monitoring_points["aero_deck_" + std::string(i < 9 ? "0" : "") + std::to_string(i + 1)] = 2 * i + 1;
    m.monitoring_points["M1"] = middle();
    m.monitoring_points["M2"] = middle() / 2;
    m.monitoring_points["tower"] = 0;
    return m;
  }
  /// A dashpot to the ground in the middle. @param stiffness_N_m  in series with it; 0: none
  static void add_damper(fe::Model& model, int node, double damping_N_s_m, double stiffness_N_m = 0.0) {
    fe::Spring damper;
    damper.name = "damper";
    damper.group = "damper_deck";
    damper.node = node;
    damper.damping = damping_N_s_m;
    damper.stiffness = stiffness_N_m;
    damper.series = stiffness_N_m > 0.0;
    model.springs.push_back(damper);
  }

  [[nodiscard]] aero::WindSettings settings() const {
    aero::WindSettings s;
    s.nodes_per_deck = strips;
    s.n_modes = 4;
    s.decks.resize(1);
    s.decks[0].name = "deck";
    s.decks[0].chord_m = chord;
    s.structural_damping = 0.005;
    return s;
  }
  /// Heave alone: h1* is the same at every velocity from V* = 0.01 to 1000.
  [[nodiscard]] static std::shared_ptr<const aero::DerivativeTable> heave_table(double h1) {
    std::array<aero::DerivativeCurve, 18> curves;
    for (auto& curve : curves) {
      curve.v_over_omegaB = {0.01, 1000.0};
      curve.value = Eigen::MatrixXd::Zero(1, 2);
    }
    curves[0].value.setConstant(h1);
    return std::make_shared<aero::DerivativeTable>(aero::Convention::zasso, std::vector<double>{0.0}, curves, "heave");
  }
  /// V = 4 m ω ξ/(ρ B |h1|) of mode 1, whatever the shape.
  [[nodiscard]] double galloping_speed(double h1, double ratio) const {
    return 4.0 * mass() * omega(1) * ratio / (1.25 * chord * std::abs(h1));
  }
};

}  // namespace twindeck::tests
