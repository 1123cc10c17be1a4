#include "fe/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/definite.hpp"

namespace twindeck::fe {
namespace {

constexpr double no_stiffness = 1e-14;  // relative to the largest diagonal entry of its kind, or as a Rayleigh quotient

[[noreturn]] void refuse(const Eigen::VectorXd& motion, const std::vector<DofLabel>& dofs, const std::string& source,
                         const std::string& context) {
  const MotionWords words = words_of(motion, dofs);
  throw InputError(
      {source, 0, words.node},
      fmt::format("the structure{} is a mechanism: this node{} moves freely in {}", context, words.place, words.directions),
      "hold it by a support, a spring, a link, or an element with stiffness in that direction");
}

/// A very short or very stiff element hides the rest of the structure in the rounding of its own stiffness, which then looks
/// like a mechanism elsewhere. It is the cause where the largest entry of the diagonal is that far above the median.
void refuse_stiff_element(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source) {
  constexpr double hides_the_rest = 1e10;  // [-] of sixteen digits six are left to an element of usual stiffness
  const Eigen::VectorXd diagonal = lower.diagonal();
  std::vector<double> translations;
  Eigen::Index stiffest = 0;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (dofs[static_cast<std::size_t>(i)].direction < 3) translations.push_back(diagonal[i]);
    if (diagonal[i] > diagonal[stiffest]) stiffest = i;
  }
  if (translations.empty()) return;
  const auto middle = translations.begin() + static_cast<std::ptrdiff_t>(translations.size() / 2);
  std::nth_element(translations.begin(), middle, translations.end());
  if (!(diagonal[stiffest] > hides_the_rest * *middle) || !(*middle > 0.0)) return;
  const auto node = [&](Eigen::Index i) { return dofs[static_cast<std::size_t>(i)].node; };
  Eigen::Index other = stiffest;  // the node with which it shares most of that stiffness
  double most = 0.0;
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column) {
    for (linalg::SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      if ((entry.row() != stiffest && column != stiffest) || node(entry.row()) == node(column) ||
          std::abs(entry.value()) <= most)
        continue;
      most = std::abs(entry.value());
      other = entry.row() == stiffest ? column : entry.row();
    }
  }
  const std::string between = node(other) == node(stiffest) ? "" : fmt::format(" and node {}", node(other));
  throw InputError(
      {source, 0, fmt::format("node {}{}", node(stiffest), between)},
      fmt::format("what joins there is {:.0e} times as stiff as is usual in this model: an element is very short or very stiff",
                  diagonal[stiffest] / *middle),
      "check its length, section and modulus; join the nodes by a link where rigid is meant");
}

/// Without a stiffness of its own: nothing at all is joined to the degree of freedom.
void refuse_empty_diagonal(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                           const std::string& context) {
  const Eigen::VectorXd diagonal = lower.diagonal();
  std::array<double, 2> largest = {0.0, 0.0};  // translations, rotations
  const auto kind = [&](std::size_t i) { return dofs[i].direction < 3 ? 0U : 1U; };
  for (std::size_t i = 0; i < dofs.size(); ++i)
    largest[kind(i)] = std::max(largest[kind(i)], diagonal[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (diagonal[static_cast<Eigen::Index>(i)] > no_stiffness * largest[kind(i)]) continue;
    if (diagonal[static_cast<Eigen::Index>(i)] > 0.0) refuse_stiff_element(lower, dofs, source);
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(diagonal.size());
    for (std::size_t j = 0; j < dofs.size(); ++j)  // all such directions of this node at once
      if (dofs[j].node == dofs[i].node && !(diagonal[static_cast<Eigen::Index>(j)] > no_stiffness * largest[kind(j)]))
        motion[static_cast<Eigen::Index>(j)] = 1.0;
    refuse(motion, dofs, source, context);
  }
}

}  // namespace

linalg::Cholesky factorize_or_refuse(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs,
                                     const std::string& source, const std::string& context) {
  TWINDECK_ASSERT(static_cast<std::size_t>(lower.rows()) == dofs.size());
  if (dofs.empty())
    throw InputError({source, 0, "supports"}, "no degree of freedom is free: every node is held or nothing is joined to it",
                     "release a support or add elements");
  const Eigen::VectorXd diagonal = lower.diagonal();
  const auto refuse_motion = [&](const Eigen::VectorXd& motion) {
    refuse_stiff_element(lower, dofs, source);
    refuse(motion, dofs, source, context);
  };
  if (!(diagonal.array() >= 0.0).all() || !std::isfinite(lower.coeffs().sum()))
    refuse_negative_stiffness(lower, dofs, source, context);
  refuse_empty_diagonal(lower, dofs, source, context);

  linalg::Cholesky factor;
  if (!factor.factorize(lower).converged) {
    // A little of the diagonal makes it definite; what it then resists least is the free motion.
    linalg::SparseMatrix shifted = lower;
    shifted.diagonal() *= 1.0 + 1e-9;
    linalg::Cholesky shifted_factor;
    if (shifted_factor.factorize(shifted).converged) refuse_motion(softest_motion(shifted_factor, diagonal, 4));
    refuse_stiff_element(lower, dofs, source);
    refuse_negative_stiffness(lower, dofs, source, context);
    refuse_motion(Eigen::VectorXd::Unit(diagonal.size(), factor.failed_column()));
  }
  const Eigen::VectorXd x = softest_motion(factor, diagonal, 2);
  const double resistance = x.dot(lower.selfadjointView<Eigen::Lower>() * x) / x.dot(diagonal.cwiseProduct(x));
  if (resistance < no_stiffness) refuse_motion(x);
  return factor;
}

void check_no_mechanism(const ParametricSystem& system, const Eigen::VectorXd& theta, const std::string& source) {
  const linalg::Cholesky factor = factorize_or_refuse(system.stiffness(theta), system.dofs, source, "");
  static_cast<void>(factor);
}

MotionWords words_of(const Eigen::VectorXd& motion, const std::vector<DofLabel>& dofs) {
  constexpr std::array<const char*, 6> direction_names = {"x", "y", "z", "rx", "ry", "rz"};
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  const DofLabel& worst = dofs[static_cast<std::size_t>(largest)];
  MotionWords words;
  words.node = "node " + worst.node;
  if (worst.x_m.allFinite()) words.place = fmt::format(" at ({:g}, {:g}, {:g}) m", worst.x_m.x(), worst.x_m.y(), worst.x_m.z());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const double part = std::abs(motion[static_cast<Eigen::Index>(i)] / motion[largest]);
    if (dofs[i].node != worst.node || part < 0.1) continue;
    words.directions +=
        (words.directions.empty() ? "" : ", ") + std::string(direction_names[static_cast<std::size_t>(dofs[i].direction)]);
  }
  return words;
}

Eigen::VectorXd softest_motion(const linalg::Cholesky& factor, const Eigen::VectorXd& diagonal, int iterations) {
  Eigen::VectorXd x(diagonal.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1.0 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  for (int i = 0; i < iterations; ++i) {
    x = factor.solve(diagonal.cwiseProduct(x));
    x /= x.cwiseAbs().maxCoeff();
  }
  return x;
}

}  // namespace twindeck::fe
