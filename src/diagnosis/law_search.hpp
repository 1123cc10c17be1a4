#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "diagnosis/inference.hpp"
#include "diagnosis/law_frame.hpp"
#include "diagnosis/progress.hpp"

/// Private to src/diagnosis. Evidence of every hypothesis under one law: "nothing" (only errors of the model), "something else
/// changed" in each contrast, each entry of the catalogue, and sets of two or three entries.
namespace twindeck::diagnosis {

/// Input of a search. `informed` has a form error in the covariance of its rows, so that it does not bias a fit. `plain` has
/// the covariance of the identification alone.
struct LawSetting {
  const Inference& plain;
  const Inference& informed;
  std::vector<Contrast> contrasts;
  double static_odds;  ///< [nats] prior odds against nothing of all causes that act in all conditions alike, together
  Progress progress = [](const char*, int, int) {};
};

/// An entry of the catalogue with its trial magnitudes.
struct LawEntry {
  const Candidate* candidate = nullptr;
  int contrast = -1;                    ///< contrast in which it acts; -1: equally in all conditions
  std::vector<int> contrasts;           ///< all contrasts in which it acts, `contrast` first
  double log_prior = 0.0;               ///< ln prior odds against "nothing"
  std::vector<Inference::Tried> tried;  ///< magnitudes
  std::vector<double> effects;          ///< for each magnitude, RMS change of ln f in the conditions where the entry acts
  Eigen::Index first_signature = 0;     ///< column of its first signature in the base's system
};

/// Whether two entries are one cause in different states. Together they would be an error of the model, or a change from one
/// state on. Both have entries of their own, so a set never holds two of them.
[[nodiscard]] bool is_same_cause(const LawEntry& a, const LawEntry& b);

/// A set of causes that act together, one or more.
struct LawAccount {
  std::vector<int> members;  ///< positions among the entries
  double log_prior = 0.0;
  double log_weight = -1e300;  ///< ln evidence plus ln prior
  LawEvidence evidence;
  LawHypothesis hypothesis;  ///< as scored at the base or, if refined, in `system`
  std::vector<Cause> causes;
  Eigen::VectorXd across;               ///< for a single factor: coordinates of the best magnitude on the other side of one
  double effect = 0.0;                  ///< RMS change of frequencies, ln
  bool scored = false;                  ///< true: evaluated at the mode of its own scales
  std::vector<Eigen::VectorXd> fitted;  ///< end points of its fits under the common form error
  double first_weight = -1e300;         ///< weight of its fit under the common form error, before it settled
  bool settled = false;                 ///< true: fitted under its own scales
  std::vector<int> beside;              ///< members of the account whose parameters were a further start
  Fit with;                             ///< the fit with the causes in the model, made() if refined
  std::shared_ptr<const LawSystem> system;
  std::vector<int> opened;  ///< measured modes that are none of the model's, by its evidence
  [[nodiscard]] bool refined() const { return system != nullptr; }
};

struct LawSearch {
  Fit base;
  bool weighed = true;                      ///< false: the columns at the base are too large for 16 digits
  LawSystem system;                         ///< at the base, with the signatures of all entries at all their magnitudes
  LawEvidence none;                         ///< at the base with its pairing; reference of the screen
  LawAccount nothing;                       ///< no cause, with open modes where these have more evidence
  std::vector<LawEvidence> something_else;  ///< (n_contrasts)
  std::vector<double> else_weight;          ///< ln evidence, prior odds 1
  std::vector<LawEntry> entries;
  std::vector<LawAccount> accounts;  ///< the best first
  /// Accounts of causes that act equally in all states, if several states are compared: errors of the model.
  std::vector<LawAccount> model_errors;
};

/// Chooses the account for the model among those that may be the answer (not empty): the smallest, because causes that it does
/// without are not needed. Accounts without a fit come last.
[[nodiscard]] const LawAccount& account_to_take(const std::vector<const LawAccount*>& possible);

[[nodiscard]] LawSearch search_by_law(const LawSetting& setting, const Fit& base);

/// Whether several states are compared, and an entry acts equally in all of them.
[[nodiscard]] bool is_model_error(const LawSetting& setting, const LawEntry& entry);

/// Classes that are active in a system for any causes: those with columns, without the contrasts.
[[nodiscard]] std::vector<ActiveClass> lasting_classes(const LawSystem& system);

}  // namespace twindeck::diagnosis
