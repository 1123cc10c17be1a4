#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/prediction/feature_map.hpp"
#include "updating/joint_map.hpp"

namespace twindeck::diagnosis {

/// Stands for chi² of a fit that could not be made and, negative, for the log odds of an entry that was not weighed: beyond any
/// that data give.
inline constexpr double kNotFitted = 1e300;

/// Best account of the training rows with given causes in the model, linearised there.
struct Fit {
  std::vector<Cause> causes;  ///< at their best magnitudes
  updating::JointMap map;     ///< of [x; coordinates of the causes], on the training rows
  FeatureMap::Base base;
  Prediction all;                  ///< at the fit, every row
  Eigen::MatrixXd total_factor;    ///< L, L L' = Sigma_id + J P J' + free scales, causes not included
  Eigen::VectorXd whitened;        ///< w = L^-1 (y - g + J x): N(0, I) where nothing is missing
  double chi_squared = 0.0;        ///< w'w
  double log_determinant = 0.0;    ///< of Sigma_tot
  Eigen::MatrixXd cause_jacobian;  ///< L^-1 dg/da (n_train × n_coordinates of causes)
  /// Whether the fit could be made: the model predicts the rows and their derivatives there.
  [[nodiscard]] bool made() const { return !(chi_squared >= kNotFitted); }
};

/// A candidate held against the rows.
struct Scored {
  const Candidate* candidate = nullptr;
  Eigen::VectorXd a;
  double screen = 0.0;    ///< 2 ln likelihood ratio of the screen
  double log_odds = 0.0;  ///< ln posterior odds against nothing missing; only where fitted
  double chi_squared = 0.0;
  double remaining = 0.0;  ///< chi² that the best account with this cause leaves
  int stage = 1;           ///< 1 screened, 2 fitted on the linearised base or probed, 3 with the base fitted again
  std::vector<Eigen::VectorXd> other_starts;  ///< the next best magnitudes of the screen
  Eigen::VectorXd x;                          ///< of the joint fit, where there was one
  Eigen::VectorXd signature;                  ///< L^-1 (g(x, a) - g(x)) (n_train)
  Eigen::MatrixXd a_covariance;               ///< of the coordinates (stage 2 on)
  [[nodiscard]] bool weighed() const { return !(log_odds <= -kNotFitted); }
};

/// Descending log odds; equal ones keep their order.
void sort_by_odds(std::vector<Scored>& entries);

struct SearchOptions {
  int short_list = 6;
  int longest_list = 16;
  int tabled = 40;             ///< entries of the table that are computed anew, besides the best of each family
  int deepened = 4;            ///< further entries of the best one's family that are fitted with the base
  double family_screen = 4.0;  ///< families whose best entry screens above this are fitted too
  double refine_within = 6.0;  ///< nats of the best: these are fitted with the base
  int most_refined = 3;
  int most_rounds = 4;          ///< in which the leading ones are refitted, until one that was leads
  int tabled_tuned = 6;         ///< entries of each family that is tuned to modes that are computed anew
  int probes = 8;               ///< starts from which a few steps of the joint fit are made
  int probes_again = 2;         ///< of these, such as are looked at once more
  double broken_promise = 3.0;  ///< nats more than the best found that these promised
  int probe_iterations = 5;
  double least_promise = -1.0;  ///< nats that an entry must promise to be probed
};

/// What every candidate does to the rows at each magnitude that the screen tries, g(x, a) - g(x) at one base: it changes little
/// with x, so one table serves every data set of a model; the screen looks through it first, and computes anew what looks
/// promising.
struct ScreenTable {
  std::map<std::string, std::vector<Eigen::VectorXd>>
      change;  ///< by id of the candidate: (n_rows) each, size 0 where there is none
};

/// Fits, screens and weighs causes on the training rows of a feature map (docs/diagnosis.md).
class Inference {
 public:
  Inference(const FeatureMap& map, const std::vector<std::unique_ptr<Candidate>>& candidates);

  /// Joint MAP of x and the causes' magnitudes. `start`: x of a neighbouring fit; empty for zero. `iterations`: at most so many
  /// (a first look); 0: to convergence.
  [[nodiscard]] Fit fit(const std::vector<Cause>& causes, const Eigen::VectorXd& start, int iterations = 0) const;
  /// The same where it stands: `x` is not moved (the causes are none).
  [[nodiscard]] Fit stand(const Eigen::VectorXd& x) const { return fit({}, x, kStand); }
  /// Candidates in descending order of odds against `base`; those already in it are left out.
  /// @param known  where the screen looks first, and from which only what promises is computed anew; null: that of `use`, or
  ///               everything is. @param record  takes what a screen without such a table computed; may be null
  [[nodiscard]] std::vector<Scored> search(const Fit& base, const SearchOptions& options, const ScreenTable* known = nullptr,
                                           ScreenTable* record = nullptr) const;
  [[nodiscard]] ScreenTable screen_table(const Fit& base) const;
  /// An entry fitted together with x from `start` (empty: the prior's mean) and the magnitudes that it has.
  void fit_with_base(const Fit& base, Scored& scored, const Eigen::VectorXd& start) const { refine(base, scored, start); }
  /// Lets the searches look through a table first; it must outlive them.
  void use(const ScreenTable* table) { table_ = table; }
  /// A change of all rows as the training rows of a fit see it, L^-1 dg; empty for an empty one.
  [[nodiscard]] Eigen::VectorXd whitened(const Fit& base, const Eigen::VectorXd& change) const;
  /// Signature of a candidate at coordinates a, whitened; empty where it cannot be computed.
  [[nodiscard]] Eigen::VectorXd signature(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;

  /// What a candidate at coordinates a does to all rows; empty where it cannot be computed.
  [[nodiscard]] Eigen::VectorXd change(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;
  /// What a candidate does to all rows at the magnitudes that the screen tries.
  struct Tried {
    Eigen::VectorXd a, change;  ///< coordinates; g(x, a) - g(x) (n_rows)
  };
  [[nodiscard]] std::vector<Tried> tried(const Fit& base, const Candidate& candidate) const;

  [[nodiscard]] const std::vector<int>& training() const { return training_; }
  [[nodiscard]] const std::vector<int>& held_out() const { return held_out_; }
  [[nodiscard]] int dof() const { return static_cast<int>(training_.size()) - training_scales_; }
  [[nodiscard]] const FeatureMap& map() const { return map_; }
  /// Of the training rows' errors (n_train × n_train).
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return sigma_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Candidate>>& candidates() const { return candidates_; }

 private:
  static constexpr int kStand = -1;  ///< in place of a number of iterations: none
  /// An entry that is worth new signatures, at those of its starts that are (empty: at all).
  struct Promise {
    const Candidate* candidate;
    std::vector<std::size_t> starts;
  };
  /// Magnitudes that the screen tries, those tuned to modes where the base has the modes.
  [[nodiscard]] std::vector<Eigen::VectorXd> starts_at(const Fit& base, const Candidate& candidate) const;
  /// The best magnitude of the screen at the promised starts. @param from_table  changes of the table instead of new ones
  /// @param by_start  screens and starts, the best first; may be null @param record  takes the new changes, (n_starts); may be
  /// null
  [[nodiscard]] Scored screen(const Fit& base, const Promise& promise, const std::vector<Eigen::VectorXd>* from_table,
                              std::vector<std::pair<double, std::size_t>>* by_start,
                              std::vector<Eigen::VectorXd>* record) const;
  [[nodiscard]] std::vector<Promise> promising(const Fit& base, const SearchOptions& options, const ScreenTable* known) const;
  /// Every promising candidate that has a signature, the most promising first.
  [[nodiscard]] std::vector<Scored> screened(const Fit& base, const SearchOptions& options, const ScreenTable* known,
                                             ScreenTable* record) const;
  void probe(const Fit& base, std::vector<Scored>& found, const SearchOptions& options) const;
  void refine_all(const Fit& base, const std::vector<Scored*>& these) const;
  /// Refits the leading entries until one leads that was refitted.
  void refine_leading(const Fit& base, std::vector<Scored>& found, const SearchOptions& options) const;
  /// The entry at the best of its magnitudes, each fitted together with x.
  void refine_other_starts(const Fit& base, Scored& leading) const;
  void fit_linearised(const Fit& base, Scored& scored) const;
  /// Joint fit of x and the magnitudes from `start` (empty: the prior's mean), and the evidence there.
  void refine(const Fit& base, Scored& scored, const Eigen::VectorXd& start, int iterations = 0) const;
  /// Whitens what a joint fit leaves, with x and the causes as scatter. @param width  of the causes' coordinates, by which
  /// their columns were scaled (n_coordinates)
  void marginalise(const Eigen::VectorXd& width, Fit& fit) const;
  [[nodiscard]] Eigen::MatrixXd slopes(const FeatureMap::Base& at, const std::vector<Cause>& causes, std::size_t which,
                                       const Prediction& here) const;

  const FeatureMap& map_;
  const std::vector<std::unique_ptr<Candidate>>& candidates_;
  std::vector<int> training_, held_out_;
  Eigen::VectorXd y_;
  Eigen::MatrixXd sigma_, sigma_factor_;
  int training_scales_ = 0;
  const ScreenTable* table_ = nullptr;
};

/// Nats that k unknowns with a uniform prior cost: ln of posterior width over prior width, never a gain.
/// @param precision  of their coordinates in the likelihood (k × k)
[[nodiscard]] double ockham(const Eigen::MatrixXd& precision, const Candidate& candidate);

/// P(chi²_dof > x).
[[nodiscard]] double chi_squared_tail(double x, double dof);

}  // namespace twindeck::diagnosis
