#include "sensitivity/shape_sensitivity.hpp"

#include <numeric>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "linalg/block_lanczos.hpp"
#include "linalg/dense.hpp"
#include "sensitivity/modal_forces.hpp"

namespace twindeck::sensitivity {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using linalg::product;
using linalg::subtract_product;

constexpr double kTolerance = 1e-7;     ///< of the residual in the energy norm, relative to the right-hand side's
constexpr int kMaxIterations = 300;     ///< far above what distinct eigenvalues need (three to ten)
constexpr Index kFurtherModes = 20;     ///< modes above the given ones that the preconditioner knows
constexpr double kFurtherError = 1e-2;  ///< how well: they only hasten

VectorXd column_dots(const MatrixXd& a, const MatrixXd& b) { return a.cwiseProduct(b).colwise().sum(); }

/// Columns `kept` of a matrix, to its front.
void keep_columns(MatrixXd& a, const std::vector<Index>& kept) {
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] != static_cast<Index>(k)) a.col(static_cast<Index>(k)) = a.col(kept[k]);
  }
  a.conservativeResize(Eigen::NoChange, static_cast<Index>(kept.size()));
}

/// Conjugate gradients on A - s_i M for each column i by itself, A = K - shift M. The preconditioner is A⁻¹, and on the further
/// modes g_j, of Rayleigh quotient a_j, g_j (1/(a_j - s_i)) g_j'. So A times a direction needs no product: A A⁻¹ r = r.
struct ConjugateGradients {
  std::vector<Index> column;  ///< of the whole system, for each that is not solved yet
  VectorXd eigenvalue;        ///< s_i
  MatrixXd residual, solution;
  MatrixXd direction, a_direction, mass_direction;  ///< p, A p, M p
  VectorXd energy, floor;

  ConjugateGradients(MatrixXd right, VectorXd values)
      : column(static_cast<std::size_t>(right.cols())),
        eigenvalue(std::move(values)),
        residual(std::move(right)),
        solution(MatrixXd::Zero(residual.rows(), residual.cols())) {
    std::iota(column.begin(), column.end(), Index{0});
  }

  /// New directions from the preconditioned residual y. @param a_y, mass_y  A y, M y
  void turn(MatrixXd y, MatrixXd a_y, const MatrixXd& mass_y) {
    const VectorXd next = column_dots(residual, y);
    if (direction.size() == 0) {
      floor = kTolerance * kTolerance * next;
      direction = std::move(y), a_direction = std::move(a_y), mass_direction = mass_y;
    } else {
      const VectorXd back = next.cwiseQuotient(energy);
      direction = y + direction * back.asDiagonal();
      a_direction = a_y + a_direction * back.asDiagonal();
      mass_direction = mass_y + mass_direction * back.asDiagonal();
    }
    energy = next;
  }

  /// A step along the directions. Columns that are solved go to `solved`.
  void step(MatrixXd& solved) {
    std::vector<Index> kept;
    for (Index i = 0; i < residual.cols(); ++i) {
      const double curvature =
          direction.col(i).dot(a_direction.col(i)) - eigenvalue[i] * direction.col(i).dot(mass_direction.col(i));
      if (energy[i] > floor[i] && curvature > 0.0) {
        const double length = energy[i] / curvature;
        solution.col(i) += length * direction.col(i);
        residual.col(i) -= length * (a_direction.col(i) - eigenvalue[i] * mass_direction.col(i));
        kept.push_back(i);
      } else {
        solved.col(column[static_cast<std::size_t>(i)]) = solution.col(i);
      }
    }
    if (kept.size() < column.size()) keep(kept);
  }

 private:
  void keep(const std::vector<Index>& kept) {
    for (MatrixXd* a : {&residual, &solution, &direction, &a_direction, &mass_direction}) keep_columns(*a, kept);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const auto to = static_cast<Index>(k);
      column[k] = column[static_cast<std::size_t>(kept[k])];
      eigenvalue[to] = eigenvalue[kept[k]], energy[to] = energy[kept[k]], floor[to] = floor[kept[k]];
    }
    column.resize(kept.size());
    const auto left = static_cast<Index>(kept.size());
    eigenvalue.conservativeResize(left), energy.conservativeResize(left), floor.conservativeResize(left);
  }
};

}  // namespace

ShapeSensitivity::ShapeSensitivity(const fe::ParametricSystem& system, VectorXd theta, dynamics::EigenModes modes,
                                   double cluster_gap)
    : system_(system), theta_(std::move(theta)), modes_(std::move(modes)), cluster_gap_(cluster_gap) {
  linalg::SparseMatrix stiffness = system.stiffness(theta_);
  const linalg::SparseMatrix mass = system.mass(theta_);
  shift_ = factorize_shifted(stiffness, mass, factor_);
  mass_ = std::make_unique<linalg::SymmetricProduct>(mass);
  mass_shapes_ = mass_->times(modes_.shapes);
  find_further_modes(stiffness);
}

void ShapeSensitivity::find_further_modes(const linalg::SparseMatrix& shifted_stiffness) {
  const Index n = modes_.shapes.rows(), wanted = std::min(kFurtherModes, n - modes_.shapes.cols());
  if (wanted < 1) return;
  linalg::SelfAdjointOperator op;
  op.times_mass = [&](const MatrixXd& x) { return mass_->times(x); };
  op.from_mass = [&](const MatrixXd& y) {
    MatrixXd x = factor_.solve(y);
    subtract_product(modes_.shapes, product(mass_shapes_, x, true), x);
    return x;
  };
  const auto start = [&](int draw) {
    MatrixXd block(n, 4);
    for (Index i = 0; i < block.size(); ++i) {
      block(i % n, i / n) = uniform_number(1968, static_cast<std::uint64_t>(draw), static_cast<std::uint64_t>(i)) - 0.5;
    }
    return op.from_mass(mass_->times(block));
  };
  constexpr int restarts = 0;
  further_ = linalg::block_lanczos(op, start, {static_cast<int>(wanted), kFurtherError, restarts}).vectors;
  // Rayleigh quotients of what was found, and its images exactly: it need not be modes to help, only these must be true.
  stiffness_further_ = linalg::SymmetricProduct(shifted_stiffness).times(further_);
  further_value_ = column_dots(further_, stiffness_further_);
}

std::pair<MatrixXd, MatrixXd> ShapeSensitivity::precondition(const MatrixXd& residual, const VectorXd& eigenvalue) const {
  MatrixXd y = factor_.solve(residual), a_y = residual;
  if (further_.cols() == 0) return {std::move(y), std::move(a_y)};
  MatrixXd share = product(further_, residual, true);
  for (Index i = 0; i < share.cols(); ++i) {
    for (Index j = 0; j < share.rows(); ++j) {
      const double gap = further_value_[j] - eigenvalue[i];
      share(j, i) *= gap > 1e-3 * further_value_[j] ? 1.0 / gap - 1.0 / further_value_[j] : 0.0;
    }
  }
  y += product(further_, share);
  a_y += product(stiffness_further_, share);
  return {std::move(y), std::move(a_y)};
}

MatrixXd ShapeSensitivity::solve_outside_modes(MatrixXd residual) const {
  const MatrixXd& phi = modes_.shapes;
  subtract_product(mass_shapes_, product(phi, residual, true), residual);
  MatrixXd z = MatrixXd::Zero(residual.rows(), residual.cols());
  ConjugateGradients open(std::move(residual), modes_.eigenvalue.array() - shift_);
  for (int iteration = 0; iteration < kMaxIterations && open.residual.cols() > 0; ++iteration) {
    auto [y, a_y] = precondition(open.residual, open.eigenvalue);
    const MatrixXd mass_y = mass_->times(y);
    open.turn(std::move(y), std::move(a_y), mass_y);
    open.step(z);
  }
  for (std::size_t k = 0; k < open.column.size(); ++k) z.col(open.column[k]) = open.solution.col(static_cast<Index>(k));
  subtract_product(phi, product(mass_shapes_, z, true), z);  // of rounding
  return z;
}

MatrixXd ShapeSensitivity::derivative(int parameter) const {
  const ModalForces forces = modal_forces(system_, theta_, modes_, parameter, cluster_gap_);
  return product(modes_.shapes, forces.along) + solve_outside_modes(forces.force);
}

std::vector<MatrixXd> ShapeSensitivity::derivatives() const {
  std::vector<MatrixXd> all(system_.parameters.size());
  parallel_for(all.size(), [&](std::size_t p) { all[p] = derivative(static_cast<int>(p)); });
  return all;
}

}  // namespace twindeck::sensitivity
