#include "updating/reduced_system.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "linalg/dense.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Shared = std::shared_ptr<const MatrixXd>;

/// Q' K_g Q over the rows that the term touches.
MatrixXd project(const linalg::SparseMatrix& pattern, const std::vector<int>& column, const fe::Term& term,
                 const MatrixXd& basis) {
  std::vector<int> local(static_cast<std::size_t>(pattern.rows()), -1);
  const int* inner = pattern.innerIndexPtr();
  for (const int p : term.position) {
    local[static_cast<std::size_t>(inner[p])] = local[static_cast<std::size_t>(column[static_cast<std::size_t>(p)])] = 0;
  }
  std::vector<Index> rows;
  for (std::size_t i = 0; i < local.size(); ++i) {
    if (local[i] < 0) continue;
    local[i] = static_cast<int>(rows.size());
    rows.push_back(static_cast<Index>(i));
  }
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(term.position.size());
  for (std::size_t i = 0; i < term.position.size(); ++i) {
    const auto p = static_cast<std::size_t>(term.position[i]);
    entries.emplace_back(local[static_cast<std::size_t>(inner[p])], local[static_cast<std::size_t>(column[p])], term.value[i]);
  }
  linalg::SparseMatrix small(std::ssize(rows), std::ssize(rows));
  small.setFromTriplets(entries.begin(), entries.end());
  const MatrixXd part = basis(rows, Eigen::all);
  const MatrixXd projected = linalg::product(part, linalg::symmetric_product(small, part), true);
  return 0.5 * (projected + projected.transpose());
}

bool same_term(const fe::Term& a, const fe::Term& b) {
  return a.label == b.label && a.position == b.position && a.value == b.value;
}

std::vector<Shared> project_all(const fe::ParametricSystem& system, const std::vector<fe::Term>& terms, const MatrixXd& basis,
                                const std::vector<fe::Term>* known_terms, const std::vector<Shared>* known) {
  std::vector<int> column(static_cast<std::size_t>(system.pattern.nonZeros()));
  for (int j = 0; j < system.pattern.outerSize(); ++j)
    std::fill(column.begin() + system.pattern.outerIndexPtr()[j], column.begin() + system.pattern.outerIndexPtr()[j + 1], j);
  std::vector<Shared> out(terms.size());
  parallel_for(terms.size(), [&](std::size_t at) {
    if (known_terms != nullptr && at < known_terms->size() && same_term(terms[at], (*known_terms)[at])) {
      out[at] = (*known)[at];
    } else {
      out[at] = std::make_shared<const MatrixXd>(project(system.pattern, column, terms[at], basis));
    }
  });
  return out;
}

MatrixXd combine(const std::vector<fe::Term>& terms, const std::vector<Shared>& projected, const Eigen::VectorXd& theta,
                 Index r) {
  MatrixXd sum = MatrixXd::Zero(r, r);
  for (std::size_t i = 0; i < terms.size(); ++i) sum += terms[i].coefficient.value(theta) * *projected[i];
  return sum;
}

/// Derivative of a sum of terms, applied to vectors (r × m).
MatrixXd slope_times(const std::vector<fe::Term>& terms, const std::vector<Shared>& projected, const Eigen::VectorXd& theta,
                     int parameter, const MatrixXd& z) {
  MatrixXd sum = MatrixXd::Zero(z.rows(), z.cols());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double a = terms[i].coefficient.derivative(theta, parameter);
    if (a != 0.0) sum += a * linalg::product(*projected[i], z);
  }
  return sum;
}

}  // namespace

ReducedSystem::ReducedSystem(std::shared_ptr<const fe::ParametricSystem> system, std::shared_ptr<const MatrixXd> basis,
                             const ReducedSystem* like)
    : system_(std::move(system)), basis_(std::move(basis)) {
  const fe::ParametricSystem* known = like == nullptr ? nullptr : like->system_.get();
  stiffness_ = project_all(*system_, system_->stiffness_terms, *basis_, known ? &known->stiffness_terms : nullptr,
                           known ? &like->stiffness_ : nullptr);
  mass_ =
      project_all(*system_, system_->mass_terms, *basis_, known ? &known->mass_terms : nullptr, known ? &like->mass_ : nullptr);
}

MatrixXd ReducedSystem::stiffness(const Eigen::VectorXd& theta) const {
  return combine(system_->stiffness_terms, stiffness_, theta, basis_->cols());
}

MatrixXd ReducedSystem::mass(const Eigen::VectorXd& theta) const {
  return combine(system_->mass_terms, mass_, theta, basis_->cols());
}

std::pair<Eigen::VectorXd, MatrixXd> ReducedSystem::modes(const Eigen::VectorXd& theta, Index count) const {
  const MatrixXd lower = linalg::cholesky_factor(mass(theta));  // M = L L', (L^-1 K L^-T) y = lambda y, z = L^-T y
  if (lower.size() == 0) return {};
  const MatrixXd half = linalg::lower_solve(lower, stiffness(theta));
  const linalg::LeadingEigenpairs found = linalg::leading_eigenpairs(-linalg::lower_solve(lower, half.transpose()), count);
  return {-found.values, linalg::lower_solve(lower, found.vectors, true)};
}

MatrixXd ReducedSystem::eigenvalue_derivatives(const Eigen::VectorXd& theta, const std::vector<int>& parameters,
                                               const Eigen::VectorXd& lambda, const MatrixXd& z) const {
  MatrixXd derivatives = MatrixXd::Zero(z.cols(), std::ssize(parameters));
  const auto add = [&](const std::vector<fe::Term>& terms, const std::vector<Shared>& projected, const Eigen::VectorXd& sign) {
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      MatrixXd slope;
      for (std::size_t i = 0; i < terms.size(); ++i) {
        const double a = terms[i].coefficient.derivative(theta, parameters[j]);
        if (a == 0.0) continue;
        if (slope.size() == 0) slope = MatrixXd::Zero(z.rows(), z.rows());
        slope += a * *projected[i];
      }
      if (slope.size() == 0) continue;
      const Eigen::VectorXd form = z.cwiseProduct(slope * z).colwise().sum();
      derivatives.col(static_cast<Index>(j)) += sign.cwiseProduct(form);
    }
  };
  add(system_->stiffness_terms, stiffness_, Eigen::VectorXd::Ones(z.cols()));
  add(system_->mass_terms, mass_, -lambda);
  return derivatives;
}

MatrixXd ReducedSystem::shape_derivatives(const Eigen::VectorXd& theta, int parameter, const Eigen::VectorXd& lambda,
                                          const MatrixXd& z, Index count) const {
  constexpr double equal = 1e-8;  // [-] relative difference of eigenvalues that count as equal, as in the full system
  const MatrixXd some = z.leftCols(count);
  const MatrixXd mass = slope_times(system_->mass_terms, mass_, theta, parameter, some);
  const MatrixXd force =
      slope_times(system_->stiffness_terms, stiffness_, theta, parameter, some) - mass * lambda.head(count).asDiagonal();
  MatrixXd share = linalg::product(z, force, true);
  const MatrixXd norm = linalg::product(z, mass, true);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < z.cols(); ++j) {
      const double gap = lambda[i] - lambda[j];
      share(j, i) = std::abs(gap) <= equal * std::abs(lambda[i]) ? -0.5 * norm(j, i) : share(j, i) / gap;
    }
  }
  return linalg::product(z, share);
}

MatrixXd orthonormal_basis(const MatrixXd& vectors, const linalg::SparseMatrix& mass_lower, double loss) {
  const linalg::SparseMatrix mass = linalg::without_zeros(mass_lower);
  MatrixXd basis = vectors;
  for (int pass = 0; pass < 2; ++pass) {  // the second one takes away what rounding left of the first
    MatrixXd gram = linalg::product(basis, linalg::symmetric_product(mass, basis), true);
    gram = 0.5 * (gram + gram.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(gram);
    const double floor = pass == 0 ? loss * loss * eig.eigenvalues().maxCoeff() : 0.0;
    const Index keep = (eig.eigenvalues().array() > floor).count();
    const MatrixXd turn =
        eig.eigenvectors().rightCols(keep) * eig.eigenvalues().tail(keep).cwiseSqrt().cwiseInverse().asDiagonal();
    basis = linalg::product(basis, turn);
  }
  return basis;
}

}  // namespace twindeck::updating
