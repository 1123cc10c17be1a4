#include "model_io/weighted_mean.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "fe/beam_frame.hpp"

namespace twindeck::model_io {

WeightedMean weighted_mean(const std::vector<MeanSample>& samples) {
  constexpr double singular = 1e-9, settled = 1e-6;  ///< [-] of the largest singular value; of a unit motion
  const auto n = static_cast<Eigen::Index>(samples.size());
  double reach = 0.0;
  for (const MeanSample& sample : samples) reach += sample.arm_m.norm() / static_cast<double>(n);
  if (!(reach > 0.0)) reach = 1.0;
  Eigen::Matrix<double, Eigen::Dynamic, 6> s(n, 6);
  Eigen::VectorXd root(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const MeanSample& sample = samples[static_cast<std::size_t>(i)];
    if (sample.rotation)
      s.row(i) << Eigen::RowVector3d::Zero(), sample.direction / reach;
    else
      s.row(i) << sample.direction, -sample.direction * fe::beam::cross_matrix(sample.arm_m) / reach;
    root[i] = std::sqrt(sample.weight) * (sample.rotation ? reach : 1.0);
  }
  // Rotations times the reach are of the size of displacements.
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> whole(root.asDiagonal() * s);
  whole.setThreshold(singular);
  const Eigen::MatrixXd inverse = whole.pseudoInverse();
  const Eigen::MatrixXd seen = inverse * root.asDiagonal() * s;
  WeightedMean mean;
  mean.of_samples = inverse * root.asDiagonal();
  mean.of_samples.bottomRows<3>() /= reach;
  for (Eigen::Index k = 0; k < 6; ++k)
    mean.determined[static_cast<std::size_t>(k)] = (seen.row(k) - Eigen::Matrix<double, 1, 6>::Unit(k)).norm() < settled;
  return mean;
}

}  // namespace twindeck::model_io
