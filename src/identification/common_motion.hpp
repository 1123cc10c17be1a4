#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/samples.hpp"

namespace twindeck::identification {

/// Highest frequency at which the channels move together [Hz]: the upper end of what a modal identification can see. At each
/// line of Welch's spectra the largest eigenvalue of the matrix of complex coherences is 1 for channels without anything in
/// common, and grows to the number of channels for one common motion. Of K independent segments of n independent noises it
/// stays below (1 + sqrt(n/K))². Two neighbouring lines clearly above that count as common motion.
/// @param records  (n_samples × n_channels) each, one rate @return 0 where nothing is found, or for one channel, whose noise
/// cannot be told from its motion
/// Reference for the bound: Marchenko and Pastur (1967), Mathematics of the USSR-Sbornik 1(4), 457-483.
[[nodiscard]] double highest_common_Hz(const std::vector<Samples>& records, double rate_Hz);

/// Length of a segment of the spectra [samples]: about sixty segments in the record, but at most 256 MB of spectra.
[[nodiscard]] Eigen::Index common_motion_segment(Eigen::Index n_samples, Eigen::Index n_channels);

}  // namespace twindeck::identification
