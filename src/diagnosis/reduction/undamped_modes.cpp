#include "diagnosis/reduction/undamped_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;

UndampedModes::UndampedModes(const MatrixXd& k, const MatrixXd& m, double up_to) : stiffness(k), mass(m), highest(up_to) {
  MatrixXd factor = linalg::cholesky_factor(k);
  if (factor.size() == 0) {  // free to move as a rigid body
    shift = 1e-7 * k.trace() / m.trace();
    factor = linalg::cholesky_factor(k + shift * m);
  }
  if (factor.size() == 0) {  // such a structure is unstable and has no modes
    mu = Eigen::VectorXd::Zero(k.rows());
    shapes = MatrixXd::Zero(k.rows(), k.rows());
    return;
  }
  MatrixXd a = linalg::lower_solve(factor, linalg::lower_solve(factor, m).transpose());
  linalg::LeadingEigenpairs all = std::isfinite(highest) ? linalg::eigenpairs_above(std::move(a), 1.0 / (highest + shift))
                                                         : linalg::leading_eigenpairs(std::move(a), k.rows());
  mu = all.values.cwiseMax(0.0);
  shapes = linalg::lower_solve(factor, std::move(all.vectors), true);
}

double UndampedModes::eigenvalue(Index i) const {
  return mu[i] > 0.0 ? std::max(1.0 / mu[i] - shift, 0.0) : std::numeric_limits<double>::infinity();
}

bool UndampedModes::belongs_to(const MatrixXd& k, const MatrixXd& m) const {
  return k.rows() == stiffness.rows() && k == stiffness && m == mass;
}

const UndampedModes& UndampedStore::of(const MatrixXd& stiffness, const MatrixXd& mass, double highest) {
  for (const UndampedStore* store : {shared_, static_cast<const UndampedStore*>(this)})
    if (store != nullptr)
      for (const auto& modes : store->known_)
        if (modes->highest >= highest && modes->belongs_to(stiffness, mass)) return *modes;
  known_.push_back(std::make_shared<const UndampedModes>(stiffness, mass, highest));
  return *known_.back();
}

}  // namespace twindeck::diagnosis
