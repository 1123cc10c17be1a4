#include "sensitivity/frequency_jacobian.hpp"

#include <Eigen/Dense>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"

namespace twindeck::sensitivity {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Column of each stored entry of a sparse matrix.
std::vector<int> columns_of_entries(const linalg::SparseMatrix& pattern) {
  std::vector<int> column(static_cast<std::size_t>(pattern.nonZeros()));
  for (int j = 0; j < pattern.outerSize(); ++j) {
    for (int at = pattern.outerIndexPtr()[j]; at < pattern.outerIndexPtr()[j + 1]; ++at)
      column[static_cast<std::size_t>(at)] = j;
  }
  return column;
}

/// phi_i' K_g phi_i of one term for all modes. @param shapes_by_dof (n_modes × n)
VectorXd quadratic_forms(const linalg::SparseMatrix& pattern, const fe::Term& term, const std::vector<int>& column,
                         const MatrixXd& shapes_by_dof) {
  const int* row = pattern.innerIndexPtr();
  // First the sum over the rows of one column, then times the column's own shape values.
  VectorXd form = VectorXd::Zero(shapes_by_dof.rows()), sum = form;
  int open = -1;
  const auto close = [&] {
    if (open >= 0) form += sum.cwiseProduct(shapes_by_dof.col(open));
    sum.setZero();
  };
  for (std::size_t i = 0; i < term.position.size(); ++i) {
    const int r = row[term.position[i]], c = column[static_cast<std::size_t>(term.position[i])];
    if (c != open) {
      close();
      open = c;
    }
    sum += ((r == c ? 1.0 : 2.0) * term.value[i]) * shapes_by_dof.col(r);
  }
  close();
  return form;
}

/// Adds sign_i · (d coefficient / d theta_p) · phi_i' K_g phi_i of every term to (n_modes × n_parameters). The terms run in
/// parallel; each is summed by one thread.
void add_terms(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms, const std::vector<int>& column,
               const VectorXd& theta, const MatrixXd& shapes_by_dof, const VectorXd& sign, MatrixXd& sum) {
  std::vector<VectorXd> forms(terms.size());
  parallel_for(terms.size(), [&](std::size_t t) {
    if (!terms[t].coefficient.is_constant()) forms[t] = quadratic_forms(system.pattern, terms[t], column, shapes_by_dof);
  });
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (forms[t].size() == 0) continue;
    for (Index p = 0; p < sum.cols(); ++p) {
      const double slope = terms[t].coefficient.derivative(theta, static_cast<int>(p));
      if (slope != 0.0) sum.col(p) += slope * sign.cwiseProduct(forms[t]);
    }
  }
}

/// Eigenvalue derivatives of modes first … first + count - 1 as a subspace, for one parameter.
VectorXd subspace_derivative(const fe::ParametricSystem& system, const VectorXd& theta, const dynamics::EigenModes& modes,
                             Index first, Index count, int parameter) {
  const MatrixXd phi = modes.shapes.middleCols(first, count);
  const double lambda = modes.eigenvalue.segment(first, count).mean();
  const MatrixXd projected = phi.transpose() * (system.stiffness_derivative_times(theta, parameter, phi) -
                                                lambda * system.mass_derivative_times(theta, parameter, phi));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(0.5 * (projected + projected.transpose()));
  MatrixXd likeness = eig.eigenvectors().cwiseAbs();
  VectorXd derivative(count);
  for (Index step = 0; step < count; ++step) {
    Index mode = 0, rotated = 0;
    likeness.maxCoeff(&mode, &rotated);
    derivative[mode] = eig.eigenvalues()[rotated];
    likeness.row(mode).setConstant(-1.0);
    likeness.col(rotated).setConstant(-1.0);
  }
  return derivative;
}

}  // namespace

MatrixXd frequency_jacobian(const fe::ParametricSystem& system, const VectorXd& theta, const dynamics::EigenModes& modes,
                            double cluster_gap) {
  const Index n_modes = modes.eigenvalue.size();
  const auto n_parameters = static_cast<Index>(system.parameters.size());
  MatrixXd d_lambda = MatrixXd::Zero(n_modes, n_parameters);
  const std::vector<int> column = columns_of_entries(system.pattern);
  const MatrixXd shapes_by_dof = modes.shapes.transpose();
  add_terms(system, system.stiffness_terms, column, theta, shapes_by_dof, VectorXd::Ones(n_modes), d_lambda);
  add_terms(system, system.mass_terms, column, theta, shapes_by_dof, -modes.eigenvalue, d_lambda);

  for (Index first = 0, last = 0; first < n_modes; first = last + 1) {
    last = first;
    while (last + 1 < n_modes &&
           modes.eigenvalue[last + 1] - modes.eigenvalue[last] <= cluster_gap * modes.eigenvalue[last + 1])
      ++last;
    if (last == first) continue;
    for (Index p = 0; p < n_parameters; ++p) {
      d_lambda.col(p).segment(first, last - first + 1) =
          subspace_derivative(system, theta, modes, first, last - first + 1, static_cast<int>(p));
    }
  }
  for (Index i = 0; i < n_modes; ++i) {
    const double f = modes.frequency_Hz[i];
    // A rigid-body mode stays one whatever the parameters; its frequency is rounding.
    const bool rigid = f <= 1e-6 * modes.frequency_Hz[n_modes - 1];
    d_lambda.row(i) *= rigid ? 0.0 : 1.0 / (8.0 * std::numbers::pi * std::numbers::pi * f);
  }
  return d_lambda;
}

}  // namespace twindeck::sensitivity
