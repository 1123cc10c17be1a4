#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/reduction/finer_places.hpp"

/// Candidate locations round the leading ones: laid between those of the catalogue after something was detected and before it
/// is named. Takes the structure, its places and its reduced model, which grow; gives entries that the search weighs like all
/// others.
namespace twindeck::diagnosis {

/// Owns the entries that it lays; they must outlive every result that names them.
///
/// Priors. All entries that were laid round one entry of the catalogue share its prior evenly with it: of n, each has 1/(n+1)
/// of it. A tie between promising nodes has the weight of its family over the number of all pairs of candidate nodes. So a
/// cause does not become more probable by being asked at more locations.
///
/// Thresholds. Entries are laid only where the catalogue's own best entry is above the threshold. What is detected is decided
/// by the entries that the threshold was found for; what is laid decides where it is and what it is called.
class Refinement {
 public:
  using Entries = std::vector<std::unique_ptr<Candidate>>;

  /// @param structure  that the places and the model were made of
  Refinement(Structure structure, Places& places, ReducedModel& model, const FeatureSet& features);

  /// Entries at places round the given ones: nodes between candidate locations, halves of a zone or group. Each family that the
  /// catalogue asks at a location is asked at the nodes round it; one that is tuned to modes only from magnitudes that a fit
  /// found, for its starts are many.
  /// @param catalogue  entries of the search
  /// @return           empty where nothing finer is there
  const Entries& round(const std::vector<const Scored*>& centres, const Entries& catalogue);
  /// Ties between the nodes that the fit's residual makes promising and that the catalogue does not have.
  const Entries& ties(const Inference& inference, const Fit& base);
  /// Everything that was laid so far: a later search asks it again beside the causes that were accepted.
  [[nodiscard]] const std::deque<Entries>& laid() const { return entries_; }

 private:
  struct Laid {
    const Scored* centre;
    std::vector<std::string> ids;
  };
  [[nodiscard]] std::vector<Place> places_round(const Scored& centre, Laid& laid);
  void add_entry(Entries& entries, const Candidate& like, const ReducedPlace& place, const Scored* fitted);
  void share_priors();

  Structure structure_;
  Places& places_;
  ReducedModel& model_;
  const FeatureSet& features_;
  NodeGraph graph_;
  std::vector<std::string> located_;                             ///< nodes that are candidate locations
  std::set<std::string> looked_at_;                              ///< places that have been halved
  std::deque<Entries> entries_;                                  ///< of each round
  std::map<const Candidate*, std::vector<Candidate*>> sharing_;  ///< by the entry of the catalogue
  int sets_ = 0;
};

/// Lays locations round the leading entries of a ranking until the leader does not move and every place beside it is a
/// location. Where an entry that was laid leads, the ranking becomes that of all entries; otherwise it stays as it is.
void look_round_leader(const Inference& inference, const Fit& base, std::vector<Scored>& ranking,
                       const DiagnoseOptions& options);

/// An oscillator far above all that is measured moves with its node like a mass. Where the frequency of a leading oscillator
/// runs to its upper bound, the mass at its node is fitted from the oscillator's fit, and leads unless the oscillator is better
/// by more than `either_within`.
/// @param ratio  by which likelihoods are widened
void prefer_mass_to_bound(const Inference& inference, const Fit& base, std::vector<Scored>& ranking, double ratio,
                          const DiagnoseOptions& options);

/// Takes members out of a cluster that are the leader's own cause at locations laid beside it: the location is as exact as
/// that. @return the largest distance of one from the leader [m], 0 where none was
double merge_neighbours(std::vector<const Scored*>& members, std::vector<const Scored*>& merged);

}  // namespace twindeck::diagnosis
