#include <algorithm>
#include <utility>

#include "core/lists.hpp"
#include "diagnosis/prediction/predictor.hpp"
#include "diagnosis/reduction/independent_coordinates.hpp"

/// States of the structure: the state of each condition, solved once, and the derivatives of its modes.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
constexpr double kUnknown = -1e300;  ///< in the key of a state: unknown value of the condition

/// Modes of a state in the coordinates of another one with the same own degrees of freedom; empty if it lacks one of the
/// columns.
StateModes in_coordinates_of(const SolvedState& state, const SolvedState& near) {
  const auto shared = static_cast<Index>(near.columns.size()), own = near.modes.shapes.rows() - shared;
  StateModes out;
  out.shapes = Eigen::MatrixXcd::Zero(state.state.stiffness.rows(), near.modes.s.size());
  for (Index k = 0; k < shared; ++k) {
    const auto at = std::ranges::find(state.columns, near.columns[static_cast<std::size_t>(k)]);
    if (at == state.columns.end()) return {};
    out.shapes.row(at - state.columns.begin()) = near.modes.shapes.row(k);
  }
  out.shapes.bottomRows(own) = near.modes.shapes.bottomRows(own);
  out.s = near.modes.s;
  return out;
}

}  // namespace

/// Causes and circumstances that act in a condition. Conditions with equal ones share one solution.
struct Predictor::Acting {
  std::vector<double> causes, before_last;  ///< acting causes, by entry and magnitudes; the same without the last one
  bool follows = false;                     ///< the last cause does not act on dampers and adds no degree of freedom
  std::vector<int> columns;                 ///< columns of the reduced model that the state needs
  bool temperature = false, amplitude = false, wind = false;  ///< circumstances that the state depends on
};

Predictor::Acting Predictor::acting_in(const Condition& condition) const {
  Acting out;
  for (int k = 0; k < map_.model().common; ++k) out.columns.push_back(k);
  for (const Cause& cause : causes_) {
    bool any = false, alone = false;
    for (const ActionSpec& action : cause.candidate->hypothesis->actions) {
      if (!acts(cause, action, condition)) continue;
      any = true;
      const bool field = action.primitive == Primitive::field_stiffness || action.primitive == Primitive::soften_stiffness;
      const auto named = action.text.find("variable");
      const std::string key = named == action.text.end() ? "temperature_C" : named->second;
      out.temperature = out.temperature || (field && key == "temperature_C");
      out.amplitude = out.amplitude || (field && key == "amplitude_m") || action.primitive == Primitive::damper_friction;
      out.wind = out.wind || (field && key == "wind_m_s");
      alone = alone || acts_on(action.primitive) == ActsOn::damper || has_own_motion(action.primitive);
    }
    if (!any) continue;
    out.before_last = out.causes;
    out.follows = !alone;
    // A cause is identified by its catalogue entry and its magnitudes.
    out.causes.push_back(static_cast<double>(reinterpret_cast<std::uintptr_t>(cause.candidate)));
    for (Index i = 0; i < cause.a.size(); ++i) out.causes.push_back(cause.a[i]);
    for (const ReducedPlace* place : cause.candidate->places)
      for (const int k : place->columns)
        if (!contains(out.columns, k)) out.columns.push_back(k);
  }
  const auto dampers = map_.model().sets.find("dampers");
  if (dampers != map_.model().sets.end() && condition.dampers_on.value_or(false))
    for (const ReducedPlace& damper : dampers->second) out.amplitude = out.amplitude || damper.attributes.contains("friction");
  return out;
}

std::vector<double> Predictor::circumstances(const Condition& condition, const Acting& acting) const {
  std::vector<double> key = {condition.dampers_on ? (*condition.dampers_on ? 1.0 : 0.0) : kUnknown,
                             condition.people.value_or(0.0)};
  key.push_back(acting.temperature ? condition.temperature_C.value_or(kUnknown) : 0.0);
  key.push_back(acting.amplitude ? condition.amplitude_m.value_or(kUnknown) : 0.0);
  const auto& channels = map_.features().channels;
  const auto channel = std::ranges::find(channels, condition.amplitude_channel) - channels.begin();
  key.push_back(acting.amplitude ? static_cast<double>(channel) : 0.0);
  key.push_back(acting.wind ? condition.wind_m_s.value_or(kUnknown) : 0.0);
  return key;
}

void Predictor::build(SolvedState& entry, const Condition& condition, const std::vector<int>& columns) const {
  const auto build_in = [&](std::vector<int> these) {
    columns_ = entry.columns = std::move(these);
    followed_.clear();
    entry.state = build_state(condition);
    entry.followed = followed_;
  };
  build_in(columns);
  const Index n = std::ssize(columns), common = map_.model().common;
  if (n == common) return;
  const std::vector<Index> kept =
      independent_coordinates(entry.state.stiffness.topLeftCorner(n, n), entry.state.mass.topLeftCorner(n, n), common);
  if (std::ssize(kept) == n) return;
  build_in(each_of(kept, [&](Index k) { return columns[static_cast<std::size_t>(k)]; }));
}

SolvedState& Predictor::solved(int c) {
  if (const auto known = of_condition_.find(c); known != of_condition_.end()) return *known->second;
  const Condition& condition = map_.features().conditions[static_cast<std::size_t>(c)];
  const Acting acting = acting_in(condition);
  const std::vector<double> key = circumstances(condition, acting);
  auto& states = base_.store->states;
  const auto known = states.find({acting.causes, key});
  std::shared_ptr<SolvedState> entry = known == states.end() ? nullptr : known->second;
  if (const auto mine = own_.find({acting.causes, key}); !entry && mine != own_.end()) entry = mine->second;
  if (!entry) {
    entry = std::make_shared<SolvedState>();
    build(*entry, condition, acting.columns);
    // Only states that will be used again are kept: those without causes, and those that a Jacobian will be computed for.
    const bool kept = acting.causes.empty() || with_jacobian_ || base_.keeps;
    // Damped modes are followed from those without the last cause.
    const auto neighbour = acting.follows ? states.find({acting.before_last, key}) : states.end();
    StateModes from;
    if (neighbour != states.end() && entry->state.damped()) from = in_coordinates_of(*entry, *neighbour->second);
    entry->modes = solve_state(entry->state, map_.highest_Hz_, kept ? base_.store->undamped : undamped_,
                               from.s.size() > 0 ? &from : nullptr);
    (kept ? states : own_)[{acting.causes, key}] = entry;
  }
  of_condition_[c] = entry.get();
  return *entry;
}

const std::pair<MatrixXd, MatrixXd>& Predictor::matrices(const std::vector<int>& columns) const {
  auto& known = base_.keeps ? base_.store->matrices : matrices_;
  const auto at = known.find(columns);
  return at != known.end() ? at->second : known.emplace(columns, map_.matrices(base_, columns)).first->second;
}

const StateStore::Changes& Predictor::changes(const SolvedState& state) const {
  const std::vector<int>& columns = state.columns;
  const Index size = state.state.stiffness.rows();
  const auto [at, is_new] = base_.store->changes.try_emplace({columns, size});
  StateStore::Changes& out = at->second;
  if (!is_new) return out;
  const ReducedModel& model = map_.model();
  for (std::size_t j = 0; j < map_.nuisances().size(); ++j) {
    const Nuisance& v = map_.nuisances()[j];
    MatrixChange dk, dm;
    const auto add = [&](MatrixChange& to, double a, const ReducedMatrix& from) {
      if (from.is_local() && to.empty()) {  // multiplied when needed: a thousand dense matrices would fill the memory
        to.amount = a;
        to.local = &from;
        return;
      }
      if (to.local != nullptr) to = {to.amount * sliced(*to.local, columns, size), 0.0, nullptr};
      if (to.dense.size() == 0) to.dense = MatrixXd::Zero(size, size);
      to.dense += a * sliced(from, columns, size);
    };
    if (v.kind == Nuisance::Kind::parameter) {
      for (const auto& term : model.stiffness)
        if (const double a = term.coefficient.derivative(base_.theta, v.index); a != 0.0) add(dk, v.deviation * a, term.matrix);
      for (const auto& term : model.mass)
        if (const double a = term.coefficient.derivative(base_.theta, v.index); a != 0.0) add(dm, v.deviation * a, term.matrix);
    } else if (v.kind == Nuisance::Kind::place) {
      add(v.of_mass ? dm : dk, v.deviation, map_.scattered(v));
    } else {
      continue;
    }
    out.position.push_back(static_cast<int>(j));
    out.stiffness.push_back(std::move(dk));
    out.mass.push_back(std::move(dm));
  }
  return out;
}

const ModeDerivative& Predictor::derivative(SolvedState& solved, Index mode) {
  if (!solved.derivatives.contains(mode)) differentiate_modes(solved, {mode});
  return solved.derivatives.at(mode);
}

void Predictor::differentiate_modes(SolvedState& solved, std::vector<Index> modes) const {
  std::erase_if(modes, [&](Index mode) { return solved.derivatives.contains(mode); });
  if (modes.empty()) return;
  const auto n = solved.modes.shapes.rows(), count = std::ssize(modes);
  MatrixXd parts(n, 2 * count);  // real parts, imaginary parts
  parts << solved.modes.shapes(Eigen::all, modes).real(), solved.modes.shapes(Eigen::all, modes).imag();
  Moved moved;
  const MatrixXd stiffness = changed(solved, false, parts, moved), mass = changed(solved, true, parts, moved);
  const auto changes = std::ssize(this->changes(solved).position);
  for (Index k = 0; k < count; ++k) {
    const Index mode = modes[static_cast<std::size_t>(k)];
    const auto of_mode = [&](const MatrixXd& product) {
      Eigen::MatrixXcd out(n, changes);
      out.real() = product.middleCols(k * changes, changes);
      out.imag() = product.middleCols((count + k) * changes, changes);
      return out;
    };
    const std::complex<double> square = solved.modes.s[mode] * solved.modes.s[mode];
    const Eigen::MatrixXcd inertia = of_mode(mass);
    const Eigen::MatrixXcd force = -of_mode(stiffness) - square * inertia;
    ModeDerivative found = differentiate(solved.state, solved.modes, mode, force);
    found.along = along_the_shape(solved.state, solved.modes, mode, found.s, inertia);
    solved.derivatives.emplace(mode, std::move(found));
  }
}

MatrixXd Predictor::changed(const SolvedState& state, bool mass, const MatrixXd& x, Moved& moved) const {
  const StateStore::Changes& change = changes(state);
  MatrixXd out = times(state.columns, mass ? change.mass : change.stiffness, x, moved);
  const auto count = std::ssize(change.position);
  for (const SolvedState::Followed& followed : state.followed) {
    if (followed.mass != mass) continue;
    MatrixXd part = MatrixXd::Zero(x.rows(), x.cols());
    if (const Index n = followed.spring.size(); n > 0)  // own degrees of freedom of later causes come after n
      part.topRows(n) = followed.spring * (followed.spring.transpose() * x.topRows(n));
    else
      part = sliced(*followed.part, state.columns, x.rows()) * x;
    for (Index j = 0; j < count; ++j) {
      const int position = change.position[static_cast<std::size_t>(j)];
      const Nuisance& v = map_.nuisances()[static_cast<std::size_t>(position)];
      if (followed.nuisance != position && (v.kind != Nuisance::Kind::parameter || v.index != followed.parameter)) continue;
      for (Index p = 0; p < x.cols(); ++p) out.col(p * count + j) += v.deviation * followed.amount * part.col(p);
    }
  }
  return out;
}

MatrixXd Predictor::times(const std::vector<int>& columns, const std::vector<MatrixChange>& changes, const MatrixXd& x,
                          Moved& moved) const {
  const auto count = std::ssize(changes), n = std::ssize(columns);
  MatrixXd out = MatrixXd::Zero(x.rows(), count * x.cols());
  std::vector<Index> moving;  // undamped modes have no imaginary part
  for (Index p = 0; p < x.cols(); ++p)
    if (!x.col(p).isZero(0.0)) moving.push_back(p);
  const MatrixXd here = x(Eigen::all, moving);
  MatrixXd product(x.rows(), here.cols());
  for (Index j = 0; j < count; ++j) {
    const MatrixChange& change = changes[static_cast<std::size_t>(j)];
    product.setZero();
    if (change.dense.size() > 0) product.noalias() = change.dense * here;
    if (change.local != nullptr) {
      if (moved.motion.size() == 0) {
        moved.own = change.local->basis().own(columns);
        moved.motion = change.local->basis().motion(moved.own, here.topRows(n));
      }
      change.local->add_product(change.amount, moved.own, moved.motion, product.topRows(n));
    }
    for (std::size_t k = 0; k < moving.size(); ++k) out.col(moving[k] * count + j) = product.col(static_cast<Index>(k));
  }
  return out;
}

}  // namespace twindeck::diagnosis
