#include "linalg/orthonormal_block.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

OrthonormalBlock orthonormalise(MatrixXd w, MatrixXd mass_w, double scale) {
  OrthonormalBlock out{std::move(w), std::move(mass_w), {}};
  out.r = MatrixXd::Identity(out.q.cols(), out.q.cols());
  for (int pass = 0; pass < 2 && out.q.cols() > 0; ++pass) {
    MatrixXd gram = product(out.q, out.mass_q, true);
    gram = 0.5 * (gram + gram.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(gram);
    const double floor = pass == 0 ? std::max(1e-22 * scale * scale, 1e-14 * eig.eigenvalues().maxCoeff()) : 0.25;
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

double mass_norm(const MatrixXd& w, const MatrixXd& mass_w) {
  return std::sqrt(std::max(0.0, w.cwiseProduct(mass_w).colwise().sum().maxCoeff()));
}

}  // namespace twindeck::linalg
