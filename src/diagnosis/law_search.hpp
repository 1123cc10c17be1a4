#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "diagnosis/inference.hpp"
#include "diagnosis/law_frame.hpp"
#include "diagnosis/progress.hpp"

/// Private to src/diagnosis. Evidence of every hypothesis under the one law: nothing but the model's errors, "something else
/// changed" in each contrast, each entry of the catalogue, and sets of two or three of them.
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

/// An entry of the catalogue with what the screen tries of it.
struct LawEntry {
  const Candidate* candidate = nullptr;
  int contrast = -1;                    ///< in which it acts; -1: in all conditions alike
  std::vector<int> contrasts;           ///< all in which it acts, that one first
  double log_prior = 0.0;               ///< ln prior odds against nothing
  std::vector<Inference::Tried> tried;  ///< magnitudes
  std::vector<double> effects;          ///< of each, RMS change of ln f where the entry acts
  Eigen::Index first_signature = 0;     ///< column of the base's signatures that belongs to the first of them
};

/// Whether two entries are one cause in different states. What acts in several is an error of the model in all, or acts from
/// one state on, and has entries of its own: never two changes.
[[nodiscard]] bool is_same_cause(const LawEntry& a, const LawEntry& b);

/// A set of causes that act together, one or more.
struct LawAccount {
  std::vector<int> members;  ///< positions among the entries
  double log_prior = 0.0;
  double log_weight = -1e300;  ///< ln evidence plus ln prior
  LawEvidence evidence;
  LawHypothesis hypothesis;  ///< as it was scored, at the base or, if refined, in `system`
  std::vector<Cause> causes;
  Eigen::VectorXd across;  ///< of one cause that is a factor: coordinates of the best magnitude on the other side of one
  double effect = 0.0;     ///< RMS change of frequencies, ln
  bool scored = false;     ///< at the mode of its own scales
  std::vector<Eigen::VectorXd> fitted;  ///< where fits under the error of all hypotheses have ended
  double first_weight = -1e300;         ///< of its fit under the error of all hypotheses, before it settled
  bool settled = false;                 ///< its fit is that under its own scales
  std::vector<int> beside;              ///< members of the account from whose parameters it was fitted too
  Fit with;                             ///< the fit with the causes in the model, made() if refined
  std::shared_ptr<const LawSystem> system;
  std::vector<int> opened;  ///< measured modes that are none of the model's by its evidence
  [[nodiscard]] bool refined() const { return system != nullptr; }
};

struct LawSearch {
  Fit base;
  bool weighed = true;  ///< false: the columns at the base are too large for 16 digits
  LawSystem system;     ///< at the base, with the signatures of all entries at all their magnitudes
  LawEvidence none;     ///< at the base, its modes as they are paired there: what the screen is held against
  LawAccount nothing;   ///< no cause, its modes none of the model's where that has more evidence
  std::vector<LawEvidence> something_else;  ///< (n_contrasts)
  std::vector<double> else_weight;          ///< ln evidence, prior odds 1
  std::vector<LawEntry> entries;
  std::vector<LawAccount> accounts;  ///< the best first
  /// Those of causes that act in all states alike, where the question is what changed between states: errors of the model.
  std::vector<LawAccount> model_errors;
};

/// Of accounts that may each be the answer (not empty) the one that is put into the model: what the smallest can do without is
/// no part of the answer. One that the screen alone has weighed has no fit, and comes last.
[[nodiscard]] const LawAccount& account_to_take(const std::vector<const LawAccount*>& possible);

[[nodiscard]] LawSearch search_by_law(const LawSetting& setting, const Fit& base);

/// Whether the question is what changed between states, and an entry acts in all of them alike.
[[nodiscard]] bool is_model_error(const LawSetting& setting, const LawEntry& entry);

/// Whether something is wrong with a channel, so that it shows in all modes.
[[nodiscard]] bool is_of_a_channel(const Candidate& candidate);

/// Classes that are active in a system whichever causes act: those that have columns, without the contrasts.
[[nodiscard]] std::vector<ActiveClass> lasting_classes(const LawSystem& system);

}  // namespace twindeck::diagnosis
