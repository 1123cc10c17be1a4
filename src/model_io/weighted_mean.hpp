#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

/// Inside of the library: the motion of a reference point as the weighted mean of the motions of nodes about it, as Nastran's
/// RBE3 and Abaqus' distributing coupling have it.
namespace twindeck::model_io {

/// One displacement (or rotation) that the mean counts.
struct MeanSample {
  Eigen::RowVector3d direction;  ///< unit, global axes
  Eigen::Vector3d arm_m;         ///< of its node from the reference point
  bool rotation = false;
  double weight = 1.0;  ///< above 0
};

/// Motions q of the reference point (x y z rx ry rz) that fit the samples u best: min sum w (u - S q)². A rotation counts with
/// the square of the mean distance of the samples, so that all terms are lengths.
struct WeightedMean {
  Eigen::MatrixXd of_samples;      ///< q = of_samples · u (6 × samples); [-], rotations [1/m] of displacements
  std::array<bool, 6> determined;  ///< whether the samples say what this motion is
};
[[nodiscard]] WeightedMean weighted_mean(const std::vector<MeanSample>& samples);

}  // namespace twindeck::model_io
