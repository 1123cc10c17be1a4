#include "fe/definite.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fe/matrix_element.hpp"
#include "fe/mechanism.hpp"

namespace twindeck::fe {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double mass_tolerance = 1e-6;  ///< [-] of the diagonal, see the header
constexpr double stiffness_tolerance =
    1e-11;                              ///< [-] of the diagonal: numbers of twelve digits and rounding of the elimination
constexpr double largest_entry = 1e40;  ///< [SI] and its inverse: beyond, quotients leave the range of doubles; none has 1e20
constexpr double no_mass = 1e-14;       ///< [-] of the largest mass: rounding of nothing

std::string dof_name(const std::vector<DofLabel>& dofs, Index i) {
  VectorXd unit = VectorXd::Zero(std::ssize(dofs));
  unit[i] = 1.0;
  const MotionWords words = words_of(unit, dofs);
  return fmt::format("{}, direction {} (degree of freedom {})", words.node, words.directions, i + 1);
}

[[noreturn]] void refuse(const std::string& source, const std::string& key, const std::string& problem,
                         const std::string& mend) {
  throw InputError({source, 0, key}, problem, mend);
}

/// Entries alone: no negative diagonal, no coupling beyond the geometric mean of what it couples. @return whether M is diagonal
bool check_mass_entries(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source) {
  const VectorXd m = lower.diagonal();
  const double floor = no_mass * m.cwiseAbs().maxCoeff();
  for (Index i = 0; i < m.size(); ++i)
    if (m[i] < -floor)
      refuse(source, dof_name(dofs, i), fmt::format("its mass is {:g}, expected 0 or more", m[i]),
             "mend the sign in the mass matrix, or of what adds to it");
  bool diagonal = true;
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (linalg::SparseMatrix::InnerIterator e(lower, column); e; ++e) {
      if (e.row() == column || e.value() == 0.0) continue;
      diagonal = false;
      const double most = std::sqrt(std::max(m[e.row()], 0.0) + floor) * std::sqrt(std::max(m[column], 0.0) + floor);
      if (std::abs(e.value()) <= (1.0 + mass_tolerance) * most) continue;
      refuse(
          source, dof_name(dofs, e.row()),
          fmt::format("the mass matrix couples it with {} by {:g}, but the two masses are {:g} and {:g}: no structure has that",
                      dof_name(dofs, column), e.value(), m[e.row()], m[column]),
          "a coupling is at most the root of the product of the two masses; mend the matrix");
    }
  }
  return diagonal;
}

bool is_semidefinite(const Eigen::MatrixXd& symmetric) {
  const VectorXd root = symmetric.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (symmetric.diagonal().minCoeff() < 0.0) return false;
  const VectorXd scale = root.unaryExpr([](double r) { return r > 0.0 ? 1.0 / r : 1.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * symmetric * scale.asDiagonal(),
                                                              Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] >= -no_mass * static_cast<double>(symmetric.rows());
}

}  // namespace

void check_sizes(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                 const char* what) {
  const std::string mend = "look for an absurd coordinate, modulus, section, density, spring or matrix entry there";
  double largest = 0.0;
  Index at = 0;
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (linalg::SparseMatrix::InnerIterator e(lower, column); e; ++e) {
      if (!(std::abs(e.value()) <= largest_entry))
        refuse(source, dof_name(dofs, e.row()),
               fmt::format("its {} is {:g}, expected a magnitude of at most {:g}", what, e.value(), largest_entry), mend);
      if (std::abs(e.value()) <= largest) continue;
      largest = std::abs(e.value());
      at = e.row();
    }
  }
  if (largest > 0.0 && largest < 1.0 / largest_entry)
    refuse(source, dof_name(dofs, at),
           fmt::format("its {} is {:g}, the largest of all, expected at least {:g}", what, largest, 1.0 / largest_entry), mend);
}

bool mass_is_a_sum_of_squares(const Model& model) {
  return std::ranges::all_of(model.matrix_elements, [](const MatrixElement& element) {
    if (element.mass.size() == 0) return true;
    const Eigen::MatrixXd mass = conservative_part(element).mass.matrix;
    return mass.allFinite() && is_semidefinite(mass);
  });
}

void check_mass(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                bool sum_of_squares) {
  check_sizes(lower, dofs, source, "mass");
  const VectorXd m = lower.diagonal();
  if (m.size() == 0 || lower.coeffs().isZero(0.0))
    refuse(source, "mass", "no degree of freedom carries mass, so that there are no modes",
           "give densities, point masses or M");
  if (sum_of_squares || check_mass_entries(lower, dofs, source)) return;
  linalg::SparseMatrix raised = lower;
  const double largest = m.maxCoeff();
  for (Index i = 0; i < m.size(); ++i)
    raised.coeffRef(i, i) = m[i] > no_mass * largest ? (1.0 + mass_tolerance) * m[i] : largest;
  raised.makeCompressed();
  linalg::Cholesky factor;
  if (factor.factorize(raised).converged) return;
  refuse(source, dof_name(dofs, factor.failed_column()),
         "the mass matrix is indefinite: with the masses before it, this degree of freedom has a motion of negative kinetic "
         "energy",
         "mend the couplings of the mass matrix there");
}

void refuse_negative_stiffness(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                               const std::string& context) {
  check_sizes(lower, dofs, source, "stiffness");
  const VectorXd k = lower.diagonal();
  const double largest = k.cwiseAbs().maxCoeff();
  if (largest == 0.0) refuse(source, "stiffness", "no degree of freedom has stiffness", "give springs, elements or K");
  for (Index i = 0; i < k.size(); ++i)
    if (k[i] < -stiffness_tolerance * largest)
      refuse(source, dof_name(dofs, i), fmt::format("its stiffness{} is {:g}, expected 0 or more", context, k[i]),
             "mend the sign of the spring or matrix that acts there");
  // So much of the diagonal is added that the matrix is definite; what it then resists least has the most negative stiffness.
  linalg::SparseMatrix raised = lower;
  linalg::Cholesky factor;
  for (double added = stiffness_tolerance; added < 1e3; added *= 100.0) {
    for (Index i = 0; i < k.size(); ++i) raised.coeffRef(i, i) = (1.0 + added) * k[i] + (k[i] > 0.0 ? 0.0 : added * largest);
    if (!factor.factorize(raised).converged) continue;
    if (added == stiffness_tolerance) return;
    const MotionWords words = words_of(softest_motion(factor, raised.diagonal(), 8), dofs);
    refuse(source, words.node,
           fmt::format("the structure{} is unstable: a motion of this node{} in {} has negative stiffness", context,
                       words.place, words.directions),
           "look for a spring or matrix of the wrong sign, or for members and stays that buckle under the forces in them");
  }
  refuse(source, dof_name(dofs, factor.failed_column()), fmt::format("the stiffness matrix{} is indefinite", context),
         "mend the couplings of the stiffness matrix there");
}

}  // namespace twindeck::fe
