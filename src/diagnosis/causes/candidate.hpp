#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/causes/catalogue.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/reduced_model.hpp"

namespace twindeck::diagnosis {

/// A start that is tuned to a measured mode: `factor` times its frequency, wherever the model has that mode at the time.
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
  std::string mode;                         ///< label of a measured mode
  std::string state;                        ///< of the structure in which it acts alone or first, "" where it acts in all
  std::vector<std::string> further_states;  ///< after `state`, in which it acts as well
  std::string when;                         ///< "state mid", "from state mid on", "before state mid"; "" where it acts in all
  Eigen::VectorXd low, high;                ///< (k) bounds of the unknowns, in ln where they are logarithmic
  std::vector<bool> log;
  std::vector<Eigen::VectorXd> starts;  ///< magnitudes that the screen tries, in the same coordinates
  std::map<std::string, double> own;    ///< numbers that the rows say of the place: f_own, f_own_low, f_own_high of a stay
  int tuned = -1;                       ///< unknown that is a frequency tuned to measured modes, -1 for none
  std::vector<Tuning> tuning;           ///< (n_starts) where there is one
  double log_prior = 0.0;               ///< ln (weight of the family / sum of weights / number of locations)

  [[nodiscard]] std::string id() const { return hypothesis->id + "@" + location; }
  /// The same, told apart by the states that it acts in.
  [[nodiscard]] std::string key() const {
    if (state.empty()) return id();
    return further_states.empty() ? id() + " in " + state : id() + " " + when;
  }
  [[nodiscard]] bool acts_in(const Condition& condition) const { return acts_in_state(condition.state); }
  [[nodiscard]] bool acts_in_state(const std::string& name) const {
    return state.empty() || state == name ||
           std::find(further_states.begin(), further_states.end(), name) != further_states.end();
  }
  /// Unknown `i` in its own unit at coordinates `a`.
  [[nodiscard]] double physical(const Eigen::VectorXd& a, Eigen::Index i) const;
  /// Value of an expression at coordinates `a`.
  [[nodiscard]] double value(const Expression& expression, const Eigen::VectorXd& a) const;
};

/// A candidate with magnitudes.
struct Cause {
  const Candidate* candidate = nullptr;
  Eigen::VectorXd a;  ///< (k) coordinates of the unknowns
};

/// What a family lacks to be seen at all: empty if nothing.
struct Invisible {
  std::string hypothesis, reason;
};

struct Instantiated {
  std::vector<std::unique_ptr<Candidate>> candidates;
  std::vector<Invisible> invisible;
};

/// Every hypothesis at every location of its set. Where the rows come from several states of the structure, the question is
/// what changed. A part then differs from the model in all states, in one alone or, of three and more, from one state on. Its
/// factors go from 0.005 to 20 between states. A fault of a measurement is there in all states. Families whose needs the data
/// don't meet, or whose set is empty here, go to `invisible` with the reason.
/// @throws InputError  naming file and line for an unknown attribute, or bounds that are not low < high
[[nodiscard]] Instantiated instantiate(const std::vector<Hypothesis>& catalogue, const ReducedModel& model,
                                       const FeatureSet& features);

/// A condition's value of a key as a number, if it is known.
[[nodiscard]] std::optional<double> number_of(const Condition& condition, const std::string& key);

}  // namespace twindeck::diagnosis
