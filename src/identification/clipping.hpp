#pragma once

#include <Eigen/Core>

namespace twindeck::identification {

/// Samples at which a channel was driven past its range: those in runs of three or more at its largest or smallest value; and
/// all at such a value, in runs or not, where it holds far more samples than the values next to it. A slow channel stays at its
/// rail for several samples, a fast one comes back at once.
///
/// The second count asks what no sound record shows. Of a continuous record the extreme value occurs once. Coarse counts give
/// every value many samples, but the extreme one no more than its neighbours: the tails of noise fall off, and a sine has at
/// its crest at most 1/(sqrt(2) - 1) = 2.4 times as many samples as one count below. Records of fewer than a dozen values are
/// judged by their runs alone.
/// @param x  NaN or infinite where missing @param lowest @param highest  of the samples that are there, lowest < highest
[[nodiscard]] long clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x, double lowest, double highest);

}  // namespace twindeck::identification
