#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/features/features.hpp"

namespace twindeck::diagnosis {

/// Which mode of one list is which of another, by likeness of shape and nearness of frequency: the one-to-one assignment with
/// the largest sum of MAC - |ln f ratio|; pairs below MAC 0.5 or with frequencies further apart than a factor 1.5 are none.
/// Dampers that lock and shift a mode by a quarter leave its shape recognisable, and no more than that can be asked.
/// @param shapes  (n_channels × n_modes) of the same channels
/// @return (n_modes of `other`) position in `reference`, -1 for none
[[nodiscard]] std::vector<int> same_modes(const Eigen::VectorXd& reference_Hz, const Eigen::MatrixXcd& reference,
                                          const Eigen::VectorXd& other_Hz, const Eigen::MatrixXcd& other);

/// Gives modes that are the same in several conditions one name: that of the condition with the most modes that have a shape. A
/// mode that is like none of them is called by its condition and name. An identification numbers the modes of each condition
/// from one.
void name_modes_alike(FeatureSet& features);

}  // namespace twindeck::diagnosis
