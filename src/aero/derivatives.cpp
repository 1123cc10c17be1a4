#include "aero/derivatives.hpp"

#include <numbers>

#include "core/error.hpp"

namespace twindeck::aero {

namespace {

constexpr int kLateral = 0, kVertical = 1, kPitch = 2;  // motions along y and z, and alpha
// Number 1 … 6 -> motion and kind. Lift and moment of both conventions, and Zasso's drag, count from the vertical motion;
// Scanlan's drag counts from the lateral one.
constexpr std::array<int, 6> motion_vertical_first = {kVertical, kPitch, kPitch, kVertical, kLateral, kLateral};
constexpr std::array<int, 6> motion_lateral_first = {kLateral, kPitch, kPitch, kLateral, kVertical, kVertical};
constexpr std::array<bool, 6> is_damping = {true, true, false, false, true, false};
constexpr std::array<int, 3> row_of_group = {1, 0, 2};  // H, P, A -> L, D, M

// Zasso's value times this is Scanlan's.
double scanlan_per_zasso(const DerivativeEntry& entry, double v) {
  if (entry.damping) return -v;
  return entry.column == kPitch ? v * v : std::numbers::pi / 2;
}

}  // namespace

DerivativeEntry entry_of(Convention convention, int index) {
  TWINDECK_ASSERT(index >= 0 && index < 18);
  const auto group = static_cast<std::size_t>(index / 6), number = static_cast<std::size_t>(index % 6);
  const bool lateral_first = convention == Convention::scanlan && group == 1;
  return {row_of_group[group], lateral_first ? motion_lateral_first[number] : motion_vertical_first[number],
          is_damping[number]};
}

DerivativeBlock to_block(Convention convention, const Derivatives18& values, double v_over_omegaB) {
  DerivativeBlock block;
  for (int i = 0; i < 18; ++i) {
    const DerivativeEntry e = entry_of(convention, i);
    const double factor = convention == Convention::zasso ? scanlan_per_zasso(e, v_over_omegaB) : 1.0;
    (e.damping ? block.damping : block.stiffness)(e.row, e.column) = factor * values[static_cast<std::size_t>(i)];
  }
  return block;
}

Derivatives18 from_block(Convention convention, const DerivativeBlock& block, double v_over_omegaB) {
  Derivatives18 values{};
  for (int i = 0; i < 18; ++i) {
    const DerivativeEntry e = entry_of(convention, i);
    const double factor = convention == Convention::zasso ? scanlan_per_zasso(e, v_over_omegaB) : 1.0;
    values[static_cast<std::size_t>(i)] = (e.damping ? block.damping : block.stiffness)(e.row, e.column) / factor;
  }
  return values;
}

std::string name_of(Convention convention, int index) {
  return (convention == Convention::zasso ? "hpa" : "HPA")[index / 6] + std::to_string(index % 6 + 1);
}

}  // namespace twindeck::aero
