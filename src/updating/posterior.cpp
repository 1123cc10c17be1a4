#include "updating/posterior.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double flat_share = 0.5;  ///< [-] of the prior variance; directions that keep more are flat
constexpr double seen_from = 1.0;   ///< [standard deviations] of all rows together; smaller changes are noise

bool alike(const VectorXd& a, const VectorXd& b) {
  if (a.norm() < seen_from || b.norm() < seen_from) return false;
  const VectorXd& larger = a.norm() < b.norm() ? b : a;
  const VectorXd& smaller = a.norm() < b.norm() ? a : b;
  return (smaller - larger * (larger.dot(smaller) / larger.squaredNorm())).norm() < seen_from;
}

}  // namespace

double Posterior::misfit() const { return degrees > 0 ? std::max(1.0, std::sqrt(chi_squared / degrees)) : 1.0; }

double Posterior::chi_squared_score() const {
  if (degrees < 1) return 0.0;
  const double spread = 2.0 / (9.0 * degrees);
  return (std::cbrt(chi_squared / degrees) - (1.0 - spread)) / std::sqrt(spread);
}

Posterior posterior(const Linearised& at, const VectorXd& x, const Box& box, const VectorXd& scale) {
  const Index n = x.size();
  TWINDECK_ASSERT(at.jacobian.cols() == n && at.jacobian.rows() == at.residual.size());
  Posterior out;
  out.is_held = held(x, at.jacobian.transpose() * at.residual, box, UpdatingOptions{}.bound_tolerance);
  const VectorXd prior = (box.upper - box.lower) / std::sqrt(12.0);  // of a uniform distribution
  out.prior_std = prior.cwiseProduct(scale);
  out.std = VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  out.correlation = MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  std::vector<Index> free;
  for (Index j = 0; j < n; ++j)
    if (!out.is_held[static_cast<std::size_t>(j)]) free.push_back(j);
  out.chi_squared = at.residual.squaredNorm();
  out.degrees = std::max(0, static_cast<int>(at.residual.size() - std::ssize(free)) - at.scales);
  if (free.empty()) return out;

  // In units of the prior deviations: C = (1 + (J D)'(J D))⁻¹. Its eigenvalues are the remaining shares of the prior variance.
  const VectorXd unit = prior(free);
  const MatrixXd j = at.jacobian(Eigen::all, free) * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(MatrixXd(j.transpose() * j));
  const VectorXd share = (1.0 + eig.eigenvalues().cwiseMax(0.0).array()).inverse();
  const MatrixXd covariance = eig.eigenvectors() * share.asDiagonal() * eig.eigenvectors().transpose();
  const VectorXd root = covariance.diagonal().cwiseSqrt();
  for (std::size_t a = 0; a < free.size(); ++a) {
    const auto row = static_cast<Index>(a);
    out.std[free[a]] = root[row] * out.prior_std[free[a]];
    for (std::size_t b = 0; b < free.size(); ++b) {
      const auto column = static_cast<Index>(b);
      out.correlation(free[a], free[b]) = a == b ? 1.0 : covariance(row, column) / (root[row] * root[column]);
    }
  }
  for (Index k = 0; k < share.size() && share[k] > flat_share; ++k) {  // eigenvalues ascend, so that shares fall
    VectorXd direction = eig.eigenvectors().col(k);
    Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0.0) direction = -direction;
    FlatDirection flat{VectorXd::Zero(n), (j * direction).norm()};
    for (std::size_t a = 0; a < free.size(); ++a)
      flat.step[free[a]] = direction[static_cast<Index>(a)] * out.prior_std[free[a]];
    out.flat.push_back(std::move(flat));
  }
  return out;
}

std::vector<std::vector<int>> indistinct_sets(const MatrixXd& shifts) {
  const auto n = static_cast<std::size_t>(shifts.cols());
  std::vector<std::size_t> set(n);  // of each parameter, by its first member
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const std::size_t earlier = std::min(set[i], set[j]), later = std::max(set[i], set[j]);
      if (earlier != later && alike(shifts.col(static_cast<Index>(i)), shifts.col(static_cast<Index>(j))))
        std::replace(set.begin(), set.end(), later, earlier);
    }
  }
  std::vector<std::vector<int>> sets;
  for (std::size_t first = 0; first < n; ++first) {
    std::vector<int> members;
    for (std::size_t j = 0; j < n; ++j)
      if (set[j] == first) members.push_back(static_cast<int>(j));
    if (members.size() > 1) sets.push_back(members);
  }
  return sets;
}

}  // namespace twindeck::updating
