#include "diagnosis/inference/law_coordinates.hpp"

#include "diagnosis/inference/one_law.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Reach = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr Index kRowsOfAFew = 10;  // a class with fewer columns than a tenth of its rows is held by its columns

}  // namespace

LawCoordinates::LawCoordinates(const LawSystem& system) {
  const Index n = system.residual.size();
  Reach by_rows = Reach::Constant(n, false);
  for (const ErrorColumns& c : system.classes) {
    if (c.empty()) continue;
    const Reach reach = (c.columns.array() != 0.0).rowwise().any();
    if (kRowsOfAFew * c.columns.cols() >= reach.count()) by_rows = by_rows || reach;
  }
  for (int r = 0; r < n; ++r) (by_rows[r] ? reached_ : apart_).push_back(r);
  lower_ = linalg::cholesky_factor(system.sigma(apart_, apart_));
  exist_ = lower_.rows() == std::ssize(apart_);
  if (!exist_) return;
  log_determinant_ = 2.0 * lower_.diagonal().array().log().sum();
  across_ = linalg::lower_solve(lower_, system.sigma(apart_, reached_)).transpose();
  MatrixXd few(std::ssize(apart_), 0);
  for (const ErrorColumns& c : system.classes) {
    if (c.empty() || c.columns(apart_, Eigen::all).isZero(0.0)) continue;
    few.conservativeResize(Eigen::NoChange, few.cols() + c.columns.cols());
    few.rightCols(c.columns.cols()) = linalg::lower_solve(lower_, c.columns(apart_, Eigen::all));
  }
  if (few.cols() > 0) few_.emplace(few);
  const Index rows = std::ssize(reached_), size = rows + std::min(few.cols(), few.rows());
  sigma_ = MatrixXd::Identity(size, size);
  sigma_.topLeftCorner(rows, rows) = system.sigma(reached_, reached_) - linalg::square(across_);
  for (const ErrorColumns& c : system.classes) {
    classes_.emplace_back();
    if (c.empty()) continue;
    classes_.back().columns = of(c.columns).topRows(size);
    classes_.back().covariance = linalg::square(classes_.back().columns);
  }
}

MatrixXd LawCoordinates::of(const MatrixXd& rows) const {
  const Index reached = std::ssize(reached_), apart = std::ssize(apart_);
  MatrixXd out(rows.rows(), rows.cols()), whitened = rows(apart_, Eigen::all);
  out.topRows(reached) = rows(reached_, Eigen::all);
  if (!whitened.isZero(0.0)) {
    whitened = linalg::lower_solve(lower_, std::move(whitened));
    out.topRows(reached) -= linalg::product(across_, whitened);
    if (few_) whitened.applyOnTheLeft(few_->householderQ().adjoint());
  }
  out.bottomRows(apart) = whitened;
  return out;
}

}  // namespace twindeck::diagnosis
