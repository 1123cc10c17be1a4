#include "linalg/krylov_basis.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::linalg {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

OrthonormalBlock orthonormalise(MatrixXd w, MatrixXd mass_w, const MatrixXd& removed) {
  const double norm = std::sqrt(std::max(0.0, w.cwiseProduct(mass_w).colwise().sum().maxCoeff()));
  const double before = std::hypot(std::sqrt(removed.colwise().squaredNorm().maxCoeff()), norm);  // by Pythagoras
  OrthonormalBlock out{std::move(w), std::move(mass_w), {}};
  out.r = MatrixXd::Identity(out.q.cols(), out.q.cols());
  for (int pass = 0; pass < 2 && out.q.cols() > 0; ++pass) {
    MatrixXd gram = product(out.q, out.mass_q, true);
    gram = 0.5 * (gram + gram.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(gram);
    const double floor = pass == 0 ? std::max(1e-22 * before * before, 1e-14 * eig.eigenvalues().maxCoeff()) : 0.25;
    Index keep = 0;
    while (keep < gram.cols() && eig.eigenvalues()[gram.cols() - 1 - keep] > floor) ++keep;
    const VectorXd root = eig.eigenvalues().tail(keep).cwiseSqrt();
    const MatrixXd basis = eig.eigenvectors().rightCols(keep);
    const MatrixXd turn = basis * root.cwiseInverse().asDiagonal();
    out.q = product(out.q, turn);
    out.mass_q = product(out.mass_q, turn);
    out.r = root.asDiagonal() * basis.transpose() * out.r;
  }
  return out;
}

void KrylovBasis::append(const OrthonormalBlock& block) {
  if (const Index wanted = size + block.q.cols(); wanted > v.cols()) {
    v.conservativeResize(Eigen::NoChange, std::max(wanted, 2 * v.cols()));
    mass_v.conservativeResize(Eigen::NoChange, v.cols());
  }
  v.middleCols(size, block.q.cols()) = block.q;
  mass_v.middleCols(size, block.q.cols()) = block.mass_q;
  size += block.q.cols();
}

MatrixXd KrylovBasis::remove_from(MatrixXd& w, Index near) const {
  MatrixXd total = MatrixXd::Zero(size, w.cols());
  for (const Index first : {near, Index{0}}) {
    const MatrixXd part = product(mass_v.middleCols(first, size - first), w, true);
    subtract_product(v.middleCols(first, size - first), part, w);
    total.bottomRows(size - first) += part;
  }
  return total;
}

}  // namespace twindeck::linalg
