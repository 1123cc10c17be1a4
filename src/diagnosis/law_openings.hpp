#pragma once

#include <vector>

#include "diagnosis/law_frame.hpp"

/// Private to src/diagnosis.
namespace twindeck::diagnosis {

/// A hypothesis on a system in which each measured mode with a shape has a mode of the model or none.
struct OpenedEvidence {
  LawEvidence evidence;
  std::vector<int> opened;  ///< measured modes that were paired, but are none of the model's
};

/// Finds the mode of a hypothesis' scales. A measured mode counts as none of the model's if that has more evidence: it may be
/// spurious, or belong to a part that the model lacks. Its rows are then open, at the prior odds of such a mode. Otherwise one
/// wrong shape would raise the scale of all shapes, and a change that improves this shape would look like a cause. All modes
/// that gain at the present scales are opened together; then the scales are found anew.
/// @param system  Sigma_0 and its prior become those with the opened modes
[[nodiscard]] OpenedEvidence scored_with_openings(const Inference& plain, FitSystem& system, const LawHypothesis& hypothesis,
                                                  const Eigen::VectorXd& start);

/// A map with the rows of some measured modes open, like those of a mode without a partner.
[[nodiscard]] FeatureMap with_open(FeatureMap map, const std::vector<int>& modes);

/// A fit to such a map.
[[nodiscard]] Fit fit_with_open(const Inference& inference, const std::vector<int>& modes, const std::vector<Cause>& causes,
                                const Eigen::VectorXd& start);

}  // namespace twindeck::diagnosis
