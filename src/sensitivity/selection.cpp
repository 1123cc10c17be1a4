#include "sensitivity/selection.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>

#include "core/error.hpp"

namespace twindeck::sensitivity {
namespace {

// The kept parameter whose column is most nearly parallel to that of `p`.
int most_alike(const Eigen::MatrixXd& a, const std::vector<SelectedParameter>& fate, Eigen::Index p) {
  int nearest = -1;
  double best = -1.0;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    if (!fate[static_cast<std::size_t>(k)].selected || a.col(k).norm() == 0.0) continue;
    const double cosine = std::abs(a.col(k).dot(a.col(p))) / a.col(k).norm();
    if (cosine > best) best = cosine, nearest = static_cast<int>(k);
  }
  return nearest;
}

}  // namespace

std::vector<SelectedParameter> select_parameters(const Eigen::MatrixXd& scaled, const std::vector<std::string>& names,
                                                 double threshold) {
  TWINDECK_ASSERT(scaled.allFinite());
  const Eigen::Index n = scaled.cols();
  std::vector<SelectedParameter> fate(static_cast<std::size_t>(n));
  Eigen::MatrixXd left = scaled;
  for (int rank = 1; rank <= n; ++rank) {
    Eigen::Index next = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (fate[static_cast<std::size_t>(j)].rank != 0) continue;
      if (next < 0 || left.col(j).norm() > left.col(next).norm()) next = j;
    }
    SelectedParameter& parameter = fate[static_cast<std::size_t>(next)];
    parameter.rank = rank;
    parameter.score = scaled.col(next).norm();
    parameter.remaining = left.col(next).norm();
    parameter.selected = parameter.remaining >= threshold && parameter.remaining > 0.0;
    if (parameter.selected) {
      parameter.reason = fmt::format("moves the frequencies by {:.2f} std of its own", parameter.remaining);
      const Eigen::VectorXd direction = left.col(next).normalized();
      left -= direction * (direction.transpose() * left);
    } else if (parameter.score < threshold) {
      parameter.reason = fmt::format("too little: its range moves the frequencies by {:.2f} std", parameter.score);
    } else {
      parameter.reason = fmt::format("others do the same: {:.2f} of {:.2f} std left, most like {}", parameter.remaining,
                                     parameter.score, names[static_cast<std::size_t>(most_alike(scaled, fate, next))]);
    }
  }
  return fate;
}

Identifiability identifiability(const Eigen::MatrixXd& scaled, double cutoff) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  Identifiability out;
  out.singular_values = Eigen::VectorXd::Zero(scaled.cols());
  out.singular_values.head(svd.singularValues().size()) = svd.singularValues();
  while (out.retained < svd.singularValues().size() && svd.singularValues()(out.retained) >= cutoff) ++out.retained;
  out.resolution = svd.matrixV().leftCols(out.retained).rowwise().squaredNorm();
  return out;
}

}  // namespace twindeck::sensitivity
