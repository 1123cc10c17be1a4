#include "linalg/canonical_basis.hpp"

#include <cmath>

namespace twindeck::linalg {

using Eigen::Index;

namespace {

/// [-] relative. Equal entries of a computed mode differ by some 1e-9; unequal ones this close are rare.
constexpr double kAlike = 1e-6;
/// [-] relative, of eigenvalues. Those of one cluster are computed to 1e-11; turned vectors satisfy their equation to this.
constexpr double kOneValue = 1e-8;

void turn(Eigen::Ref<Eigen::MatrixXd> cluster) {
  for (Index first = 0; first < cluster.cols(); ++first) {
    auto rest = cluster.rightCols(cluster.cols() - first);
    const Eigen::VectorXd magnitudes = rest.rowwise().norm();
    const Index pivot = leading_entry(magnitudes);
    if (rest.cols() > 1 && magnitudes[pivot] > 0.0) {
      // Householder's reflection of the pivot's row onto the first vector.
      Eigen::VectorXd u = rest.row(pivot).transpose();
      u[0] += std::copysign(magnitudes[pivot], u[0]);
      rest -= (rest * u).eval() * (2.0 / u.squaredNorm() * u.transpose());
    }
    if (rest(pivot, 0) < 0.0) rest.col(0) *= -1.0;
  }
}

}  // namespace

Index leading_entry(const Eigen::Ref<const Eigen::VectorXd>& magnitudes) {
  const double enough = (1.0 - kAlike) * magnitudes.maxCoeff();
  Index at = 0;
  while (at + 1 < magnitudes.size() && !(magnitudes[at] >= enough)) ++at;
  return at;
}

void choose_basis(const Eigen::VectorXd& values, Eigen::MatrixXd& vectors) {
  for (Index first = 0, end = 0; first < vectors.cols(); first = end) {
    end = first + 1;
    while (end < vectors.cols() && values[end] - values[end - 1] <= kOneValue * std::abs(values[end])) ++end;
    turn(vectors.middleCols(first, end - first));
  }
}

}  // namespace twindeck::linalg
