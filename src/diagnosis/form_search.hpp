#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/form_frame.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/form_evidence.hpp"

/// Private to src/diagnosis. Compares every entry of the catalogue with the hypothesis "nothing but the model's form". The
/// evidence of each hypothesis is summed over the scales of the form error.
namespace twindeck::diagnosis {

/// An entry of the catalogue with its evidence.
struct FormEntry {
  const Candidate* candidate = nullptr;
  int contrast = -1;                    ///< position of the contrast in which it acts; -1: in all conditions alike
  std::vector<Inference::Tried> tried;  ///< magnitudes of the screen
  int first_signature = 0;              ///< column of the base's signatures that belongs to the first of `tried`
  HypothesisEvidence evidence;
  double log_weight = -1e300;  ///< ln evidence plus ln prior
  Eigen::VectorXd a;           ///< magnitudes at the best point
  Eigen::VectorXd fitted;      ///< if refined: magnitudes of the fit `with`
  double effect = 0.0;         ///< RMS change of frequencies, ln
  bool refined = false;        ///< linearised with the entry in the model
  Fit with;                    ///< if refined: the fit with the entry in the model; `system` is linearised there
  FormSystem system;
};

/// Contrast and effect of the accepted cause. A part of its effect may be left over in this contrast.
struct Leftover {
  int contrast = -1;
  double effect = 0.0;
};

struct FormSearch {
  Fit base;
  bool weighed = true;  ///< false: the columns at the base are too large for 16 digits, and there is no evidence of anything
  FormSystem system;    ///< at the base, with the signatures of all entries at all their magnitudes
  HypothesisEvidence none;
  std::vector<HypothesisEvidence> something_else;  ///< (n_contrasts)
  double none_weight = 0.0;
  std::vector<double> else_weight;  ///< (n_contrasts)
  std::vector<FormEntry> entries;   ///< the best first
};

/// Input of a search. `informed` has the form error in the covariance of its rows, so that the form error does not bias a fit.
/// `plain` has the covariance of the identification alone.
struct FormSetting {
  const Inference& plain;
  const Inference& informed;
  int dof;  ///< degrees of freedom of the rows in use
  std::vector<Contrast> contrasts;
  ScaleGrid grid;
};

/// First computes the evidence of every hypothesis at `base`, the fit with the accepted causes. Then fits the model with each
/// leading entry in it, once from `base` and once from the prior mean, and linearises there. The larger evidence counts.
[[nodiscard]] FormSearch search_with_form(const FormSetting& setting, const Fit& base, const Leftover& leftover);

/// ln of the prior probabilities: 0.5 for none, 0.05 for "something else changed" in each contrast, 0.4 for the whole
/// catalogue.
[[nodiscard]] double log_prior_of_none();
[[nodiscard]] double log_prior_of_something_else();
[[nodiscard]] double log_prior_of(const Candidate& candidate);

}  // namespace twindeck::diagnosis
