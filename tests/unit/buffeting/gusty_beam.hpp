#pragma once

#include "buffeting/bridge_in_wind.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "unit/aero/beam_deck.hpp"

/// The simply supported beam of the tests of aero in turbulent wind.
namespace twindeck::tests {

struct GustyBeam {
  BeamDeck deck;
  buffeting::WindEventSettings config;
  aero::WindSettings aerodynamics;
  wind::TurbulenceSet set;

  GustyBeam() : aerodynamics(deck.settings()) {
    aerodynamics.structural_damping = 0.02;
    config.duration_s = 40.0;
    config.lead_in_s = 20.0;
    config.cutoff_Hz = 4.0;
    config.seeds = 3;
    config.anchors = 10;
    config.static_shapes = 2;
    config.events = {{"August", 15.0, ""}};
    config.runs = {{"NS1", "A"}};
    set.roughness_m = 0.05;
    set.minimum_height_m = 4.0;
    set.kappa = 0.52;
    set.sigma_ratio = {1.0, 0.75, 0.5};
    set.scale_ratio = {1.0, 0.25, 0.1};
    set.decay = {{{3.0, 10.0, 11.0}, {2.0, 6.5, 7.0}, {1.0, 6.0, 5.0}}};
  }
  /// Static coefficients times a factor, and no self-excited forces.
  [[nodiscard]] std::vector<aero::SectionAero> sections(double factor = 1.0) const {
    const aero::StaticCoefficients c{0.2 * factor, -0.1 * factor, 0.0, 0.0, 3.0 * factor, 0.2 * factor};
    return {{"deck", deck.chord, aero::linear_polar(c), std::make_shared<aero::ConstantZasso>(aero::Derivatives18{})}};
  }
  [[nodiscard]] buffeting::BridgeInWind bridge(double factor = 1.0, bool damper = false) const {
    fe::Model model = deck.model();
    if (damper) BeamDeck::add_damper(model, deck.middle(), 4e4, 3e5);
    return buffeting::prepare_bridge_in_wind(config, aerodynamics, dynamics::valid_model(model), sections(factor));
  }
};

}  // namespace twindeck::tests
