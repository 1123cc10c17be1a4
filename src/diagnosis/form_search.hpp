#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/form_frame.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/form_evidence.hpp"

/// Private to src/diagnosis: every entry of the catalogue against "nothing but the model's form", scales summed over under
/// each.
namespace twindeck::diagnosis {

/// An entry, weighed.
struct FormEntry {
  const Candidate* candidate = nullptr;
  int contrast = -1;                    ///< in which it acts; -1: in all conditions alike
  std::vector<Inference::Tried> tried;  ///< magnitudes of the screen
  int first_signature = 0;              ///< of `tried` in the base's system
  HypothesisEvidence evidence;
  double log_weight = -1e300;  ///< evidence and prior
  Eigen::VectorXd a;           ///< magnitudes at the best point
  Eigen::VectorXd fitted;      ///< where refined: those that the system's residual is at
  double effect = 0.0;         ///< RMS change of frequencies, ln
  bool refined = false;        ///< linearised with the entry in the model
  Fit with;                    ///< where refined, and its system
  FormSystem system;
};

/// A cause that was accepted leaves something over in its contrast.
struct Leftover {
  int contrast = -1;
  double effect = 0.0;
};

struct FormSearch {
  Fit base;
  FormSystem system;  ///< at the base, signatures of every entry's magnitudes
  HypothesisEvidence none;
  std::vector<HypothesisEvidence> something_else;  ///< (n_contrasts)
  double none_weight = 0.0;
  std::vector<double> else_weight;  ///< (n_contrasts)
  std::vector<FormEntry> entries;   ///< the best first
};

/// What a search works on. `informed` has the form error in the covariance of its rows, so that a fit does not bend to it;
/// `plain` has the identification's alone.
struct FormSetting {
  const Inference& plain;
  const Inference& informed;
  int dof;  ///< of the rows that count
  std::vector<Contrast> contrasts;
  ScaleGrid grid;
  Eigen::MatrixXd many;  ///< many small causes, a part of the form error
};

/// Whether an effect grows with the magnitude. What is tuned turns with its frequency, a support's place is no size, and what
/// has no unknown is there or not.
[[nodiscard]] bool is_a_size(const Candidate& candidate);

/// Magnitudes of the screen are taken times these where they can be scaled: (n_factors)
[[nodiscard]] std::vector<double> magnitude_factors(const Candidate& candidate);

/// Weighs everything against a fit with the accepted causes, then linearises with each of the leaders in the model, from the
/// fit without it and from the prior's mean, and keeps the larger evidence.
[[nodiscard]] FormSearch search_with_form(const FormSetting& setting, const Fit& base, const Leftover& leftover);

/// ln prior: nothing 0.5, something else changed 0.05 a contrast, the catalogue 0.4 together.
[[nodiscard]] double log_prior_of_none();
[[nodiscard]] double log_prior_of_something_else();
[[nodiscard]] double log_prior_of(const Candidate& candidate);

}  // namespace twindeck::diagnosis
