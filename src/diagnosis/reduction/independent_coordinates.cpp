#include "diagnosis/reduction/independent_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Energy of a coordinate outside the kept ones, over its whole energy, below which it is dropped. The same part of a cause's
/// flexibility is lost with it. Rounding leaves 1e-14 if the largest part is taken first.
constexpr double kDependent = 1e-8;

std::vector<Index> first_ones(Index n) {
  std::vector<Index> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), Index{0});
  return out;
}

}  // namespace

std::vector<Index> independent_coordinates(const MatrixXd& stiffness, const MatrixXd& mass, Index first) {
  const Index n = stiffness.rows(), own = n - first;
  // A motion with mass and hardly any stiffness is a low mode. The mass gives it energy here.
  const double weight = mass.trace() > 0.0 ? stiffness.trace() / mass.trace() : 0.0;
  const MatrixXd energy = stiffness + weight * mass;
  const MatrixXd factor = linalg::cholesky_factor(energy.topLeftCorner(first, first));
  if (factor.rows() != first) return first_ones(n);
  const MatrixXd along = linalg::lower_solve(factor, energy.topRightCorner(first, own));
  MatrixXd left = energy.bottomRightCorner(own, own) - along.transpose() * along;  // outside the kept coordinates
  const VectorXd whole = energy.diagonal().tail(own);
  std::vector<Index> out = first_ones(first);
  for (Index step = 0; step < own; ++step) {
    Index next = 0;
    const double part = left.diagonal().cwiseQuotient(whole).maxCoeff(&next);
    if (!(part > kDependent)) break;
    out.push_back(first + next);
    const VectorXd taken = left.col(next) / std::sqrt(left(next, next));
    left -= taken * taken.transpose();
  }
  if ((left.diagonal().array() < -kDependent * whole.array()).any()) return first_ones(n);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace twindeck::diagnosis
