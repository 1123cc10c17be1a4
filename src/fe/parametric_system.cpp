#include "fe/parametric_system.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fe/term_sum.hpp"

namespace twindeck::fe {

namespace {

/// y += a · (symmetric matrix of the term) x, rows of x and y being the vectors' entries of one degree of freedom (m × n).
void add_product(const linalg::SparseMatrix& pattern, const Term& term, double a, const Eigen::MatrixXd& xt,
                 Eigen::MatrixXd& yt) {
  for_each_entry(pattern, term, [&](int row, int column, double value) {
    const double v = a * value;
    yt.col(row) += v * xt.col(column);
    if (row != column) yt.col(column) += v * xt.col(row);
  });
}

/// The same for a term of few entries, without turning the vectors over: y += a · (symmetric matrix of the term) x, (n × m).
void add_small_product(const linalg::SparseMatrix& pattern, const Term& term, double a,
                       const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& y) {
  const int* outer = pattern.outerIndexPtr();
  for (std::size_t i = 0; i < term.position.size(); ++i) {
    const int position = term.position[i], row = pattern.innerIndexPtr()[position];
    const auto column = std::upper_bound(outer, outer + pattern.outerSize() + 1, position) - outer - 1;
    const double v = a * term.value[i];
    y.row(row) += v * x.row(column);
    if (row != column) y.row(column) += v * x.row(row);
  }
}

Eigen::MatrixXd derivative_times(const linalg::SparseMatrix& pattern, const std::vector<Term>& terms,
                                 const Eigen::VectorXd& theta, int parameter, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  TWINDECK_ASSERT(x.rows() == pattern.rows());
  std::vector<double> slope(terms.size());
  std::ranges::transform(terms, slope.begin(), [&](const Term& term) { return term.coefficient.derivative(theta, parameter); });
  std::size_t entries = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) entries += slope[t] != 0.0 ? terms[t].position.size() : 0;
  if (entries < static_cast<std::size_t>(x.rows()) / 10) {  // a spring, a few bars, nothing at all
    Eigen::MatrixXd y = Eigen::MatrixXd::Zero(x.rows(), x.cols());
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (slope[t] != 0.0) add_small_product(pattern, terms[t], slope[t], x, y);
    return y;
  }
  const Eigen::MatrixXd xt = x.transpose();
  Eigen::MatrixXd yt = Eigen::MatrixXd::Zero(x.cols(), x.rows());
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (slope[t] != 0.0) add_product(pattern, terms[t], slope[t], xt, yt);
  return yt.transpose();
}

}  // namespace

linalg::SparseMatrix combine(const linalg::SparseMatrix& pattern, const std::vector<Term>& terms,
                             const Eigen::VectorXd& theta) {
  linalg::SparseMatrix sum = pattern;
  double* values = sum.valuePtr();
  std::fill(values, values + sum.nonZeros(), 0.0);
  for (const Term& term : terms) {
    const double a = term.coefficient.value(theta);
    for (std::size_t i = 0; i < term.position.size(); ++i) values[term.position[i]] += a * term.value[i];
  }
  return sum;
}

Eigen::VectorXd ParametricSystem::initial() const {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) theta[static_cast<Eigen::Index>(i)] = parameters[i].initial;
  return theta;
}

linalg::SparseMatrix ParametricSystem::stiffness(const Eigen::VectorXd& theta) const {
  return combine(pattern, stiffness_terms, theta);
}

linalg::SparseMatrix ParametricSystem::mass(const Eigen::VectorXd& theta) const { return combine(pattern, mass_terms, theta); }

Eigen::MatrixXd ParametricSystem::stiffness_derivative_times(const Eigen::VectorXd& theta, int parameter,
                                                             const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  return derivative_times(pattern, stiffness_terms, theta, parameter, x);
}

Eigen::MatrixXd ParametricSystem::mass_derivative_times(const Eigen::VectorXd& theta, int parameter,
                                                        const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  return derivative_times(pattern, mass_terms, theta, parameter, x);
}

Eigen::MatrixXd ParametricSystem::expand(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  if (expansion.size() == 0) return x;
  TWINDECK_ASSERT(x.rows() == expansion.cols());
  return expansion * x;
}

}  // namespace twindeck::fe
