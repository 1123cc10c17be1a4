#pragma once

#include <cmath>

#include "wind/field.hpp"
#include "wind/turbulence.hpp"

/// Points of two curved decks in a wind across them, as the bridge has them: 30 on an arc of 80 m radius over ±54.4°, 30 on one
/// of 100 m over ±36.6°, 16 m behind and 1 m above. Wind of 19.1 m/s, one value for all.
namespace twindeck::wind::test {

/// Ratios and decays of Solari and Piccardo (2001); lengths and intensities at 12 m over z0 = 1 mm as the design note has them.
inline FieldDefinition two_arcs(Component component, Eigen::Index per_deck = 30) {
  FieldDefinition field;
  field.component = component;
  field.position_m.resize(2 * per_deck, 3);
  for (Eigen::Index i = 0; i < 2 * per_deck; ++i) {
    const bool foot = i < per_deck;
    const double part = (static_cast<double>(i % per_deck) + 0.5) / static_cast<double>(per_deck) * 2.0 - 1.0;
    const double radius = foot ? 80.0 : 100.0, angle = (foot ? 0.9495 : 0.6381) * part;
    field.position_m.row(i) << radius * std::cos(angle) - radius + (foot ? 0.0 : 16.0), radius * std::sin(angle),
        foot ? 12.0 : 13.0;
  }
  const auto n = field.size();
  const PerComponent sigma = {0.106 * 19.1, 0.75 * 0.106 * 19.1, 0.50 * 0.106 * 19.1};
  const PerComponent length = {103.0, 0.25 * 103.0, 0.10 * 103.0};
  const std::array<PerComponent, 3> decay = {PerComponent{3.0, 10.0, 10.0}, PerComponent{3.0, 6.5, 6.5},
                                             PerComponent{0.5, 6.5, 3.0}};
  field.speed_m_s = Eigen::VectorXd::Constant(n, 19.1);
  field.sigma_m_s = Eigen::VectorXd::Constant(n, of(sigma, component));
  field.length_m = Eigen::VectorXd::Constant(n, of(length, component));
  field.decay = decay[static_cast<std::size_t>(component)];
  return field;
}

}  // namespace twindeck::wind::test
