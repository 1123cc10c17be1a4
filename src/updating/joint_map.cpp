#include "updating/joint_map.hpp"

#include <Eigen/Dense>

#include "linalg/dense.hpp"

namespace twindeck::updating {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Whitened Jacobian without the part that free scales explain.
MatrixXd whitened(const MatrixXd& jacobian, const MatrixXd& scales, const MatrixXd& factor) {
  MatrixXd a = linalg::lower_solve(factor, jacobian);
  if (scales.cols() == 0) return a;
  const MatrixXd s = linalg::lower_solve(factor, scales);
  // Each row belongs to one shape at most, so the columns are nearly orthogonal. The QR makes them so exactly.
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(s);
  const MatrixXd q = qr.householderQ() * MatrixXd::Identity(s.rows(), qr.rank());
  linalg::subtract_product(q, linalg::product(q, a, true), a);
  return a;
}

/// (A'A + I)^-1 b with a diagonal raised by `damping` times itself. If A (m × n) has fewer rows than columns, the matrix
/// inversion lemma is used, so that the time grows with n only linearly.
class DampedNormal {
 public:
  explicit DampedNormal(const MatrixXd& a) : a_(a), diagonal_(a.colwise().squaredNorm().transpose().array() + 1.0) {
    if (a.cols() <= a.rows()) {
      normal_ = linalg::product(a, a, true);
      normal_.diagonal().array() += 1.0;
    }
  }
  [[nodiscard]] VectorXd solve(double damping, const VectorXd& b) const {
    if (a_.cols() <= a_.rows()) {
      MatrixXd damped = normal_;
      damped.diagonal() *= 1.0 + damping;
      return damped.llt().solve(b);
    }
    const VectorXd inverse = (damping * diagonal_.array() + 1.0).inverse();
    const MatrixXd scaled = a_ * inverse.asDiagonal();
    MatrixXd small = linalg::product(scaled, a_.transpose());
    small.diagonal().array() += 1.0;
    return inverse.cwiseProduct(b) - scaled.transpose() * small.llt().solve(scaled * b);
  }

 private:
  const MatrixXd& a_;
  VectorXd diagonal_;  ///< of A'A + I
  MatrixXd normal_;    ///< A'A + I where it is the smaller
};

/// Components that no bound keeps from moving along the descent direction.
std::vector<int> free_components(const VectorXd& x, const VectorXd& gradient, const Box& box) {
  const std::vector<bool> rests = held(x, gradient, box, 1e-9);
  std::vector<int> free;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (!rests[static_cast<std::size_t>(j)]) free.push_back(static_cast<int>(j));
  return free;
}

/// x less a step in its free components, inside the box.
VectorXd moved(VectorXd x, const std::vector<int>& free, const VectorXd& step, const Box& box) {
  x(free) -= step;
  return x.cwiseMax(box.lower).cwiseMin(box.upper);
}

}  // namespace

JointMap joint_map(const PredictionFunction& predict, const VectorXd& y, const MatrixXd& sigma_factor, const VectorXd& start,
                   const Box& box, const JointMapOptions& options) {
  JointMap map;
  map.x = start.cwiseMax(box.lower).cwiseMin(box.upper);
  if (!predict(map.x, map.g, &map.jacobian, &map.scales)) {
    map.status = {false, "the model predicts nothing at the start"};
    return map;
  }
  const auto residual_of = [&](const VectorXd& g) {
    return VectorXd(sigma_factor.triangularView<Eigen::Lower>().solve(y - g));
  };
  VectorXd r = residual_of(map.g);
  map.chi_squared = r.squaredNorm() + map.x.squaredNorm();
  double damping = 1e-3;
  map.status = {false, "iteration limit"};
  for (; map.iterations < options.max_iterations; ++map.iterations) {
    const MatrixXd a = whitened(map.jacobian, map.scales, sigma_factor);
    const VectorXd gradient = map.x - a.transpose() * r;
    const std::vector<int> free = free_components(map.x, gradient, box);
    map.gradient = VectorXd(gradient(free)).norm();
    const MatrixXd reduced = a(Eigen::all, free);
    const DampedNormal normal(reduced);
    const VectorXd g_free = gradient(free);
    const VectorXd newton = normal.solve(0.0, g_free);
    if (g_free.dot(newton) < options.tolerance) {
      map.status = {true, ""};
      return map;
    }
    bool accepted = false;
    for (int attempt = 0; attempt < 12 && !accepted; ++attempt) {
      const VectorXd x = moved(map.x, free, normal.solve(damping, g_free), box);
      VectorXd g;
      if (predict(x, g, nullptr, nullptr)) {
        const VectorXd next = residual_of(g);
        const double chi_squared = next.squaredNorm() + x.squaredNorm();
        if (chi_squared < map.chi_squared) {
          accepted = true;
          const double fall = map.chi_squared - chi_squared;
          map.x = x;
          r = next;
          map.chi_squared = chi_squared;
          damping = std::max(damping * 0.2, 1e-9);
          if (!predict(map.x, map.g, &map.jacobian, &map.scales)) return map;
          if (fall < 0.1 * options.tolerance) {
            map.status = {true, ""};
            return map;
          }
          break;
        }
      }
      damping = std::max(damping * 6.0, 1e-6);
    }
    if (!accepted) {  // no further descent: rounding, or modes that change partners
      map.status = {g_free.dot(newton) < 1.0, "no step lowers the cost"};
      return map;
    }
  }
  return map;
}

}  // namespace twindeck::updating
