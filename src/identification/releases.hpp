#pragma once

#include <utility>
#include <vector>

#include "core/samples.hpp"

namespace twindeck::identification {

/// [-] mean square of the motion from sample to sample, channels in units of their own (n_samples).
[[nodiscard]] Eigen::VectorXd energy_of(const Eigen::Ref<const Eigen::MatrixXd>& data);

/// Free decays of a record: first sample and number of samples of each, in order. A structure may be released several times in
/// one record. A release is no part of a free motion, so linear prediction from the samples before (an autoregressive model)
/// fails there; a beat of close modes is predicted. Each decay begins where the motion's running RMS over half a second is
/// largest, and ends before the next release. What is left out: the rest before the first release, decays of less than a third
/// of the largest amplitude, and those less than half as long as the longest.
/// @param data  (n_samples × n_channels)
[[nodiscard]] std::vector<std::pair<Eigen::Index, Eigen::Index>> decays_of(const Eigen::Ref<const Eigen::MatrixXd>& data,
                                                                           double rate_Hz);

}  // namespace twindeck::identification
