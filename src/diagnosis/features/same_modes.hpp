#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/features/features.hpp"

namespace twindeck::diagnosis {

/// Assigns the modes of one list to those of another, one-to-one, with the largest sum of MAC - |ln f ratio|. A pair needs a
/// MAC of at least 0.5 and frequencies within a factor of 1.5. This suffices for dampers that lock and shift a frequency by a
/// quarter.
/// @param shapes  (n_channels × n_modes) of the same channels
/// @return (n_modes of `other`) position in `reference`, -1 for none
[[nodiscard]] std::vector<int> same_modes(const Eigen::VectorXd& reference_Hz, const Eigen::MatrixXcd& reference,
                                          const Eigen::VectorXd& other_Hz, const Eigen::MatrixXcd& other);

/// Gives the same mode in several conditions one name: its name in the condition with the most measured shapes. Other modes are
/// named by condition and name. An identification numbers the modes of each condition from one.
void name_modes_alike(FeatureSet& features);

}  // namespace twindeck::diagnosis
