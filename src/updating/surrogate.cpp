#include "updating/surrogate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "linalg/cholesky.hpp"
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
  for (const int p : term.position)
    local[static_cast<std::size_t>(inner[p])] = local[static_cast<std::size_t>(column[static_cast<std::size_t>(p)])] = 0;
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
    if (known_terms != nullptr && at < known_terms->size() && same_term(terms[at], (*known_terms)[at]))
      out[at] = (*known)[at];
    else
      out[at] = std::make_shared<const MatrixXd>(project(system.pattern, column, terms[at], basis));
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

using Eigen::VectorXd;

/// Directions that are smaller than this part of the largest snapshot are left out of the basis. The resulting error of a
/// frequency is proportional to the square of this number, and the correction by the full system removes it at x_k.
constexpr double kLoss = 1e-4;

/// K^-1 (dK - lambda dM) phi per normalised parameter, for the modes up to the highest compared one.
MatrixXd static_answers(const fe::ParametricSystem& system, const ResidualDefinition& definition, const VectorXd& theta,
                        const dynamics::EigenModes& modes) {
  Index count = 0;
  for (const FrequencyTarget& target : definition.targets) count = std::max<Index>(count, target.reference_mode + 1);
  count = std::min(count, modes.shapes.cols());
  linalg::Cholesky factor;
  if (!factor.factorize(system.stiffness(theta)).converged) return MatrixXd(system.size(), 0);  // a free structure
  const MatrixXd phi = modes.shapes.leftCols(count);
  MatrixXd answers(system.size(), count * std::ssize(definition.active));
  for (std::size_t j = 0; j < definition.active.size(); ++j) {
    const int p = definition.active[j];
    const MatrixXd force = system.stiffness_derivative_times(theta, p, phi) -
                           system.mass_derivative_times(theta, p, phi) * modes.eigenvalue.head(count).asDiagonal();
    const auto at = static_cast<Index>(j);
    answers.middleCols(at * count, count) = definition.scale(at) * factor.solve(force);
  }
  return answers;
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
  for (int pass = 0; pass < 2; ++pass) {  // the second pass removes the rounding of the first
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

std::shared_ptr<const MatrixXd> modal_basis(const std::shared_ptr<const fe::ParametricSystem>& system,
                                            const ResidualDefinition& definition, const MatrixXd& points) {
  const auto n_points = static_cast<int>(points.cols());
  std::vector<dynamics::EigenModes> modes(static_cast<std::size_t>(n_points));
  MatrixXd answers;
  parallel_for(n_points, [&](int k) {
    dynamics::ModalSolver solver(*system);
    int solves = 0;
    modes[static_cast<std::size_t>(k)] = definition.modes_at(points.col(k), solver, solves);
    if (k == 0) answers = static_answers(*system, definition, definition.theta(points.col(k)), modes.front());
  });
  if (!modes.front().status.converged) return nullptr;
  MatrixXd vectors = answers;
  for (const dynamics::EigenModes& one : modes) {
    vectors.conservativeResize(system->size(), vectors.cols() + one.shapes.cols());
    vectors.rightCols(one.shapes.cols()) = one.shapes;
  }
  return std::make_shared<const MatrixXd>(orthonormal_basis(vectors, definition.follower->mass(), kLoss));
}

CorrectedResiduals::CorrectedResiduals(const ReducedSystem& reduced, const ResidualDefinition& definition,
                                       const Surrogate& surrogate, const Evaluation& full)
    : reduced_(&reduced),
      definition_(definition),
      surrogate_(surrogate),
      centre_(full.x),
      shift_(full.residual),
      turn_(full.jacobian) {
  VectorXd residual(full.residual.size());
  MatrixXd jacobian;
  valid_ = reduced_at(centre_, residual, &jacobian);
  if (!valid_) return;
  shift_ -= residual;
  turn_ -= jacobian;
}

bool CorrectedResiduals::operator()(const VectorXd& x, VectorXd& residual, MatrixXd* jacobian) const {
  if (!reduced_at(x, residual, jacobian)) return false;
  residual += shift_ + turn_ * (x - centre_);
  if (jacobian != nullptr) *jacobian += turn_;
  return true;
}

struct CorrectedResiduals::Modes {
  const VectorXd& lambda;  // of all reduced modes
  const MatrixXd& z;
  Index kept;                        // number of modes, from the lowest, that the full system has too
  const std::vector<Index>& mode;    // (n_targets) positions
  const std::vector<int>& position;  // (n_reference)
};

bool CorrectedResiduals::weighted_at(const Modes& modes, const VectorXd& theta, VectorXd& residual, MatrixXd* jacobian) const {
  const WeightedRows& rows = *definition_.weighted;
  ComputedRows computed;
  computed.frequency_Hz = modes.lambda(modes.mode).cwiseSqrt() / (2.0 * std::numbers::pi);
  if (rows.has_shapes()) {
    computed.span = rows.spans_at(modes.position);
    if (computed.span.empty()) return false;
    computed.shape = surrogate_.channels.transpose() * modes.z.leftCols(modes.kept);
  }
  if (jacobian != nullptr) {
    const VectorXd lambda = modes.lambda(modes.mode);
    const MatrixXd slope = reduced_->eigenvalue_derivatives(theta, definition_.active, lambda, modes.z(Eigen::all, modes.mode));
    const VectorXd per_eigenvalue =
        (8.0 * std::numbers::pi * std::numbers::pi * computed.frequency_Hz.array()).inverse().matrix();
    computed.frequency_slope = per_eigenvalue.asDiagonal() * slope * definition_.scale.asDiagonal();
    for (Index j = 0; rows.has_shapes() && j < definition_.scale.size(); ++j)
      computed.shape_slope.push_back(definition_.scale[j] * surrogate_.channels.transpose() *
                                     reduced_->shape_derivatives(theta, definition_.active[static_cast<std::size_t>(j)],
                                                                 modes.lambda, modes.z, modes.kept));
  }
  const Linearised weighted = rows.evaluate(computed, jacobian != nullptr);
  residual = weighted.residual;
  if (jacobian != nullptr) *jacobian = weighted.jacobian;
  return true;
}

bool CorrectedResiduals::reduced_at(const VectorXd& x, VectorXd& residual, MatrixXd* jacobian) const {
  if (!rows_at(x, residual, jacobian)) return false;
  if (definition_.prior.given()) definition_.prior.append(x, residual, jacobian);
  return true;
}

bool CorrectedResiduals::rows_at(const VectorXd& x, VectorXd& residual, MatrixXd* jacobian) const {
  const VectorXd theta = definition_.theta(x);
  const Index n_modes = std::min<Index>(definition_.n_modes, surrogate_.basis->cols());
  // Derivatives of shapes are sums over all reduced modes.
  const bool needs_all = definition_.weighted && definition_.weighted->has_shapes();
  const auto [eigenvalues, vectors] = reduced_->modes(theta, needs_all ? surrogate_.basis->cols() : n_modes);
  if (eigenvalues.size() == 0) return false;
  const VectorXd lambda = eigenvalues.head(n_modes);
  const MatrixXd z = vectors.leftCols(n_modes);
  MatrixXd scaled = z;
  const MatrixXd mass_z = surrogate_.mass * z;
  for (Index j = 0; j < n_modes; ++j) scaled.col(j) /= std::sqrt(z.col(j).dot(mass_z.col(j)));
  const matching::FollowedModes followed = matching::follow_normalised(surrogate_.mass_reference, scaled);

  const auto n = static_cast<Index>(definition_.targets.size());
  std::vector<Index> mode(definition_.targets.size());
  residual.resize(n);
  for (Index i = 0; i < n; ++i) {
    const FrequencyTarget& target = definition_.targets[static_cast<std::size_t>(i)];
    const int at = followed.position[static_cast<std::size_t>(target.reference_mode)];
    if (at < 0 || lambda(at) <= 0.0) return false;
    mode[static_cast<std::size_t>(i)] = at;
    residual(i) = target.fitted ? std::sqrt(lambda(at)) / (2.0 * std::numbers::pi * target.measured_Hz) - 1.0 : 0.0;
  }
  if (definition_.weighted)
    return weighted_at({eigenvalues, vectors, n_modes, mode, followed.position}, theta, residual, jacobian);
  if (jacobian == nullptr) return true;
  const MatrixXd slope =
      reduced_->eigenvalue_derivatives(theta, definition_.active, lambda(mode), MatrixXd(z(Eigen::all, mode)));
  jacobian->setZero(n, definition_.scale.size());
  for (Index i = 0; i < n; ++i) {
    if (!definition_.targets[static_cast<std::size_t>(i)].fitted) continue;
    const double frequency = std::sqrt(lambda(mode[static_cast<std::size_t>(i)])) / (2.0 * std::numbers::pi);
    const double per_eigenvalue = 1.0 / (8.0 * std::numbers::pi * std::numbers::pi * frequency *
                                         definition_.targets[static_cast<std::size_t>(i)].measured_Hz);
    jacobian->row(i) = per_eigenvalue * slope.row(i).cwiseProduct(definition_.scale.transpose());
  }
  return true;
}

}  // namespace twindeck::updating
