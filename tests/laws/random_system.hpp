#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::tests {

/// A grid of springs to its neighbours and to the ground with random stiffness and mass: three groups of springs and two of
/// masses, each with a parameter that its matrix is proportional to (all of K and all of M belong to one). Some dofs carry no
/// mass.
inline fe::ParametricSystem random_system(std::uint64_t seed, int side) {
  std::mt19937_64 draw(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(draw() >> 11) * 0x1.0p-53);
  };
  fe::ParametricSystem s;
  const int n = side * side;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    s.dofs.push_back({std::to_string(i + 1), 2, Eigen::Vector3d(i % side, i / side, 0.0)});
    entries.emplace_back(i, i, 0.0);
    if (i % side > 0) entries.emplace_back(i, i - 1, 0.0);
    if (i >= side) entries.emplace_back(i, i - side, 0.0);
  }
  s.pattern.resize(n, n);
  s.pattern.setFromTriplets(entries.begin(), entries.end());
  for (int g = 0; g < 5; ++g) {
    const bool stiffness = g < 3;
    const double initial = between(0.5, 3.0);
    s.parameters.push_back({(stiffness ? "k" : "m") + std::to_string(g),
                            stiffness ? fe::Target::matrix_stiffness : fe::Target::matrix_mass,
                            {"group"},
                            "-",
                            initial,
                            0.1,
                            10.0});
    fe::Term term;
    term.coefficient.factors = {{g, 1.0, 1.0}};
    std::vector<double> value(static_cast<std::size_t>(s.pattern.nonZeros()), 0.0);
    const int* outer = s.pattern.outerIndexPtr();
    const int* inner = s.pattern.innerIndexPtr();
    for (int column = 0; column < n; ++column) {
      for (int at = outer[column]; at < outer[column + 1]; ++at) {
        const bool diagonal = inner[at] == column;
        const bool massless = column % 7 == 3;
        if (stiffness && !diagonal) {
          const double k = between(0.0, 1.0);
          value[static_cast<std::size_t>(at)] -= k;
          value[static_cast<std::size_t>(outer[column])] += k;
          value[static_cast<std::size_t>(outer[inner[at]])] += k;
        } else if (diagonal && (stiffness || !massless)) {
          value[static_cast<std::size_t>(at)] += between(0.01, stiffness ? 0.05 : 1.0);
        }
      }
    }
    for (int at = 0; at < s.pattern.nonZeros(); ++at) {
      if (value[static_cast<std::size_t>(at)] == 0.0) continue;
      term.position.push_back(at);
      term.value.push_back(value[static_cast<std::size_t>(at)]);
    }
    (stiffness ? s.stiffness_terms : s.mass_terms).push_back(std::move(term));
  }
  return s;
}

}  // namespace twindeck::tests
