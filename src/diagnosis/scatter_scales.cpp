#include "diagnosis/scatter_scales.hpp"

#include <array>
#include <cmath>
#include <map>

#include "core/lists.hpp"
#include "core/statistics.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kReach = 1.609;         // ln 5
constexpr double kFreeDeviation = 10.0;  // of a shape's own scale, as in the fit
constexpr std::array kElementScatter = {Nuisance::Kind::place, Nuisance::Kind::stay_pull, Nuisance::Kind::gain};

/// Likelihood of the rows as a function of the logarithms of scales: one for each row type, the last for element scatter.
struct MarginalLikelihood {
  MatrixXd errors, fixed, element_scatter;  ///< (n_train × n_train)
  VectorXd r;
  std::vector<Index> group;  ///< of each row

  [[nodiscard]] double operator()(const VectorXd& log_scale) const {
    VectorXd row_scale(r.size());
    for (Index i = 0; i < r.size(); ++i) row_scale[i] = std::exp(log_scale[group[static_cast<std::size_t>(i)]]);
    const double w = std::exp(2.0 * log_scale[log_scale.size() - 1]);
    const MatrixXd factor =
        linalg::cholesky_factor(row_scale.asDiagonal() * errors * row_scale.asDiagonal() + fixed + w * element_scatter);
    if (factor.size() == 0) return -1e300;
    return -0.5 * linalg::lower_solve(factor, r).squaredNorm() - factor.diagonal().array().log().sum();
  }
};

/// Maximum along one coordinate within the reach, by golden section.
double best_along(const MarginalLikelihood& likelihood, VectorXd at, Index k) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = -kReach, high = kReach;
  const auto value = [&](double x) {
    at[k] = x;
    return likelihood(at);
  };
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = value(left), at_right = value(right);
  while (high - low > 0.01) {
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = value(left = high - golden * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = value(right = low + golden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

/// Deviation of one logarithm from the curvature; the reach if the likelihood is flat or largest at the end.
double deviation_along(const MarginalLikelihood& likelihood, VectorXd at, Index k) {
  constexpr double step = 0.1;
  const double centre = at[k];
  std::array<double, 3> value{};
  for (int i = 0; i < 3; ++i) {
    at[k] = centre + (i - 1) * step;
    value[static_cast<std::size_t>(i)] = likelihood(at);
  }
  const double curvature = (2.0 * value[1] - value[0] - value[2]) / (step * step);
  return curvature > 1.0 / (kReach * kReach) ? 1.0 / std::sqrt(curvature) : kReach;
}

}  // namespace

std::vector<ScatterScale> scatter_scales(const Inference& inference, const Fit& fit) {
  if (fit.total_factor.size() == 0) return {};
  const std::vector<Nuisance>& nuisances = inference.map().nuisances();
  const MatrixXd& j = fit.map.jacobian;
  MatrixXd parameters(j.rows(), j.cols()), element_scatter(j.rows(), j.cols());
  Index p = 0, w = 0;
  for (Index c = 0; c < j.cols(); ++c) {
    const bool of_work =
        c < static_cast<Index>(nuisances.size()) && contains(kElementScatter, nuisances[static_cast<std::size_t>(c)].kind);
    (of_work ? element_scatter.col(w++) : parameters.col(p++)) = j.col(c);
  }
  MarginalLikelihood likelihood;
  likelihood.errors = inference.covariance();
  likelihood.element_scatter = linalg::product(element_scatter.leftCols(w), element_scatter.leftCols(w).transpose());
  likelihood.fixed = linalg::product(parameters.leftCols(p), parameters.leftCols(p).transpose()) +
                     kFreeDeviation * kFreeDeviation * fit.map.scales * fit.map.scales.transpose();
  likelihood.r = fit.total_factor.triangularView<Eigen::Lower>() * fit.whitened;
  std::map<RowType, Index> group_of;
  for (const int r : inference.training())
    group_of.try_emplace(inference.map().features().rows[static_cast<std::size_t>(r)].type, 0);
  std::vector<ScatterScale> out;
  for (auto& [type, group] : group_of) {
    group = static_cast<Index>(out.size());
    out.push_back({name_of(type)});
  }
  for (const int r : inference.training()) {
    const Index group = group_of.at(inference.map().features().rows[static_cast<std::size_t>(r)].type);
    likelihood.group.push_back(group);
    ++out[static_cast<std::size_t>(group)].rows;
  }
  if (w > 0) out.push_back({"workmanship", static_cast<int>(inference.training().size())});
  VectorXd at = VectorXd::Zero(static_cast<Index>(group_of.size()) + 1);
  const auto free = static_cast<Index>(out.size());
  for (int turn = 0; turn < 6; ++turn) {
    const VectorXd before = at;
    for (Index k = 0; k < free; ++k) at[k] = best_along(likelihood, at, k);
    if ((at - before).cwiseAbs().maxCoeff() < 0.01) break;
  }
  for (Index k = 0; k < free; ++k) {
    const double half = kReachOfNinety * deviation_along(likelihood, at, k);
    ScatterScale& scale = out[static_cast<std::size_t>(k)];
    scale.scale = std::exp(at[k]);
    scale.low = std::exp(at[k] - half);
    scale.high = std::exp(at[k] + half);
  }
  return out;
}

}  // namespace twindeck::diagnosis
