#pragma once

#include <vector>

#include "diagnosis/law_frame.hpp"

/// Private to src/diagnosis.
namespace twindeck::diagnosis {

/// A hypothesis on a system in which each measured mode with a shape is one of the model's or none of them.
struct OpenedEvidence {
  LawEvidence evidence;
  std::vector<int> opened;  ///< measured modes that are none of the model's though the pairing by distance gave them one
};

/// The mode of a hypothesis' scales, where each measured mode counts as none of the model's if that has more evidence: it is
/// spurious, or a hybrid with something that the model does not hold. Its rows are then as open as the rows of a mode without a
/// partner, at the prior odds of such a mode. One shape that is wholly off would otherwise raise the scale of all shapes, and
/// whatever mends that one shape would look like a cause. Those that gain at the
/// scales as they are are opened together, then the scales are found anew.
/// @param system  Sigma_0 and its prior become those with the opened modes
[[nodiscard]] OpenedEvidence scored_with_openings(const Inference& plain, FitSystem& system, const LawHypothesis& hypothesis,
                                                  const Eigen::VectorXd& start);

/// A map in which the model may miss the rows of some measured modes by as much as those of a mode that it does not have.
[[nodiscard]] FeatureMap with_open(FeatureMap map, const std::vector<int>& modes);

/// A fit to such a map.
[[nodiscard]] Fit fit_with_open(const Inference& inference, const std::vector<int>& modes, const std::vector<Cause>& causes,
                                const Eigen::VectorXd& start);

}  // namespace twindeck::diagnosis
