#pragma once

#include <array>
#include <string>

/// Turbulent wind. Wind axes: `along` in the direction to which the mean wind blows, `vertical` up, `across` = vertical ×
/// along. One-sided spectra per Hz: the integral over f > 0 is the variance.
namespace twindeck::wind {

/// Components of the turbulence. The paper's frame has Y downwind: its v' is along, u' (along the deck) is across, w' vertical.
enum class Component { along = 0, across = 1, vertical = 2 };
inline constexpr std::array<Component, 3> components = {Component::along, Component::across, Component::vertical};

/// "v", "u", "w": the paper's letters, Eq. (12).
[[nodiscard]] inline std::string paper_letter(Component component) {
  return component == Component::along ? "v" : component == Component::across ? "u" : "w";
}

/// One value per component.
using PerComponent = std::array<double, 3>;
[[nodiscard]] inline double of(const PerComponent& values, Component component) {
  return values[static_cast<std::size_t>(component)];
}

}  // namespace twindeck::wind
