#include "diagnosis/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics.hpp"
#include "diagnosis/promising_ties.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kTies =
    24;  // pairs weighed in full: two magnitudes each cost 48 predictions, whatever the number of nodes
constexpr std::size_t kBeside = 8;   // nodes laid round a location: those of a field of shells on all sides
constexpr int kMostRounds = 8;       // each halves the way to the next location: 250 nodes between two become one
constexpr std::size_t kCentres = 4;  // families whose best location is looked round
constexpr double kFirstShare = 0.3;  // of the leader's odds: a cause between two locations may explain that little at either
constexpr double kLaterWithin = 6.0, kLaterShare = 0.1;  // nats of the leader, or of its odds: who can still pass it
constexpr double kUnfitted = -1e299;                     // log odds of entries that were only screened lie below
constexpr double kAtEnd = 0.06;                          // of a range: nearer to its end than this an unknown is at its bound

bool is_node_family(const Hypothesis& h) { return h.set == "nodes"; }
bool can_be_halved(const Hypothesis& h) { return h.set == "elements" || h.set == "groups"; }

/// The best entry of each family that can be looked round, the leader's first.
std::vector<const Scored*> centres_of(const std::vector<Scored>& ranking, bool first) {
  const double best = ranking.front().log_odds;
  std::set<std::string> families;
  std::vector<const Scored*> out;
  for (const Scored& scored : ranking) {
    const Hypothesis& h = *scored.candidate->hypothesis;
    if (!is_node_family(h) && !can_be_halved(h)) continue;
    if (out.size() == kCentres || !families.insert(h.id + " " + scored.candidate->state).second) continue;
    const double promise = std::max(scored.log_odds, 0.5 * scored.screen + scored.candidate->log_prior);
    const bool near = scored.log_odds > best - std::max(kLaterWithin, kLaterShare * best);
    if (near || (first && promise > kFirstShare * best)) out.push_back(&scored);
  }
  return out;
}

/// Effort for a handful of entries beside a leader that is known: its neighbours start from its magnitudes.
SearchOptions beside_a_leader(SearchOptions options) {
  options.short_list = 4;
  options.longest_list = 8;
  options.probes = 4;
  options.deepened = 1;
  options.most_refined = 2;
  return options;
}

/// Unknown of an oscillator that is its frequency, -1 for any other cause.
Index oscillator_frequency(const Candidate& candidate) {
  const Hypothesis& h = *candidate.hypothesis;
  if (h.actions.size() != 1 || h.actions[0].kind != "element.oscillator") return -1;
  if (h.actions[0].text.contains("direction")) return -1;  // a mass moves in all three
  const std::string& name = h.actions[0].number.at("frequency").name;
  for (std::size_t i = 0; i < h.unknowns.size(); ++i)
    if (name == "$" + h.unknowns[i].name) return static_cast<Index>(i);
  return -1;
}

}  // namespace

Refinement::Refinement(Structure structure, Places& places, ReducedModel& model, const FeatureSet& features)
    : structure_(std::move(structure)), places_(places), model_(model), features_(features), graph_(structure_) {
  if (const auto nodes = places_.sets.find("nodes"); nodes != places_.sets.end())
    for (const Place& place : nodes->second) located_.push_back(place.id.substr(place.id.find(':') + 1));
}

std::vector<Place> Refinement::places_round(const Scored& centre, Laid& laid) {
  const Candidate& candidate = *centre.candidate;
  std::vector<Place> out;
  if (is_node_family(*candidate.hypothesis)) {
    std::vector<std::string> names = graph_.between(candidate.location.substr(candidate.location.find(':') + 1), located_);
    if (names.size() > kBeside) names.resize(kBeside);
    for (const std::string& name : names) {
      located_.push_back(name);
      Place place = node_place(structure_, name);
      if (place.directions.nonZeros() > 0) out.push_back(std::move(place));  // a support may leave a node nothing but turning
    }
  } else if (looked_at_.insert(candidate.location).second) {
    for (const auto& [set, list] : places_.sets)
      for (const Place& place : list)
        if (place.id == candidate.location && out.empty()) out = halves_of(structure_, places_, place);
  }
  for (const Place& place : out) laid.ids.push_back(place.id);
  return out;
}

void Refinement::add_entry(Entries& entries, const Candidate& like, const ReducedPlace& place, const Scored* fitted) {
  for (const ActionSpec& action : like.hypothesis->actions)
    if ((action.kind.ends_with(".stiffness") && place.stiffness.size() == 0) ||
        (action.kind == "scale.mass" && place.mass.size() == 0))
      return;
  auto entry = std::make_unique<Candidate>(elsewhere(like, place.id, {&place}, features_));
  const bool known = fitted != nullptr && fitted->a.size() == entry->low.size() && fitted->a.size() > 0;
  if (entry->tuned >= 0) {
    if (!known) return;
    entry->tuned = -1;  // it starts where its neighbour was fitted
    entry->starts.clear();
    entry->tuning.clear();
  }
  if (known) {
    entry->starts.insert(entry->starts.begin(), fitted->a.cwiseMax(entry->low).cwiseMin(entry->high));
    entry->tuning.insert(entry->tuning.begin(), Tuning{});
  }
  sharing_[entry->refines].push_back(entry.get());
  entries.push_back(std::move(entry));
}

void Refinement::share_priors() {
  for (const auto& [entry, laid] : sharing_)
    for (Candidate* candidate : laid)
      candidate->log_prior = entry->log_prior - std::log(1.0 + static_cast<double>(laid.size()));
}

const Refinement::Entries& Refinement::round(const std::vector<const Scored*>& centres, const Entries& catalogue) {
  std::vector<Place> further;
  std::vector<Laid> laid;
  for (const Scored* centre : centres) {
    laid.push_back({centre, {}});
    for (Place& place : places_round(*centre, laid.back())) {
      if (further.empty()) ++sets_;
      further.push_back(std::move(place));
      places_.sets["between " + std::to_string(sets_)].push_back({further.back().id, further.back().x_m, {}, {}, {}, {}, {}});
    }
  }
  std::vector<const Candidate*> before;
  for (const auto& entry : catalogue) before.push_back(entry.get());
  for (const Entries& entries : entries_)
    for (const auto& entry : entries) before.push_back(entry.get());
  entries_.emplace_back();
  Entries& out = entries_.back();
  if (further.empty()) return out;
  const std::string set = "between " + std::to_string(sets_);
  places_.sets.erase(set);  // its names have kept halves apart; the model does not know it yet
  model_.extend(structure_, set, further);
  places_.sets[set] = std::move(further);
  for (const Laid& here : laid) {
    const Candidate& centre = *here.centre->candidate;
    for (const std::string& id : here.ids)
      for (const Candidate* like : before) {
        if (like->location != centre.location || like->hypothesis->set != centre.hypothesis->set) continue;
        const auto fitted =
            std::find_if(centres.begin(), centres.end(), [&](const Scored* scored) { return scored->candidate == like; });
        add_entry(out, *like, *model_.place(set, id), fitted == centres.end() ? nullptr : *fitted);
      }
  }
  share_priors();
  return out;
}

const Refinement::Entries& Refinement::ties(const Inference& inference, const Fit& base) {
  entries_.emplace_back();
  Entries& out = entries_.back();
  struct Family {
    const Candidate* first = nullptr;
    double pairs = 0.0;
  };
  std::map<std::pair<std::string, std::string>, Family> families;
  std::set<std::string> known;
  for (const auto& candidate : inference.candidates()) {
    if (candidate->hypothesis->set != "pairs(nodes)") continue;
    Family& family = families[{candidate->hypothesis->id, candidate->state}];
    if (family.first == nullptr) family.first = candidate.get();
    family.pairs += 1.0;
    known.insert(candidate->location);
  }
  for (const Entries& entries : entries_)
    for (const auto& entry : entries) known.insert(entry->location);
  const auto set = model_.sets.find("nodes");
  if (families.empty() || set == model_.sets.end()) return out;
  std::vector<const ReducedPlace*> nodes;
  for (const ReducedPlace& place : set->second) nodes.push_back(&place);
  const auto all = static_cast<double>(nodes.size());
  for (const auto& [from, to] : promising_ties(inference, base, nodes, kTies)) {
    const auto name = [](const ReducedPlace* node) { return node->id.substr(node->id.find(':') + 1); };
    const std::string location = "nodes:" + name(from) + "," + name(to);
    if (known.contains(location)) continue;
    for (const auto& [id, family] : families) {
      out.push_back(std::make_unique<Candidate>(elsewhere(*family.first, location, {from, to}, features_)));
      out.back()->refines = nullptr;  // it stands for itself among all pairs
      out.back()->log_prior = family.first->log_prior + std::log(family.pairs) - std::log(0.5 * all * (all - 1.0));
    }
  }
  return out;
}

void look_round_leader(const Inference& inference, const Fit& base, std::vector<Scored>& ranking,
                       const DiagnoseOptions& options) {
  TWINDECK_ASSERT(options.refinement != nullptr);
  std::vector<Scored> all = ranking;
  std::set<const Candidate*> of_catalogue;
  for (const Scored& scored : ranking) of_catalogue.insert(scored.candidate);
  const auto weigh = [&](const Refinement::Entries& entries) {
    if (entries.empty()) return;
    const Inference finer(inference.map(), entries);
    for (Scored& scored : finer.search(base, beside_a_leader(options.search))) all.push_back(std::move(scored));
    sort_by_odds(all);
  };
  // A further entry takes a part of its neighbours' prior.
  const auto add_priors = [&](double times) {
    for (Scored& scored : all)
      if (scored.candidate->refines != nullptr && scored.log_odds > kUnfitted)
        scored.log_odds += times * scored.candidate->log_prior;
  };
  for (const Refinement::Entries& entries : options.refinement->laid()) weigh(entries);
  weigh(options.refinement->ties(inference, base));
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<const Scored*> centres = centres_of(all, round == 0);
    if (centres.empty()) break;
    add_priors(-1.0);
    const Refinement::Entries& entries = options.refinement->round(centres, inference.candidates());
    add_priors(1.0);
    if (entries.empty()) break;
    sort_by_odds(all);
    weigh(entries);
  }
  if (!of_catalogue.contains(all.front().candidate)) ranking = std::move(all);
}

void prefer_mass_to_bound(const Inference& inference, const Fit& base, std::vector<Scored>& ranking, double ratio,
                          const DiagnoseOptions& options) {
  const Scored& leader = ranking.front();
  const Candidate& oscillator = *leader.candidate;
  const Index f = oscillator_frequency(oscillator);
  if (f < 0 || leader.a.size() != oscillator.low.size()) return;
  double reach = kAtEnd * (oscillator.high[f] - oscillator.low[f]);
  if (leader.a_covariance.rows() == leader.a.size())
    reach = std::max(reach, kReachOfNinety * std::sqrt(std::max(leader.a_covariance(f, f), 0.0)));
  if (leader.a[f] + reach < oscillator.high[f]) return;
  const auto mass = std::find_if(ranking.begin(), ranking.end(), [&](const Scored& scored) {
    const Candidate& c = *scored.candidate;
    return c.hypothesis->actions.size() == 1 && c.hypothesis->actions[0].kind == "mass.add" && c.low.size() == 1 &&
           c.location == oscillator.location && c.when == oscillator.when;
  });
  if (mass == ranking.end()) return;
  Scored nested = *mass;
  const double kg = oscillator.value(oscillator.hypothesis->actions[0].number.at("mass"), leader.a);
  const Candidate& c = *nested.candidate;
  nested.a = VectorXd::Constant(1, std::clamp(c.log[0] ? std::log(kg) : kg, c.low[0], c.high[0]));
  inference.fit_with_base(base, nested, leader.x.size() > 0 ? VectorXd(leader.x) : base.map.x);
  if (nested.log_odds > mass->log_odds) *mass = std::move(nested);
  const auto widened = [ratio](const Scored& scored) {
    const double prior = scored.candidate->log_prior;
    return (scored.log_odds - prior) / ratio + prior;
  };
  if (mass->log_odds > kUnfitted && widened(leader) - widened(*mass) < options.either_within)
    std::rotate(ranking.begin(), mass, mass + 1);
}

double merge_neighbours(std::vector<const Scored*>& members, std::vector<const Scored*>& merged) {
  const Candidate& leader = *members.front()->candidate;
  double within = 0.0;
  if (leader.refines == nullptr) return within;
  const auto is_neighbour = [&](const Scored* member) {
    const Candidate& c = *member->candidate;
    return &c != &leader && c.refines == leader.refines;
  };
  for (const Scored* member : members) {
    if (!is_neighbour(member)) continue;
    merged.push_back(member);
    const double distance = (member->candidate->places[0]->x_m - leader.places[0]->x_m).norm();
    if (std::isfinite(distance)) within = std::max(within, distance);
  }
  std::erase_if(members, is_neighbour);
  return within;
}

}  // namespace twindeck::diagnosis
