#include "identification/leading_svd.hpp"

#include <Eigen/Dense>
#include <Eigen/QR>
#include <algorithm>

#include "core/error.hpp"
#include "linalg/canonical_basis.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

Eigen::MatrixXd thin_q(const Eigen::MatrixXd& x) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(x);
  return qr.householderQ() * Eigen::MatrixXd::Identity(x.rows(), x.cols());
}

/// From an orthonormal basis w of the leading right space: A w = Q (R), R = X S Yᵀ; u = Q X, v = w Y. Before that two steps of
/// subspace iteration wash out what the square's rounding, eps sigma_1²/sigma_j², has left of the smaller vectors in the larger
/// ones.
LeadingSvd refined(const Eigen::MatrixXd& a, Eigen::MatrixXd w) {
  for (int step = 0; step < 2; ++step) w = thin_q(linalg::product(a, thin_q(linalg::product(a, w)), true));
  const Eigen::MatrixXd image = linalg::product(a, w), q = thin_q(image);
  const linalg::ThinSvd small = linalg::thin_svd(linalg::product(q, image, true));
  return {linalg::product(q, small.u), small.values, linalg::product(w, small.vt.transpose())};
}

LeadingSvd by_squares(const Eigen::MatrixXd& a, Index n) {
  if (a.cols() <= a.rows()) return refined(a, linalg::leading_eigenpairs(linalg::product(a, a, true), n).vectors);
  const Eigen::MatrixXd at = a.transpose();
  const Eigen::MatrixXd u = linalg::leading_eigenpairs(linalg::product(at, at, true), n).vectors;
  const LeadingSvd turned = refined(at, u);
  return {turned.v, turned.values, turned.u};
}

}  // namespace

LeadingSvd leading_svd(const Eigen::MatrixXd& a, Index n) {
  const Index smaller = std::min(a.rows(), a.cols());
  TWINDECK_ASSERT(n >= 1 && n <= smaller);
  LeadingSvd result;
  if (smaller > 400 && 3 * n < 2 * smaller) {
    result = by_squares(a, n);
  } else {
    const linalg::ThinSvd svd = linalg::thin_svd(a);
    result = {svd.u.leftCols(n), svd.values.head(n), svd.vt.topRows(n).transpose()};
  }
  for (Index j = 0; j < n; ++j) {
    if (result.u(linalg::leading_entry(result.u.col(j).cwiseAbs()), j) < 0.0) {
      result.u.col(j) *= -1.0;
      result.v.col(j) *= -1.0;
    }
  }
  return result;
}

}  // namespace twindeck::identification
