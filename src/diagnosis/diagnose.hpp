#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/gain.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/guard.hpp"
#include "diagnosis/inference/one_verdict.hpp"
#include "diagnosis/intervals.hpp"
#include "diagnosis/progress.hpp"
#include "diagnosis/residual_test.hpp"

namespace twindeck::diagnosis {

/// How strongly the rows ask for a change at a location, in standard deviations of what chance would ask.
struct LocationScore {
  std::string location;
  double score;
};

/// Scores of the locations where the rows ask for a change: of every parameter, of element scatter and of the screened entries'
/// locations, the strongest first.
[[nodiscard]] std::vector<LocationScore> location_map(const Inference& inference, const Fit& fit,
                                                      const std::vector<Scored>& ranking);

struct DiagnoseOptions {
  /// [nats] Prior odds against nothing of all causes together that act in all conditions alike: such a cause looks like an
  /// error of the model's form.
  double static_odds = -13.0;
  int most_causes = 3;   ///< largest set; 0: causes are reported but not put into the model
  int bootstrap = 2000;  ///< resamples of held-out blocks
  Progress progress = [](const char*, int, int) {};
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
  std::string split_by, sentence, remedy;
  std::vector<EffectParameter> parameters;  ///< 90 % intervals
};

/// Posterior of a scale: mode and 90 % interval.
struct ScaleEstimate {
  double level = 0.0, low = 0.0, high = 0.0;
};

/// A class of errors under the winning hypothesis.
struct ErrorClass {
  std::string name;     ///< "frequencies", "shapes", "channels of shapes", "gains", "changes with state B"
  std::string unit;     ///< quantity that the scale is relative to: "of each mode's frequency"
  ScaleEstimate scale;  ///< relative
};

/// Errors of the model and of the measurement under the winning hypothesis, and the predictive gain of the named causes on
/// left-out modes.
struct FormReport {
  ScaleEstimate frequency, shape;     ///< of the classes of frequencies and of shapes
  std::vector<ErrorClass> classes;    ///< classes that have rows
  std::vector<HeldOutMode> held_out;  ///< modes that both fits predict
  PredictiveGain gain;                ///< gain of the leading causes, whether named or not
  std::vector<std::string> warnings;  ///< to be shown with the verdict
};

struct Diagnosis {
  Verdict verdict = Verdict::none;
  std::string message;       ///< one line for people
  double log_odds = 0.0;     ///< of all answers together against nothing
  double threshold = 0.0;    ///< ln odds above which there is an answer
  double probability = 0.0;  ///< probability of a cause
  ResidualTest residual;     ///< with the causes in the model
  bool after_extension = false;
  std::vector<Effect> effects;
  std::vector<LocationScore> localisation;
  Gain gain;
  std::vector<std::string> on_bounds;  ///< of the model without causes
  Fit before, after;
  std::vector<Scored> ranking;     ///< each entry alone
  std::optional<FormReport> form;  ///< set if the model predicts the rows
  /// Rows with the form error of `form` in their covariance. Reported residuals are standardised with it. Null if `form` is not
  /// set.
  std::shared_ptr<const FeatureMap> with_form;
};

/// Parameters of the model that a fit puts on one of their bounds, by name.
[[nodiscard]] std::vector<std::string> parameters_on_bounds(const FeatureMap& map, const Fit& fit);

/// The sentence of the effect's hypothesis, with its numbers.
[[nodiscard]] std::string sentence_of(const Effect& effect);

}  // namespace twindeck::diagnosis
