#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fe/parametric_system.hpp"

/// Mass-spring chains as parametric systems, built by hand: what the tests of dynamics are held against has closed forms.
namespace twindeck::tests {

/// `copies` chains of n masses between n + 1 springs, fixed at both ends. Parameter 0 scales every spring (k = theta_0),
/// parameter 1 every mass (m = theta_1), and with one of its own parameter 2 + c scales the springs of chain c (factor 1).
///   lambda_j = 4 k/m sin²(j pi / (2 (n + 1))), shape sin(j pi i / (n + 1)).
struct SpringChain {
  int n = 10, copies = 1;
  double k = 100.0, m = 2.0;

  [[nodiscard]] double eigenvalue(int j) const {
    return 4.0 * k / m * std::pow(std::sin(j * std::numbers::pi / (2.0 * (n + 1))), 2);
  }
  [[nodiscard]] double frequency_Hz(int j) const { return std::sqrt(eigenvalue(j)) / (2.0 * std::numbers::pi); }

  [[nodiscard]] fe::ParametricSystem system() const {
    fe::ParametricSystem s;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n * copies; ++i) {
      s.dofs.push_back({std::to_string(i + 1), 0, Eigen::Vector3d(i, 0.0, 0.0)});
      entries.emplace_back(i, i, 0.0);
      if (i > 0) entries.emplace_back(i, i - 1, 0.0);  // between chains too: room for a tie
    }
    s.pattern.resize(n * copies, n * copies);
    s.pattern.setFromTriplets(entries.begin(), entries.end());
    s.parameters.push_back({"k", fe::Target::matrix_stiffness, {"springs"}, "N/m", k, 0.1 * k, 10.0 * k});
    s.parameters.push_back({"m", fe::Target::matrix_mass, {"masses"}, "kg", m, 0.1 * m, 10.0 * m});
    for (int c = 0; c < copies; ++c) {
      fe::Term springs, masses;
      const int factor = static_cast<int>(s.parameters.size());
      s.parameters.push_back({"factor_" + std::to_string(c + 1), fe::Target::matrix_stiffness, {"chain"}, "-", 1.0, 0.1, 10.0});
      springs.coefficient.factors = {{0, 1.0, 1.0}, {factor, 1.0, 1.0}};
      masses.coefficient.factors = {{1, 1.0, 1.0}};
      for (int column = c * n; column < (c + 1) * n; ++column) {
        for (int at = s.pattern.outerIndexPtr()[column]; at < s.pattern.outerIndexPtr()[column + 1]; ++at) {
          const int row = s.pattern.innerIndexPtr()[at];
          const bool diagonal = row == column;
          if (row >= (c + 1) * n) continue;
          springs.position.push_back(at);
          springs.value.push_back(diagonal ? 2.0 : -1.0);
          if (!diagonal) continue;
          masses.position.push_back(at);
          masses.value.push_back(1.0);
        }
      }
      s.stiffness_terms.push_back(std::move(springs));
      s.mass_terms.push_back(std::move(masses));
    }
    return s;
  }

  /// Adds a spring of its own at one mass, and its stiffness as the last parameter.
  static void add_ground_spring(fe::ParametricSystem& s, int dof, double stiffness) {
    fe::Term spring;
    spring.coefficient.factors = {{static_cast<int>(s.parameters.size()), 1.0, 1.0}};
    spring.position = {s.pattern.outerIndexPtr()[dof]};
    spring.value = {1.0};
    s.stiffness_terms.push_back(spring);
    s.parameters.push_back(
        {"ground_" + std::to_string(dof), fe::Target::matrix_stiffness, {"ground"}, "N/m", stiffness, -1e3, 1e3});
  }

  /// A spring between neighbouring masses dof and dof + 1: ties the end of one chain to the start of the next.
  static void add_tie(fe::ParametricSystem& s, int dof, double stiffness) {
    const int* outer = s.pattern.outerIndexPtr();
    fe::Term spring;
    spring.position = {outer[dof], outer[dof] + 1, outer[dof + 1]};
    spring.value = {stiffness, -stiffness, stiffness};
    s.stiffness_terms.push_back(spring);
  }
};

}  // namespace twindeck::tests
