#pragma once

#include <Eigen/Core>

#include "fe/model.hpp"

namespace twindeck::fe {

/// Weight of everything that has mass, f = g M e (e: direction of gravity) over all nodes before supports and links are
/// eliminated: consistent for beams (end moments w L²/12) and shells, half at each end for stays.
/// @return [N, N m] (6 n_nodes)
[[nodiscard]] Eigen::VectorXd dead_load(const Model& model);

}  // namespace twindeck::fe
