#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference.hpp"
#include "diagnosis/inference/form_evidence.hpp"
#include "diagnosis/inference/guard.hpp"
#include "diagnosis/residual_test.hpp"
#include "diagnosis/scatter_scales.hpp"

namespace twindeck::diagnosis {

class Refinement;

struct DiagnoseOptions {
  double alpha = 0.01;           ///< false alarms allowed by the threshold
  double least_log_odds = 3.0;   ///< least log odds of a named cause, whatever the threshold of the null calibration
  double threshold = 3.0;        ///< of the largest log odds (from null calibration, or the analytic tail)
  double either_within = 3.0;    ///< nats: causes this near the best are not told apart
  double same_direction = 0.95;  ///< |cos| of signatures above which causes within `same_within` are not told apart either
  double same_within = 8.0;      ///< nats
  double equal_within = 1.0;     ///< nats: causes in one direction this near the best explain equally well
  double residual_alpha = 0.001;
  int most_causes = 4;
  int bootstrap = 2000;  ///< resamples of held-out blocks
  SearchOptions search;
  Refinement* refinement = nullptr;  ///< lays locations round the leading one before it is named; null: those of the catalogue
};

struct EffectParameter {
  std::string name, unit;
  double value = 0.0, low = 0.0, high = 0.0;
  bool at_low_bound = false, at_high_bound = false;  ///< the interval reaches the prior's end: a one-sided limit
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
  std::string state;                 ///< of the structure in which it acts; empty: in all
  std::vector<std::string> cluster;  ///< "fric@damper:C1", the best first
  std::vector<Rival> rivals;         ///< the others of the cluster, in its order
  double log_odds = 0.0, probability = 0.0;
  double within_m = 0.0;  ///< the cause sits no further than this from its location; 0 where the location itself stands out
  std::string split_by, sentence, remedy;
  std::vector<EffectParameter> parameters;  ///< 90 % intervals
};

struct Gain {
  int rows = 0;
  double before = 0.0, after = 0.0;  ///< RMS of standardised held-out residuals
  double reduction_pct = 0.0, low_pct = 0.0, high_pct = 0.0;
  std::string held_out;
};

struct LocationScore {
  std::string location;
  double score;
};

/// Scales of the model's form error under the winning hypothesis, and the predictive gain of a name on left-out modes.
struct FormReport {
  ScaleEstimate frequency, shape;     ///< relative deviations
  PredictiveGain gain;                ///< of the first cause, whether it was named or not
  std::vector<std::string> warnings;  ///< to be shown with the verdict
};

struct Diagnosis {
  std::string verdict;  ///< none | named | ambiguous | unknown
  std::string message;  ///< one line for people
  double log_odds = 0.0, threshold = 0.0, alpha = 0.0;
  ResidualTest residual;              ///< with the causes in the model
  std::vector<ScatterScale> scatter;  ///< likewise; filled by scatter_scales on request
  bool after_extension = false;
  std::vector<Effect> effects;
  std::vector<LocationScore> localisation;
  Gain gain;
  std::vector<std::string> on_bounds;  ///< of the model without causes
  Fit before, after;
  std::vector<Scored> ranking;     ///< of the first search; odds widened as those of the effects
  std::optional<FormReport> form;  ///< set if the model's form was a hypothesis
};

/// Finds what is wrong, why, and the gain from naming it (docs/diagnosis.md): forward steps with a backward check, clusters,
/// the verdict, the gain on held-out rows. Deterministic: `seed` sets the resampling of held-out blocks.
[[nodiscard]] Diagnosis diagnose(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

/// The same for a model whose form may be wrong. A form error that all conditions share competes with every cause. Its scales
/// are summed over under each hypothesis, and the rules of decision 0013 give the verdict (form_diagnosis.cpp).
[[nodiscard]] Diagnosis diagnose_with_form(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

/// Gain of `after` over `before` on the held-out rows, 90 % interval over resampled blocks (a mode or record of one condition
/// each).
[[nodiscard]] Gain held_out_gain(const Inference& inference, const Fit& before, const Fit& after, int bootstrap,
                                 std::uint64_t seed);

/// Standardised residuals of every row at a fit, e = (y - g)/sigma_id; the level of a record that is held out completely is
/// removed.
[[nodiscard]] Eigen::VectorXd standardised_residuals(const Inference& inference, const Fit& fit);

/// 90 % intervals of the unknowns of one of the fit's causes, by the profile likelihood of each unknown, widened by
/// the remaining misfit (Birge 1932).
[[nodiscard]] std::vector<EffectParameter> effect_parameters(const Inference& inference, const Fit& fit, std::size_t which);

/// Threshold of the largest log odds at false-alarm rate alpha by the union bound over candidates, chi² tails with the
/// catalogue's priors. It is used until the null calibration has been run.
[[nodiscard]] double analytic_threshold(const Inference& inference, double alpha);

/// ln odds of the best entry, with the likelihood widened by the remaining misfit, for comparison with thresholds.
[[nodiscard]] double tempered_log_odds(const Scored& best, int dof);

/// Largest log odds and residual statistic of `count` null data sets drawn from the prior (x ~ N(0, I) inside its bounds,
/// errors from Sigma_id). @param progress may be empty @param bound as of FeatureMap::bind_modes
struct NullResult {
  std::vector<double> log_odds, chi_squared;
};
[[nodiscard]] NullResult run_nulls(const ReducedModel& model, const FeatureSet& features, const ScatterOptions& scatter,
                                   const std::vector<Hypothesis>& catalogue, const SearchOptions& search, int count,
                                   std::uint64_t seed, const std::function<void(int)>& progress,
                                   const std::map<std::string, int>& bound = {});

}  // namespace twindeck::diagnosis
