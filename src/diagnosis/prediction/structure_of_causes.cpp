#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "diagnosis/prediction/predictor.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double kPersonMass = 75.0;  ///< [kg] the base model's crowd

/// Value of the condition's key that an action refers to, NaN if unknown.
double variable(const ActionSpec& action, const Condition& condition) {
  const auto named = action.text.find("variable");
  const std::string key = named == action.text.end() ? "temperature_C" : named->second;
  const auto value = [&](const std::optional<double>& v) { return v.value_or(std::numeric_limits<double>::quiet_NaN()); };
  if (key == "amplitude_m") return value(condition.amplitude_m);
  if (key == "wind_m_s") return value(condition.wind_m_s);
  if (key == "people") return value(condition.people);
  return value(condition.temperature_C);
}

/// Attribute of a location, 0 if it has none of this name.
double place_number(const ReducedPlace& place, const char* name) {
  const auto at = place.attributes.find(name);
  return at == place.attributes.end() ? 0.0 : at->second;
}

/// Adds one degree of freedom to a state.
void grow(StructureState& state) {
  const Index n = state.stiffness.rows() + 1;
  state.stiffness.conservativeResizeLike(MatrixXd::Zero(n, n));
  state.mass.conservativeResizeLike(MatrixXd::Zero(n, n));
  for (Attachment& a : state.attachments) a.direction.conservativeResizeLike(VectorXd::Zero(n));
  if (state.amplitude_row.size() > 0) state.amplitude_row.conservativeResizeLike(Eigen::RowVectorXd::Zero(n));
}

/// Directions of an action at a location: the vertical one if the action says so and the location can move vertically, else
/// all.
std::vector<Index> directions_of(const ReducedPlace& place, const ActionSpec& action) {
  const auto named = action.text.find("direction");
  const bool vertical = named != action.text.end() && named->second == "vertical";
  if (vertical && place.directions.cols() == 3 && !place.directions.is_zero(2)) return {2};
  std::vector<Index> all(static_cast<std::size_t>(place.directions.cols()));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace

Predictor::Predictor(const FeatureMap& map, const FeatureMap::Base& base, const std::vector<Cause>& causes, bool with_jacobian)
    : map_(map), base_(base), causes_(causes), with_jacobian_(with_jacobian), undamped_(&base.store->undamped) {
  read_channels();
}

MatrixXd Predictor::sliced(const ReducedMatrix& full, const std::vector<int>& columns, Index size) {
  MatrixXd part = full.part(columns);
  if (size > part.rows()) part.conservativeResizeLike(MatrixXd::Zero(size, size));
  return part;
}

VectorXd Predictor::sliced(const ReducedDirections& full, Index d, const std::vector<int>& columns, Index size) {
  VectorXd part = full.part(d, columns);
  if (size > part.size()) part.conservativeResizeLike(VectorXd::Zero(size));
  return part;
}

bool Predictor::acts(const Cause& cause, const ActionSpec& action, const Condition& condition) const {
  if (!cause.candidate->acts_in(condition)) return false;
  const Primitive does = action.primitive;
  if (acts_on(does) == ActsOn::damper)
    return condition.dampers_on.value_or(cause.candidate->places[0]->attributes.at("always_on") != 0.0);
  const auto value = [&](const char* name) { return cause.candidate->value(action.number.at(name), cause.a); };
  if (does == Primitive::field_stiffness || does == Primitive::soften_stiffness)
    return std::isfinite(variable(action, condition));
  if (does == Primitive::step_stiffness) return variable(action, condition) < value("below");
  if (does == Primitive::slip_stiffness) return variable(action, condition) > value("above");
  if (does == Primitive::mass_per_count) return condition.people.value_or(0.0) > 0.0;
  return changes_structure(does);
}

/// A damper with the changes by causes.
struct Predictor::DamperInUse {
  double damping, stiffness, threshold;
  std::pair<const ReducedDirections*, Index> direction;
  bool series, sliding, absent = false;
};

Predictor::DamperInUse Predictor::damper_in(const Condition& condition, const ReducedPlace& damper) const {
  const double threshold = place_number(damper, "friction");
  DamperInUse out{place_number(damper, "damping"), place_number(damper, "stiffness"),     threshold,
                  {&damper.directions, 0},         place_number(damper, "series") != 0.0, threshold > 0.0};
  for (const Cause& cause : causes_) {
    if (!cause.candidate->acts_in(condition)) continue;
    const auto& places = cause.candidate->places;
    const auto here = std::ranges::find(places, &damper);
    if (here == places.end()) continue;
    for (const ActionSpec& action : cause.candidate->hypothesis->actions) {
      const auto value = [&](const char* name) { return cause.candidate->value(action.number.at(name), cause.a); };
      if (action.primitive == Primitive::damper_absent) out.absent = true;
      if (action.primitive == Primitive::damper_move) out.direction = {&places.back()->directions, here - places.begin()};
      if (action.primitive == Primitive::damper_damping) out.damping *= value("factor");
      if (action.primitive == Primitive::damper_series) {
        out.stiffness = value("stiffness");
        out.series = true;
      }
      if (action.primitive == Primitive::damper_friction) {
        out.stiffness = value("stiffness");
        out.threshold = value("threshold");
        out.sliding = true;
      }
    }
  }
  return out;
}

void Predictor::apply_dampers(const Condition& condition, StructureState& state) const {
  const auto dampers = map_.model().sets.find("dampers");
  if (dampers == map_.model().sets.end()) return;
  const Index n = state.stiffness.rows();
  for (const ReducedPlace& damper : dampers->second) {
    const bool fitted = place_number(damper, "always_on") != 0.0, on = condition.dampers_on.value_or(fitted);
    const DamperInUse used = damper_in(condition, damper);
    const bool acts = on && !used.absent, moved = used.direction.first != &damper.directions;
    const bool in_series = used.series && used.stiffness > 0.0;
    // The model's stiffness includes the spring of a fitted damper, unless it is in series with the dashpot.
    const double spring = place_number(damper, "stiffness"),
                 held = fitted && place_number(damper, "series") == 0.0 ? spring : 0.0;
    const double beside = acts && !used.sliding && !in_series ? spring : 0.0;
    const auto& ratio = damper.stiffness_law.ratio;
    const VectorXd b = sliced(*used.direction.first, used.direction.second, columns_, n);
    if (moved) add_spring(sliced(damper.directions, 0, columns_, n), -held, ratio, state);
    add_spring(b, beside - (moved ? 0.0 : held), ratio, state);
    if (!acts) continue;
    const auto kind = used.sliding ? Attachment::Kind::jenkins
                      : in_series  ? Attachment::Kind::maxwell
                                   : Attachment::Kind::dashpot;
    const double mount = used.sliding || in_series ? used.stiffness : 0.0;
    state.attachments.push_back({kind, b, mount, used.damping, used.sliding ? used.threshold : 0.0});
  }
}

double Predictor::stiffness_change(const Cause& cause, const ActionSpec& action, const Condition& condition) const {
  const Candidate& candidate = *cause.candidate;
  const auto value = [&](const char* name) { return candidate.value(action.number.at(name), cause.a); };
  const Primitive does = action.primitive;
  if (does == Primitive::scale_stiffness) return value("factor") - 1.0;
  const double v = variable(action, condition);
  if (does == Primitive::field_stiffness) return std::isfinite(v) ? value("rate") * (v - value("reference")) : 0.0;
  // The hyperbola of soils (Hardin and Drnevich, J. Soil Mech. Found. Div. ASCE 98 SM7, 1972).
  if (does == Primitive::soften_stiffness) return std::isfinite(v) ? -(v / (v + value("half"))) : 0.0;
  if (does == Primitive::step_stiffness) return v < value("below") ? value("factor") - 1.0 : 0.0;
  if (does == Primitive::slip_stiffness) return v > value("above") ? value("factor") - 1.0 : 0.0;
  return 0.0;
}

void Predictor::apply(const Cause& cause, const ActionSpec& action, const Condition& condition, StructureState& state) const {
  const Candidate& candidate = *cause.candidate;
  if (candidate.places.empty()) return;
  const ReducedPlace& place = *candidate.places[0];
  const auto value = [&](const char* name) { return candidate.value(action.number.at(name), cause.a); };
  const Index n = state.stiffness.rows();
  const Primitive does = action.primitive;
  if (const double change = stiffness_change(cause, action, condition); change != 0.0) {
    add_change(place, change, false, state);
  } else if (does == Primitive::scale_mass) {
    add_change(place, value("factor") - 1.0, true, state);
  } else if (does == Primitive::support_move) {
    move_support(place, value("position"), state);
  } else if (does == Primitive::mass_add) {
    for (Index d = 0; d < place.directions.cols(); ++d) {
      const VectorXd b = sliced(place.directions, d, columns_, n);
      state.mass += value("mass") * b * b.transpose();
    }
  } else if (does == Primitive::mass_per_count) {
    const auto deck = place.attributes.find("deck_mass") != place.attributes.end() ? place.attributes.at("deck_mass")
                                                                                   : place.attributes.at("total_mass");
    const double people = condition.people.value_or(0.0);
    if (people > 0.0) state.mass += people * (value("mass") - value("assumed")) / deck * sliced(place.mass, columns_, n);
  } else if (does == Primitive::element_spring) {
    apply_spring(candidate, action, value("stiffness"), state);
  } else if (has_own_motion(does)) {
    apply_body(place, action, value("mass"), 2.0 * std::numbers::pi * value("frequency"), state);
  }
}

// A cause scales a location with its own error: half of a bearing that is 10 % too stiff is 0.55.
void Predictor::add_change(const ReducedPlace& place, double change, bool mass, StructureState& state) const {
  MatrixXd& to = mass ? state.mass : state.stiffness;
  const ReducedMatrix& whole = mass ? place.mass : place.stiffness;
  const ParameterLaw<ReducedMatrix>& law = mass ? place.mass_law : place.stiffness_law;
  law.each(whole, base_.theta,
           [&](double amount, const ReducedMatrix& part) { to += change * amount * sliced(part, columns_, to.rows()); });
  law.each_slope(whole, base_.theta, [&](int p, double slope, const ReducedMatrix& part) {
    followed_.push_back({p, change * slope, &part, mass, {}});
  });
  for (std::size_t j = 0; j < map_.nuisances().size(); ++j) {
    const Nuisance& v = map_.nuisances()[j];
    if (v.kind != Nuisance::Kind::place || v.of_mass != mass) continue;
    const ReducedPlace& own = map_.place_of(v);
    const bool moves = v.set == "supports" && own.id == place.id && place.attributes.contains("stations");
    if (&own != &place && !moves) continue;
    to += change * v.deviation * base_.x[static_cast<Index>(j)] * sliced(map_.scattered(v), columns_, to.rows());
    followed_.push_back({-1, change, &map_.scattered(v), mass, {}, static_cast<int>(j)});
  }
}

void Predictor::move_support(const ReducedPlace& support, double position, StructureState& state) const {
  const auto stations = static_cast<Index>(support.attributes.at("stations"));
  const Index springs = support.directions.cols() / stations, n = state.stiffness.rows();
  add_change(support, -1.0, false, state);
  const auto [i, t] = on_line(support.attributes, position);
  for (Index d = 0; d < springs; ++d) {
    const double k = support.attributes.at("k_" + std::to_string(d));
    const VectorXd b = (1.0 - t) * sliced(support.directions, i * springs + d, columns_, n) +
                       t * sliced(support.directions, (i + 1) * springs + d, columns_, n);
    add_spring(b, k, support.stiffness_law.ratio, state);
  }
}

void Predictor::add_spring(const VectorXd& b, double k, const fe::Coefficient& ratio, StructureState& state) const {
  if (k == 0.0) return;
  state.stiffness += ratio.value(base_.theta) * k * b * b.transpose();
  for (const fe::ParameterFactor& factor : ratio.factors)
    followed_.push_back({factor.parameter, k * ratio.derivative(base_.theta, factor.parameter), nullptr, false, b});
}

void Predictor::apply_spring(const Candidate& candidate, const ActionSpec& action, double stiffness,
                             StructureState& state) const {
  const ReducedPlace& place = *candidate.places[0];
  const Index n = state.stiffness.rows();
  const auto add = [&](const VectorXd& b) { state.stiffness += stiffness * b * b.transpose(); };
  const auto own = [&](const ReducedPlace& at, Index d) { return sliced(at.directions, d, columns_, n); };
  if (candidate.places.size() != 2) {
    for (const Index d : directions_of(place, action)) add(own(place, d));
    return;
  }
  const ReducedPlace& other = *candidate.places[1];
  const Eigen::Vector3d along = other.x_m - place.x_m;
  const Index shared = std::min(place.directions.cols(), other.directions.cols());
  if (along.allFinite() && along.norm() > 0.0 && shared == 3) {  // a tie acts along its line
    VectorXd b = VectorXd::Zero(n);
    for (Index d = 0; d < 3; ++d) b += along.normalized()[d] * (own(place, d) - own(other, d));
    add(b);
  } else {
    for (Index d = 0; d < shared; ++d) add(own(place, d) - own(other, d));
  }
}

void Predictor::apply_body(const ReducedPlace& place, const ActionSpec& action, double m, double omega,
                           StructureState& state) const {
  const bool string = action.primitive == Primitive::element_string;
  // An attached body moves in all directions of the node, or only vertically; a cable in the two directions across its chord.
  for (const Index d : directions_of(place, action)) {
    grow(state);
    const Index k = state.stiffness.rows() - 1;
    const VectorXd b = sliced(place.directions, d, columns_, k + 1);
    if (string) {  // first sine of a chord with a moving lower end: mass m/2 of itself, m/pi with the end, m/3 at the end
      state.mass += m / 3.0 * b * b.transpose();
      state.mass(k, k) += 0.5 * m;
      state.mass.col(k) += m / std::numbers::pi * b;
      state.mass.row(k) += m / std::numbers::pi * b.transpose();
      state.stiffness(k, k) += 0.5 * m * omega * omega;
    } else {
      VectorXd relative = -b;
      relative[k] = 1.0;
      state.mass(k, k) += m;
      state.stiffness += m * omega * omega * relative * relative.transpose();
    }
  }
}

StructureState Predictor::build_state(const Condition& condition) const {
  StructureState state;
  const auto n = static_cast<Index>(columns_.size());
  std::tie(state.stiffness, state.mass) = matrices(columns_);
  const double people = condition.people.value_or(0.0);
  if (const auto global = map_.model().sets.find("global"); people > 0.0 && global != map_.model().sets.end()) {
    const ReducedPlace& deck = global->second.front();
    const auto mass = deck.attributes.contains("deck_mass") ? deck.attributes.at("deck_mass") : map_.model().total_mass_kg;
    state.mass += people * kPersonMass / mass * sliced(deck.mass, columns_, n);
  }
  if (condition.amplitude_m && !condition.amplitude_channel.empty()) {
    const auto& channels = map_.features().channels;
    const auto at = std::ranges::find(channels, condition.amplitude_channel);
    if (at != channels.end()) {
      state.amplitude_row = map_.model().sensors.row(4 * (at - channels.begin()))(columns_);
      state.amplitude_m = *condition.amplitude_m;
    }
  }
  apply_dampers(condition, state);
  for (const Cause& cause : causes_) {
    if (!cause.candidate->acts_in(condition)) continue;
    for (const ActionSpec& action : cause.candidate->hypothesis->actions) apply(cause, action, condition, state);
  }
  return state;
}

}  // namespace twindeck::diagnosis
