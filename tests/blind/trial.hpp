#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"

/// Blind trials in the tier of features (sealed generator, diagnosis, scorer): the truth is computed on another mesh than the
/// one that diagnoses, with parameters and element scatter drawn anew for every case, the null ones too.
namespace twindeck::blind {

/// One side: a mesh with everything reduced.
struct Side {
  std::shared_ptr<diagnosis::DiagnosedModel> model;
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
};

struct Bench {
  Side truth, diagnosing;
  std::vector<matching::Channel> channels;
  std::vector<diagnosis::Hypothesis> catalogue;
  diagnosis::FeatureSet rows;  ///< of the diagnosing side: conditions, deviations, held-out marks; nominal values
  diagnosis::ScatterOptions scatter;
};

/// The refined Ponte del Mare on two meshes, with 16 channels and a campaign of nine conditions.
[[nodiscard]] Bench make_bench();

/// What a generator hid. Only its SHA-256 leaves with the case until it is scored.
struct Sealed {
  std::string kind;  ///< "null" | "effect" | "outside" | "two"
  std::vector<std::string> families, locations;
  std::vector<std::vector<double>> magnitudes;
  std::uint64_t seed = 0;
  double sigma = 0.0;           ///< norm of the (first) effect's whitened signature: how visible it is
  bool said_by_others = false;  ///< of one cause: another family has the same signature, and data can't tell which
  [[nodiscard]] std::string text() const;
};

/// A hidden truth before anything is measured on it: causes on the truth's side of the bench, and the family that the
/// diagnosing catalogue lacks ("" for none).
struct Hidden {
  Sealed seal;
  std::vector<diagnosis::Cause> causes;
  std::string removed;
};

struct HideOptions {
  std::set<std::string> only;  ///< families that are drawn from; empty: all
  double least_sigma = 3.0;    ///< smallest single effect, up to fifteen; at most three: or what a family shows at best
  char kind = 0;               ///< 'n' null, 'e' one cause, 't' two, 'o' outside the catalogue; 0: by the number
  int family = -1;             ///< place among `only` of the family whose turn it is; -1: by the number
};

/// What case number `seed` hides, by the shares of make_case.
[[nodiscard]] Hidden hide(const Bench& bench, std::uint64_t seed, const HideOptions& options);

struct Case {
  Eigen::VectorXd values;  ///< transformed rows
  std::string removed;     ///< family that the diagnosing catalogue lacks, "" for none
  Sealed seal;
};

/// Case number `seed`: of twenty five nulls, three outside the catalogue, one with two causes; families in turn, place and
/// magnitude from one stream.
/// @param noise_scale  of the errors against the declared deviations @param null  whatever the number says
/// @param campaign  0: the case's own; others: the same thing hidden in another bridge of the kind, measured with other errors
[[nodiscard]] Case make_case(const Bench& bench, std::uint64_t seed, double noise_scale = 1.0, bool null = false,
                             std::uint64_t campaign = 0);

/// How often the 90 % interval of the hidden cause's first unknown holds the truth when the cause is given and its size is
/// fitted: what is wrong with intervals alone, without the choice of the cause and without the luck of being noticed.
struct Coverage {
  std::string seal;
  int campaigns = 0, covered = 0;
};
/// @param seed  of a case with one cause that has a size; of others no campaign is made
[[nodiscard]] Coverage coverage(const Bench& bench, std::uint64_t seed, int campaigns);

/// The residual test alone on a null.
struct NullTest {
  double chi_squared;
  int dof;
  double p_value, block_p_value;
};
[[nodiscard]] NullTest residual_test(const Bench& bench, std::uint64_t seed);
/// Families that have a place on this bench. Called once before threads: it prepares what all cases share.
[[nodiscard]] std::vector<std::string> families_of(const Bench& bench);

struct Score {
  std::string kind, family;
  double sigma = 0.0, seconds = 0.0;
  bool detected = false, family_named = false, exact = false, in_set = false, both = false, unknown = false,
       gain_claimed = false;
  bool covered = false, sized = false, one_sided = false;  ///< the magnitude: within its interval, given, only a limit of it
  int set_size = 0;
  double log_odds = 0.0, chi_squared_ratio = 0.0, p_value = 1.0, block_p_value = 1.0, held_out_ratio = 1.0,
         magnitude_error = 0.0;
  double ratio_with_truth = 1.0;    ///< held-out RMS over that without a cause, for who knows the truth and fits its size
  bool said_by_others = false;      ///< as in the seal
  double family_probability = 0.0;  ///< that the answer itself gives to the first cause's family
  std::string verdict, found, seal;
};

/// The entry's part of what a seal hid, in the entry's coordinates; the entry's low bounds if it has none.
[[nodiscard]] diagnosis::Cause cause_of(const diagnosis::Candidate& entry, const Sealed& seal);

[[nodiscard]] Score score_of(const Sealed& seal, const diagnosis::Diagnosis& result, double seconds);
/// Diagnosis of a case as step 9 makes it, but for even prior odds: this bench's model is exact in form.
[[nodiscard]] Score run_case(const Bench& bench, const Case& hidden);

}  // namespace twindeck::blind
