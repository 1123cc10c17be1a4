#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "linalg/sparse.hpp"

/// Modes of one model, followed by shape into another: after an as-built change, or on another mesh.
namespace twindeck::matching {

/// Modes of a reference, followed into a changed model.
struct TrackedModes {
  Eigen::VectorXd frequency_Hz;  ///< (n_modes) in the order of the reference; NaN where a mode was lost
  Eigen::VectorXd mac;           ///< (n_modes) of each with its reference mode
  std::vector<int> position;     ///< (n_modes) in the changed model's own order, -1 where lost
};

/// A model with its modes, kept for following.
struct SolvedModel {
  dynamics::LoadedModel loaded;
  dynamics::EigenModes modes;
  linalg::SparseMatrix mass;    ///< lower triangle (n × n)
  Eigen::MatrixXd mass_shapes;  ///< M Phi (n × n_modes)
};
[[nodiscard]] SolvedModel solve_modes(dynamics::LoadedModel loaded, int n_modes);

/// Follows the first `count` modes of `reference` (it has as many) into `changed`, one-to-one.
[[nodiscard]] TrackedModes follow(const SolvedModel& reference, const SolvedModel& changed, Eigen::Index count);

}  // namespace twindeck::matching
