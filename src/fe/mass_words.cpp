#include "fe/mass_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace twindeck::fe {

namespace {

/// What lies below this part of the largest number beside it is rounding, and is shown as 0.
constexpr double shown = 1e-9;

std::string rounded(double value, double largest) {
  return fmt::format("{:.6g}", std::abs(value) > shown * largest ? value : 0.0);
}

}  // namespace

std::string mass_words(const MassProperties& p) {
  const double mass = p.mass_kg.maxCoeff();
  if (!(mass > 0.0)) return "the model has no mass";
  std::string words = fmt::format("mass {:.6g} kg", mass);
  if (mass - p.mass_kg.minCoeff() > shown * mass)
    words =
        fmt::format("mass {:.6g} kg along x, {:.6g} kg along y, {:.6g} kg along z", p.mass_kg[0], p.mass_kg[1], p.mass_kg[2]);
  const double reach = p.centre_m.cwiseAbs().maxCoeff() + std::sqrt(p.inertia_kg_m2.cwiseAbs().maxCoeff() / mass);
  words += fmt::format(", centre of mass at ({}, {}, {}) m; inertia about it, axes x y z:", rounded(p.centre_m[0], reach),
                       rounded(p.centre_m[1], reach), rounded(p.centre_m[2], reach));
  constexpr std::array<const char*, 6> names = {"xx", "yy", "zz", "xy", "xz", "yz"};
  constexpr std::array<std::array<Eigen::Index, 2>, 6> places = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const double largest = p.inertia_kg_m2.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < names.size(); ++i)
    words +=
        fmt::format("{} {} {}", i == 0 ? "" : ",", names[i], rounded(p.inertia_kg_m2(places[i][0], places[i][1]), largest));
  return words + " kg m2";
}

}  // namespace twindeck::fe
