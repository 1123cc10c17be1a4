#include "diagnosis/causes/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.hpp"

namespace twindeck::diagnosis {

std::optional<double> number_of(const Condition& condition, const std::string& key) {
  if (key == "amplitude_m") return condition.amplitude_m;
  if (key == "temperature_C") return condition.temperature_C;
  if (key == "wind_m_s") return condition.wind_m_s;
  if (key == "direction_deg") return condition.direction_deg;
  if (key == "people") return condition.people;
  if (key == "dampers" && condition.dampers_on) return *condition.dampers_on ? 1.0 : 0.0;
  return std::nullopt;
}

namespace {

using Eigen::Index;

/// Why these data cannot show a family; empty if they can.
std::string unmet(const Needs& needs, const FeatureSet& features) {
  std::set<int> used;
  std::set<std::string> types;
  for (const Row& row : features.rows) {
    used.insert(row.condition);
    types.insert(name_of(row.type));
  }
  for (const auto& [key, wanted] : needs.conditions) {
    bool met = false;
    for (const int c : used) {
      const auto value = number_of(features.conditions[static_cast<std::size_t>(c)], key);
      if (!value) continue;
      met = met || wanted == "known" || (wanted == "on" && *value != 0.0) || (wanted == "off" && *value == 0.0) ||
            (wanted == "above_zero" && *value > 0.0);
    }
    if (!met) return fmt::format("no condition with {} = {}", key, wanted);
  }
  for (const auto& [key, count] : needs.distinct) {
    std::set<double> values;
    for (const int c : used)
      if (const auto value = number_of(features.conditions[static_cast<std::size_t>(c)], key)) values.insert(*value);
    if (static_cast<int>(values.size()) < count)
      return fmt::format("needs {} different values of {}, the rows have {}", count, key, values.size());
  }
  if (!needs.rows.empty() && std::ranges::none_of(needs.rows, [&](const auto& t) { return types.contains(t); }))
    return fmt::format("no row of type {}", fmt::join(needs.rows, " or "));
  return "";
}

bool resolvable(const Candidate& candidate);

/// Range of a stay's first frequency. If it was measured, the range is three deviations to either side; otherwise a wide range
/// around the value of the modelled pull. Empty if neither is known.
std::map<std::string, double> own_frequency(const Candidate& candidate, const FeatureSet& features) {
  double weights = 0.0, mean = 0.0;
  for (const Row& row : features.rows) {
    if (row.type != RowType::stay_frequency || "stay:" + row.stay != candidate.location || !(row.std > 0.0)) continue;
    const double number = std::max(1.0, std::atof(row.mode.c_str()));  // the n-th harmonic is n times the first
    const double weight = std::pow(row.value / row.std, 2);
    weights += weight;
    mean += weight * std::log(row.value / number);
  }
  if (weights > 0.0) {
    const double f = std::exp(mean / weights), spread = std::max(3.0 / std::sqrt(weights), 0.02);
    return {{"f_own", f}, {"f_own_low", f * std::exp(-spread)}, {"f_own_high", f * std::exp(spread)}};
  }
  const auto modelled = candidate.places[0]->attributes.find("f_cable");
  if (modelled == candidate.places[0]->attributes.end()) return {};
  return {{"f_own", modelled->second}, {"f_own_low", 0.6 * modelled->second}, {"f_own_high", 1.6 * modelled->second}};
}

std::set<int> measured_channels(const FeatureSet& features) {
  std::set<int> measured;
  for (const Row& row : features.rows)
    if (row.channel >= 0) measured.insert(row.channel);
  return measured;
}

/// Whether there are load tests, and a support of this name that holds vertically.
bool can_settle(const ReducedModel& model, const std::string& support) {
  const auto& grounds = model.load_tests.grounds;
  return std::ranges::any_of(
      grounds, [&](const Ground& ground) { return ground.support == support && ground.settle.squaredNorm() > 0.0; });
}

Candidate& add(const Hypothesis& h, const std::string& location, std::vector<Candidate>& found) {
  found.emplace_back();
  found.back().hypothesis = &h;
  found.back().location = location;
  return found.back();
}

void add_channels(const Hypothesis& h, const FeatureSet& features, std::vector<Candidate>& found) {
  for (const int c : measured_channels(features))
    add(h, "channel:" + features.channels[static_cast<std::size_t>(c)], found).channels = {c};
}

void add_pairs_of_channels(const Hypothesis& h, const FeatureSet& features, std::vector<Candidate>& found) {
  const std::set<int> measured = measured_channels(features);
  for (const int c : measured)
    for (const int d : measured) {
      if (d <= c) continue;
      const auto& a = features.direction[static_cast<std::size_t>(c)];
      const auto& b = features.direction[static_cast<std::size_t>(d)];
      const bool known = a.squaredNorm() > 0.0 && b.squaredNorm() > 0.0;
      if (h.filter == "same_direction" && known && std::abs(a.dot(b)) < 0.7) continue;
      const std::string& of_c = features.channels[static_cast<std::size_t>(c)];
      add(h, "channels:" + of_c + "," + features.channels[static_cast<std::size_t>(d)], found).channels = {c, d};
    }
}

/// Adds each measured mode once, in the order of the rows.
void add_modes(const Hypothesis& h, const FeatureSet& features, std::vector<Candidate>& found) {
  std::set<std::string> known;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency && known.insert(row.mode).second) add(h, "mode:" + row.mode, found).mode = row.mode;
}

/// Adds pairs of nodes: all pairs of up to nine nodes; otherwise each node with the four nearest of the later ones.
void add_pairs_of_nodes(const Hypothesis& h, const std::vector<ReducedPlace>& nodes, std::vector<Candidate>& found) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t j = i + 1; j < nodes.size(); ++j) {
      const double distance = (nodes[i].x_m - nodes[j].x_m).norm();
      others.emplace_back(std::isfinite(distance) ? distance : static_cast<double>(j - i), j);
    }
    const std::size_t taken = nodes.size() <= 9 ? others.size() : std::min<std::size_t>(4, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(taken), others.end());
    for (std::size_t k = 0; k < taken; ++k) {
      const ReducedPlace& other = nodes[others[k].second];
      add(h, "nodes:" + nodes[i].id.substr(5) + "," + other.id.substr(5), found).places = {&nodes[i], &other};
    }
  }
}

/// Adds moves of dampers. Locations of a candidate: the dampers in the order of the moved forces, then the new location.
void add_damper_moves(const Hypothesis& h, const ReducedModel& model, const std::vector<ReducedPlace>& moves,
                      std::vector<Candidate>& found) {
  for (const ReducedPlace& moved : moves) {
    Candidate& candidate = add(h, moved.id, found);
    std::string names = moved.id.substr(8, moved.id.find('@') - 8) + ",";
    for (std::size_t comma = names.find(','); comma != std::string::npos; names.erase(0, comma + 1), comma = names.find(','))
      candidate.places.push_back(model.place("dampers", "damper:" + names.substr(0, comma)));
    candidate.places.push_back(&moved);
    if (contains(candidate.places, nullptr)) found.pop_back();
  }
}

/// Adds types of dampers. Locations of a candidate: all dampers of the type.
void add_damper_types(const Hypothesis& h, const ReducedModel& model, const std::vector<ReducedPlace>& types,
                      std::vector<Candidate>& found) {
  for (const ReducedPlace& type : types) {
    Candidate& all = add(h, type.id, found);
    for (const ReducedPlace& damper : model.sets.at("dampers"))
      if (damper.attributes.contains("type") && damper.attributes.at("type") == type.attributes.at("type"))
        all.places.push_back(&damper);
  }
}

/// Whether each action of a candidate finds a stiffness, mass or support to act on.
bool can_act(const Candidate& candidate, const ReducedModel& model) {
  if (candidate.places.empty()) return true;
  const ReducedPlace& place = *candidate.places[0];
  return std::ranges::none_of(candidate.hypothesis->actions, [&](const ActionSpec& action) {
    return (scales_stiffness(action.primitive) && place.stiffness.size() == 0) ||
           (action.primitive == Primitive::support_settle && !can_settle(model, candidate.location)) ||
           (action.primitive == Primitive::scale_mass && place.mass.size() == 0);
  });
}

/// Largest motion of a node in a mode of the unchanged model.
double motion_of(const ReducedPlace& node, const ReducedModel& model) {
  double most = 0.0;
  std::vector<int> common(static_cast<std::size_t>(model.common));
  std::iota(common.begin(), common.end(), 0);
  for (Index d = 0; d < node.directions.cols(); ++d)
    most = std::max(most, (node.directions.part(d, common).transpose() * model.mode_coordinates).cwiseAbs().maxCoeff());
  return most;
}

/// Leaves out held nodes, where a mass or oscillator cannot vibrate: those that move less than a part `held` of the largest
/// motion.
void leave_out_held_nodes(const ReducedModel& model, std::vector<Candidate>& found) {
  constexpr double held = 1e-3;
  const auto motion = each_of(found, [&](const Candidate& one) { return motion_of(*one.places[0], model); });
  const double least = motion.empty() ? 0.0 : held * *std::max_element(motion.begin(), motion.end());
  std::size_t at = 0;
  std::erase_if(found, [&](const Candidate&) { return motion[at++] < least; });
}

/// Candidates at all locations of a set, without bounds and priors.
std::vector<Candidate> locations(const Hypothesis& h, const ReducedModel& model, const FeatureSet& features) {
  std::vector<Candidate> found;
  const auto of_model = model.sets.find(h.set == "pairs(nodes)" ? "nodes" : h.set);
  const bool there = of_model != model.sets.end();
  if (h.set == "channels") {
    add_channels(h, features, found);
  } else if (h.set == "pairs(channels)") {
    add_pairs_of_channels(h, features, found);
  } else if (h.set == "modes") {
    add_modes(h, features, found);
  } else if (there && h.set == "pairs(nodes)") {
    add_pairs_of_nodes(h, of_model->second, found);
  } else if (there && h.set == "damper_moves") {
    add_damper_moves(h, model, of_model->second, found);
  } else if (there && h.set == "damper_types") {
    add_damper_types(h, model, of_model->second, found);
  } else if (there) {
    for (const ReducedPlace& place : of_model->second) add(h, place.id, found).places = {&place};
  }
  const bool carries = h.does(Primitive::mass_add) || h.does(Primitive::element_oscillator);
  if (h.set == "nodes" && carries) leave_out_held_nodes(model, found);
  // A spring to the ground is tried only at nodes without support. At a bearing it would be the bearing's stiffness.
  if (h.set == "nodes" && h.does(Primitive::element_spring))
    std::erase_if(found, [](const Candidate& candidate) { return candidate.places[0]->attributes.contains("supported"); });
  if (h.set == "stays")
    for (Candidate& candidate : found) candidate.own = own_frequency(candidate, features);
  std::erase_if(found, [&](const Candidate& candidate) { return !can_act(candidate, model) || !resolvable(candidate); });
  return found;
}

/// Value of an attribute of the location; empty if it has none of this name.
std::optional<double> attribute_if(const Candidate& candidate, const Expression& e) {
  const std::vector<std::string>& known = place_numbers();
  if (const auto at = candidate.own.find(e.name); at != candidate.own.end()) return at->second;
  for (const ReducedPlace* place : candidate.places) {
    const auto at = place->attributes.find(e.name);
    if (at != place->attributes.end()) return at->second;
  }
  if (is_place_number(e.name)) return std::nullopt;
  throw InputError({candidate.hypothesis->file, e.line, candidate.hypothesis->id},
                   fmt::format("'{}' is no number known at {}", e.name, candidate.location),
                   fmt::format("use a number, or one of {}", fmt::join(known, ", ")));
}

double attribute(const Candidate& candidate, const Expression& e) { return attribute_if(candidate, e).value_or(0.0); }

/// Whether the location has a number for every bound that refers to it (a stay without pull has no frequency).
bool resolvable(const Candidate& candidate) {
  const auto there = [&](const Expression& e) {
    return e.name.empty() || e.name == "f_measured" || attribute_if(candidate, e).has_value();
  };
  return std::ranges::all_of(candidate.hypothesis->unknowns, [&](const UnknownSpec& u) {
    return there(u.low) && there(u.high) && std::ranges::all_of(u.start, there);
  });
}

/// [-] Range of a factor between two states of a structure. Parts are replaced, cut or propped between states, so the bounds of
/// the model's uncertainty do not apply.
constexpr double kLeastChange = 0.005, kMostChange = 20.0;
constexpr double kChangeStarts[] = {0.02, 0.08, 0.2, 0.45, 0.75, 1.35, 2.2, 5.0, 12.0};

/// Whether a cause is a part of the structure, which one state may have and another state may not.
bool is_a_part(const Hypothesis& h) {
  return !h.measurement && std::ranges::all_of(h.actions, [](const ActionSpec& action) {
    const ActsOn what = acts_on(action.primitive);
    return what == ActsOn::part || adds(action.primitive) || what == ActsOn::damper || what == ActsOn::stay ||
           what == ActsOn::support;
  });
}

/// Whether a cause is a fault of sensors, which may be mounted anew for each state.
bool is_of_channels(const Hypothesis& h) {
  return h.measurement &&
         std::ranges::all_of(h.actions, [](const ActionSpec& action) { return acts_on(action.primitive) == ActsOn::channel; });
}

/// Consecutive states in which a hypothesis acts; empty: all states.
struct AskedStates {
  std::vector<std::string> states;
  std::string when;  ///< as Candidate::when
};

/// States in which a hypothesis is tried. A part may change in one state alone. With three and more states, it may also change
/// from one state on, because damage remains until it is repaired. A part that differs in all states is an error of the model.
/// Sensors are taken down and mounted again, so that a fault of one is tried like an added part.
std::vector<AskedStates> states_asked(const Hypothesis& h, const std::vector<std::string>& states) {
  if (states.size() < 2 || !(is_a_part(h) || is_of_channels(h))) return {{}};
  std::vector<AskedStates> out;
  for (auto state = states.begin() + 1; state != states.end(); ++state) out.push_back({{*state}, "state " + *state});
  for (auto state = states.begin() + 1; state + 1 != states.end(); ++state)
    out.push_back({{state, states.end()}, fmt::format("from state {} on", *state)});
  // More in a later state may mean less in the first one. A factor covers both; a cause that only adds, or that is a fault of
  // the sensors, is tried for the earlier states too.
  if (is_of_channels(h) || std::ranges::all_of(h.actions, adds, &ActionSpec::primitive)) {
    out.push_back({{states.front()}, "state " + states.front()});
    for (auto state = states.begin() + 2; state < states.end(); ++state)
      out.push_back({{states.begin(), state}, "before state " + *state});
  }
  if (!h.does(Primitive::support_settle)) out.emplace_back();  // events before the first state are no error of the model
  return out;
}

/// Modes of the condition that has the most of them, for causes that may resonate.
struct MeasuredModes {
  int condition = -1;
  std::vector<std::pair<std::string, double>> modes;  ///< label, frequency [Hz]
};

MeasuredModes measured_modes(const FeatureSet& features) {
  MeasuredModes measured;
  for (std::size_t c = 0; c < features.conditions.size(); ++c) {
    MeasuredModes here{static_cast<int>(c), {}};
    for (const Row& row : features.rows)
      if (row.condition == here.condition && row.type == RowType::frequency) here.modes.emplace_back(row.mode, row.value);
    if (here.modes.size() > measured.modes.size()) measured = here;
  }
  return measured;
}

/// A trial magnitude of one unknown, in the unknown's coordinate.
struct Start {
  double value;
  Tuning tuning;
};

/// Attribute of the candidate's first location, `otherwise` if there is none.
double of_material(const Candidate& candidate, const char* name, double otherwise) {
  if (candidate.places.empty()) return otherwise;
  const auto found = candidate.places[0]->attributes.find(name);
  return found == candidate.places[0]->attributes.end() ? otherwise : found->second;
}

double resolved(const Candidate& candidate, const Expression& e) {
  return e.name.empty() ? e.factor : e.factor * attribute(candidate, e);
}

/// Whether an unknown is the factor between two states of a structure.
bool is_change(const Candidate& candidate, const UnknownSpec& u) { return !candidate.state.empty() && u.name == "factor"; }

struct Range {
  double low, high;
};

/// Bounds of an unknown at the candidate's location, in its own unit.
/// @throws InputError  unless low < high
Range range_of(const Candidate& candidate, const UnknownSpec& u) {
  double low = resolved(candidate, u.low), high = resolved(candidate, u.high);
  if (is_change(candidate, u)) {
    low = of_material(candidate, "least_change", std::min(low, kLeastChange));
    high = of_material(candidate, "most_change", std::max(high, kMostChange));
  }
  if (!(low < high) || (u.log && !(low > 0.0))) {
    const Hypothesis& h = *candidate.hypothesis;
    throw InputError({h.file, u.low.line, h.id + "." + u.name},
                     fmt::format("bounds {} and {} at {}, expected low < high{}", low, high, candidate.location,
                                 u.log ? ", both above 0" : ""),
                     "mend low and high in the catalogue");
  }
  return {low, high};
}

/// Starts of an unknown within its bounds; the middle of its coordinate where there are none.
std::vector<Start> starts_of(const Candidate& candidate, const UnknownSpec& u, const Range& range, double middle,
                             const MeasuredModes& measured) {
  std::vector<Start> tried, starts;
  for (const Expression& e : u.start) {
    if (e.name == "f_measured")
      for (const auto& [label, f] : measured.modes) tried.push_back({e.factor * f, {label, measured.condition, e.factor}});
    else
      tried.push_back({resolved(candidate, e), {}});
  }
  if (is_change(candidate, u))
    for (const double start_at : kChangeStarts) tried.push_back({start_at, {}});
  for (Start s : tried) {
    if (!(s.value > range.low && s.value < range.high)) continue;
    if (u.log) s.value = std::log(s.value);
    starts.push_back(s);
  }
  if (starts.empty()) starts = {{middle, {}}};
  return starts;
}

/// All combinations of the unknowns' starts; the last unknown varies fastest.
void combine(const std::vector<std::vector<Start>>& by_unknown, Candidate& candidate) {
  candidate.starts = {Eigen::VectorXd(std::ssize(by_unknown))};
  candidate.tuning = {Tuning{}};
  for (std::size_t i = 0; i < by_unknown.size(); ++i) {
    std::vector<Eigen::VectorXd> grown;
    std::vector<Tuning> tuning;
    for (std::size_t n = 0; n < candidate.starts.size(); ++n)
      for (const Start& s : by_unknown[i]) {
        grown.push_back(candidate.starts[n]);
        grown.back()[static_cast<Index>(i)] = s.value;
        tuning.push_back(s.tuning.mode.empty() ? candidate.tuning[n] : s.tuning);
      }
    candidate.starts = grown;
    candidate.tuning = tuning;
  }
}

/// Bounds and starts of the unknowns at the candidate's place.
void bound(Candidate& candidate, const MeasuredModes& measured) {
  const Hypothesis& h = *candidate.hypothesis;
  candidate.low.resize(std::ssize(h.unknowns));
  candidate.high.resize(std::ssize(h.unknowns));
  std::vector<std::vector<Start>> starts;
  for (Index i = 0; i < std::ssize(h.unknowns); ++i) {
    const UnknownSpec& u = h.unknowns[static_cast<std::size_t>(i)];
    const Range range = range_of(candidate, u);
    candidate.log.push_back(u.log);
    candidate.low[i] = u.log ? std::log(range.low) : range.low;
    candidate.high[i] = u.log ? std::log(range.high) : range.high;
    if (std::ranges::any_of(u.start, [](const Expression& e) { return e.name == "f_measured"; }))
      candidate.tuned = static_cast<int>(i);
    starts.push_back(starts_of(candidate, u, range, 0.5 * (candidate.low[i] + candidate.high[i]), measured));
  }
  combine(starts, candidate);
}

}  // namespace

double Candidate::physical(const Eigen::VectorXd& a, Index i) const {
  return log[static_cast<std::size_t>(i)] ? std::exp(a[i]) : a[i];
}

double Candidate::value(const Expression& e, const Eigen::VectorXd& a) const {
  if (e.name.empty()) return e.factor;
  if (e.name.front() == '$') {
    for (std::size_t i = 0; i < hypothesis->unknowns.size(); ++i)
      if (hypothesis->unknowns[i].name == e.name.substr(1)) return e.factor * physical(a, static_cast<Index>(i));
    throw InputError({hypothesis->file, e.line, hypothesis->id}, "names no unknown: " + e.name,
                     "declare it as a [[parameter]]");
  }
  return e.factor * attribute(*this, e);
}

Instantiated instantiate(const std::vector<Hypothesis>& catalogue, const ReducedModel& model, const FeatureSet& features) {
  Instantiated out;
  double weights = 0.0;
  const std::vector<std::string> states = states_of(features);
  const MeasuredModes measured = measured_modes(features);
  std::vector<std::vector<Candidate>> families;
  for (const Hypothesis& h : catalogue) {
    families.emplace_back();
    if (const std::string reason = unmet(h.needs, features); !reason.empty()) {
      out.invisible.push_back({h.id, reason});
      continue;
    }
    for (const AskedStates& asked : states_asked(h, states)) {
      for (Candidate& candidate : locations(h, model, features)) {
        if (!asked.states.empty()) {
          candidate.state = asked.states.front();
          candidate.further_states.assign(asked.states.begin() + 1, asked.states.end());
        }
        candidate.when = asked.when;
        families.back().push_back(std::move(candidate));
      }
    }
    if (families.back().empty()) {
      out.invisible.push_back({h.id, fmt::format("this model and these rows have no {} for it", h.set)});
      continue;
    }
    weights += h.prior_weight;
  }
  for (std::vector<Candidate>& family : families) {
    for (Candidate& candidate : family) {
      candidate.log_prior = std::log(candidate.hypothesis->prior_weight / weights / static_cast<double>(family.size()));
      bound(candidate, measured);
      out.candidates.push_back(std::make_unique<Candidate>(std::move(candidate)));
    }
  }
  return out;
}

}  // namespace twindeck::diagnosis
