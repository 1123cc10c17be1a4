#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lists.hpp"
#include "diagnosis/causes/catalogue.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/reduced_model.hpp"

namespace twindeck::diagnosis {

/// A start that is tuned to a measured mode: `factor` times the frequency of that mode in the current model.
struct Tuning {
  std::string mode;  ///< label, "" for a start that is not tuned
  int condition = -1;
  double factor = 1.0;
};

/// A hypothesis at a location: an entry of the catalogue for this model and these data.
struct Candidate {
  const Hypothesis* hypothesis = nullptr;
  std::string location;                     ///< "stay:NE5", "channels:a,b", "global"
  std::vector<const ReducedPlace*> places;  ///< one, or two for a pair of nodes; empty for channels and modes
  std::vector<int> channels;                ///< one, or two for a pair
  std::string mode;                         ///< label of a measured mode, for causes that act on one
  std::string state;                        ///< state of the structure in which the cause acts (first), "" for all states
  std::vector<std::string> further_states;  ///< later states in which the cause acts too
  std::string when;                         ///< "state mid", "from state mid on", "before state mid"; "" where it acts in all
  Eigen::VectorXd low, high;                ///< (k) bounds of the unknowns, in ln where they are logarithmic
  std::vector<bool> log;
  std::vector<Eigen::VectorXd> starts;  ///< trial magnitudes of the screen, in the same coordinates
  std::map<std::string, double> own;    ///< measured numbers of the location: f_own, f_own_low, f_own_high of a stay
  int tuned = -1;                       ///< position of an unknown that is a frequency tuned to measured modes, -1 for none
  std::vector<Tuning> tuning;           ///< (n_starts) if an unknown is tuned
  double log_prior = 0.0;               ///< ln (weight of the family / sum of weights / number of locations)

  [[nodiscard]] std::string id() const { return hypothesis->id + "@" + location; }
  /// Key that also contains the states in which the candidate acts.
  [[nodiscard]] std::string key() const {
    if (state.empty()) return id();
    return further_states.empty() ? id() + " in " + state : id() + " " + when;
  }
  [[nodiscard]] bool acts_in(const Condition& condition) const { return acts_in_state(condition.state); }
  [[nodiscard]] bool acts_in_state(const std::string& name) const {
    return state.empty() || state == name || contains(further_states, name);
  }
  /// Unknown `i` in its own unit at coordinates `a`.
  [[nodiscard]] double physical(const Eigen::VectorXd& a, Eigen::Index i) const;
  /// Value of an expression at coordinates `a`.
  [[nodiscard]] double value(const Expression& expression, const Eigen::VectorXd& a) const;
};

/// Whether a candidate is a fault of a channel, which appears in all modes. A wrong label of a mode is none: it looks like an
/// error of the form.
[[nodiscard]] inline bool is_of_a_channel(const Candidate& candidate) {
  return candidate.hypothesis->measurement && !candidate.channels.empty();
}

/// A candidate with magnitudes.
struct Cause {
  const Candidate* candidate = nullptr;
  Eigen::VectorXd a;  ///< (k) coordinates of the unknowns
};

/// A family that these data cannot show, with the reason.
struct Invisible {
  std::string hypothesis, reason;
};

struct Instantiated {
  std::vector<std::unique_ptr<Candidate>> candidates;
  std::vector<Invisible> invisible;
};

/// Makes a candidate of every hypothesis at every location of its set. If the rows come from several states of the structure,
/// changes between states are tried: in one state alone or, with three and more states, from one state on. Factors between
/// states range from 0.005 to 20. Faults of channels are tried in all states and, like parts that are added, in some: sensors
/// are taken down and mounted again. Other errors of the model and of the measurement act in all states. Families whose needs
/// the data do not meet, or whose set is empty, go to `invisible` with the reason.
/// @throws InputError  naming file and line for an unknown attribute, or bounds that are not low < high
[[nodiscard]] Instantiated instantiate(const std::vector<Hypothesis>& catalogue, const ReducedModel& model,
                                       const FeatureSet& features);

/// Value of a condition's key as a number; empty if unknown.
[[nodiscard]] std::optional<double> number_of(const Condition& condition, const std::string& key);

}  // namespace twindeck::diagnosis
