#include "fe/mechanism.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/definite.hpp"
#include "fe/motion_words.hpp"

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

/// Without a stiffness of its own: nothing at all is joined to the degree of freedom.
void refuse_empty_diagonal(const Eigen::VectorXd& diagonal, const std::vector<DofLabel>& dofs, const std::string& source,
                           const std::string& context) {
  std::array<double, 2> largest = {0.0, 0.0};  // translations, rotations
  const auto kind = [&](std::size_t i) { return dofs[i].direction < 3 ? 0U : 1U; };
  for (std::size_t i = 0; i < dofs.size(); ++i)
    largest[kind(i)] = std::max(largest[kind(i)], diagonal[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (diagonal[static_cast<Eigen::Index>(i)] > no_stiffness * largest[kind(i)]) continue;
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
  if (!(diagonal.array() >= 0.0).all() || !std::isfinite(lower.coeffs().sum()))
    refuse_negative_stiffness(lower, dofs, source, context);
  refuse_empty_diagonal(diagonal, dofs, source, context);

  linalg::Cholesky factor;
  if (!factor.factorize(lower).converged) {
    // A little of the diagonal makes it definite; what it then resists least is the free motion.
    linalg::SparseMatrix shifted = lower;
    shifted.diagonal() *= 1.0 + 1e-9;
    linalg::Cholesky shifted_factor;
    if (shifted_factor.factorize(shifted).converged) refuse(softest_motion(shifted_factor, diagonal, 4), dofs, source, context);
    refuse_negative_stiffness(lower, dofs, source, context);
    refuse(Eigen::VectorXd::Unit(diagonal.size(), factor.failed_column()), dofs, source, context);
  }
  const Eigen::VectorXd x = softest_motion(factor, diagonal, 2);
  const double resistance = x.dot(lower.selfadjointView<Eigen::Lower>() * x) / x.dot(diagonal.cwiseProduct(x));
  if (resistance < no_stiffness) refuse(x, dofs, source, context);
  return factor;
}

void check_no_mechanism(const ParametricSystem& system, const Eigen::VectorXd& theta, const std::string& source) {
  const linalg::Cholesky factor = factorize_or_refuse(system.stiffness(theta), system.dofs, source, "");
  static_cast<void>(factor);
}

}  // namespace twindeck::fe
