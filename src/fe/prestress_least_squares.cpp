#include "fe/prestress_least_squares.hpp"

#include <Eigen/Dense>
#include <vector>

namespace twindeck::fe {

namespace {

/// Least squares over the free unknowns alone, the others zero.
Eigen::VectorXd solve_free(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const std::vector<bool>& is_free) {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (is_free[i]) columns.push_back(static_cast<Eigen::Index>(i));
  const Eigen::VectorXd z = a(Eigen::indexing::all, columns).colPivHouseholderQr().solve(b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  x(columns) = z;
  return x;
}

}  // namespace

BoundedLeastSquares solve_bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double lower) {
  // y = x - lower >= 0 turns the bound into Lawson and Hanson's; columns of unit length make one tolerance serve all.
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd length = a.colwise().norm().transpose();
  const Eigen::MatrixXd scaled = a * length.cwiseInverse().asDiagonal();
  const Eigen::VectorXd rest = b - a * Eigen::VectorXd::Constant(n, lower);
  const double tolerance = 1e-12 * (1.0 + rest.norm());

  std::vector<bool> is_free(static_cast<std::size_t>(n), false);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  const auto finish = [&](Status status) {
    return BoundedLeastSquares{Eigen::VectorXd::Constant(n, lower) + y.cwiseQuotient(length), std::move(status)};
  };
  for (Eigen::Index outer = 0; outer < 10 * n; ++outer) {
    const Eigen::VectorXd descent = scaled.transpose() * (rest - scaled * y);
    Eigen::Index steepest = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!is_free[static_cast<std::size_t>(i)] && descent[i] > tolerance && (steepest < 0 || descent[i] > descent[steepest]))
        steepest = i;
    if (steepest < 0) return finish({});
    is_free[static_cast<std::size_t>(steepest)] = true;

    Eigen::VectorXd z = solve_free(scaled, rest, is_free);
    while (true) {
      double step = 1.0;
      for (Eigen::Index i = 0; i < n; ++i)
        if (is_free[static_cast<std::size_t>(i)] && z[i] <= 0.0) step = std::min(step, y[i] / (y[i] - z[i]));
      if (step >= 1.0) break;
      y += step * (z - y);
      for (Eigen::Index i = 0; i < n; ++i)
        if (is_free[static_cast<std::size_t>(i)] && z[i] <= 0.0 && y[i] <= 1e-14 * (1.0 + y.cwiseAbs().maxCoeff())) {
          y[i] = 0.0;
          is_free[static_cast<std::size_t>(i)] = false;
        }
      z = solve_free(scaled, rest, is_free);
    }
    y = z;
  }
  return finish({false, "the active set of the pulls did not settle"});
}

}  // namespace twindeck::fe
