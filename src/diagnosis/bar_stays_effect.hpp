#pragma once

#include <memory>
#include <vector>

#include "diagnosis/causes/bar_stays.hpp"
#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

/// How many of the measured modes with a shape a model explains: paired with a mode that is alike and near in frequency.
struct ModesExplained {
  int measured = 0, explained = 0;
};
[[nodiscard]] ModesExplained modes_explained(const ReducedModel& model, const FeatureSet& features,
                                             const ScatterOptions& scatter, const ExplanationRule& rule);

/// The cause `barstays` at `global`, as an effect like those of the catalogue. The extended model includes it.
class BarStaysEffect {
 public:
  BarStaysEffect(std::vector<FoundStay> stays, double log_odds, const ModesExplained& before, const ModesExplained& after);

  /// Puts the effect before all others. If nothing else was found, the verdict becomes `named`.
  void put_first(Diagnosis& result) const;
  /// Removes the entries that would let one of these stays swing once more.
  void take_out_entries(Instantiated& entries) const;

 private:
  std::vector<FoundStay> stays_;
  std::unique_ptr<Hypothesis> hypothesis_;
  std::unique_ptr<Candidate> candidate_;
  Effect effect_;
};

/// Numbers of explained modes before and after the effect `barstays`; empty without this effect.
struct ExplainedGain {
  double measured = 0.0, before = 0.0, after = 0.0;
};
[[nodiscard]] std::optional<ExplainedGain> explained_gain(const Diagnosis& result);

}  // namespace twindeck::diagnosis
