#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/gain.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/form_evidence.hpp"
#include "diagnosis/inference/guard.hpp"
#include "diagnosis/inference/verdict.hpp"
#include "diagnosis/intervals.hpp"
#include "diagnosis/location_map.hpp"
#include "diagnosis/residual_test.hpp"
#include "diagnosis/scatter_scales.hpp"

namespace twindeck::diagnosis {

class Refinement;
struct Diagnosis;

struct DiagnoseOptions {
  double alpha = 0.01;            ///< false alarms allowed by the threshold
  double least_log_odds = 3.0;    ///< least log odds of a named cause, whatever the threshold of the null calibration
  double threshold = 3.0;         ///< log odds above which a cause is named: of the null calibration, or analytic_threshold
  double either_within = 3.0;     ///< nats: causes within this distance of the best are not told apart from it
  double same_direction = 0.95;   ///< |cos| of signatures: above it, causes within `same_within` are not told apart either
  double same_within = 8.0;       ///< nats from the best, see `same_direction`
  double equal_within = 1.0;      ///< nats: causes with one direction within this distance of the best explain equally well
  double residual_alpha = 0.001;  ///< level of the residual test if no cause is named
  /// Level of the residual test if a cause is named. A name is a claim, and a wrong name leaves a larger misfit than chance
  /// does. On seeds 4001 to 4400, one of 135 right names has a p-value below this level. Of 15 wrong names for causes that the
  /// catalogue lacks, six do.
  double residual_alpha_named = 0.01;
  /// Least log odds (nats) of a further cause that is tuned to a mode (an oscillator, a vibrating stay). Such a cause can
  /// follow one mode through all conditions. It can therefore hide the misfit that a wrong first cause leaves. On seeds 4001 to
  /// 4400 and 5001 to 5400, wrong causes of this kind had 4 to 23 nats, the one right cause had 16.
  double further_tuned = 25.0;
  /// [nats] Prior odds against nothing of all causes together that act in all conditions alike: such a cause looks like an
  /// error of the model's form.
  double static_odds = -13.0;
  int most_causes = 4;
  int bootstrap = 2000;  ///< resamples of held-out blocks
  SearchOptions search;
  /// Adds candidate locations around the leading location before a cause is named. Null: only the locations of the catalogue.
  Refinement* refinement = nullptr;

  /// Level of the residual test for this result: `residual_alpha` or `residual_alpha_named`.
  [[nodiscard]] double residual_level(const Diagnosis& result) const;
};

/// Another member of a cause's cluster.
struct Rival {
  std::string id;                        ///< "mass@node:7"; "other@global": something else changed
  const Candidate* candidate = nullptr;  ///< null if it is not an entry of the catalogue
  double probability = 0.0;
  std::vector<EffectParameter> parameters;  ///< 90 % intervals; empty if its magnitudes are unknown
};

struct Effect {
  Cause cause;
  std::string state;                 ///< of the structure in which it acts alone or first; empty: all states
  std::vector<std::string> cluster;  ///< "fric@damper:C1", the best first
  std::vector<Rival> rivals;         ///< the others of the cluster, in its order
  double log_odds = 0.0, probability = 0.0;
  double within_m = 0.0;  ///< [m] largest distance of the cause from its location; 0 if the data single out the location
  std::string split_by, sentence, remedy;
  std::vector<EffectParameter> parameters;  ///< 90 % intervals
};

/// Scales of the model's form error under the winning hypothesis, and the predictive gain of a name on left-out modes.
struct FormReport {
  ScaleEstimate frequency, shape;     ///< relative deviations
  PredictiveGain gain;                ///< of the first cause, whether it was named or not
  std::vector<std::string> warnings;  ///< to be shown with the verdict
};

struct Diagnosis {
  Verdict verdict = Verdict::none;
  std::string message;  ///< one line for people
  double log_odds = 0.0, threshold = 0.0, alpha = 0.0;
  ResidualTest residual;              ///< with the causes in the model
  std::vector<ScatterScale> scatter;  ///< with the causes in the model; filled by scatter_scales on request
  bool after_extension = false;
  std::vector<Effect> effects;
  std::vector<LocationScore> localisation;
  Gain gain;
  std::vector<std::string> on_bounds;  ///< of the model without causes
  Fit before, after;
  std::vector<Scored> ranking;     ///< of the first search; its odds are widened like those of the effects
  std::optional<FormReport> form;  ///< set if the model's form was a hypothesis
  /// Rows with the form error of `form` in their covariance. Reported residuals are standardised with it. Null if `form` is not
  /// set.
  std::shared_ptr<const FeatureMap> with_form;
};

/// Finds what is wrong, why, and the gain from naming it (docs/diagnosis.md). Each forward step adds the leading cause and
/// checks the earlier causes again. The result has the cluster of each cause, the verdict, and the gain on held-out rows. The
/// result is deterministic: `seed` sets the resampling of held-out blocks.
[[nodiscard]] Diagnosis diagnose(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

/// Threshold of the largest log odds at false-alarm rate alpha by the union bound over candidates, chi² tails with the
/// catalogue's priors. It is used until the null calibration has been run.
[[nodiscard]] double analytic_threshold(const Inference& inference, double alpha);

/// ln odds of the best entry, with the likelihood widened by the remaining misfit, for comparison with thresholds.
[[nodiscard]] double tempered_log_odds(const Scored& best, int dof);

}  // namespace twindeck::diagnosis
