#include "matching/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/lists.hpp"
#include "diagnosis/prediction/predictor.hpp"
#include "linalg/dense.hpp"

/// Pairs of measured modes and modes of the model.
namespace twindeck::diagnosis {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// [-] Motion of the channels in a mode, over the largest of all modes, below which the mode is at rest there. Smaller motions
/// are rounding (1e-12 of the vertical motion for axial modes of a girder) and may resemble any shape.
constexpr double kAtRest = 1e-6;
constexpr double kNever = 100.0;  ///< replaces 1 - MAC of a mode at rest; larger than any cost of frequencies

/// Difference of ln f that counts as one step: in the state of the model; in other states, where parts may have changed so much
/// that frequencies double, and where shapes decide more.
constexpr double kFrequencyWidth = 0.08, kChangedWidth = 0.35;
/// Steps up to which a difference of frequencies counts fully, and the share added at any distance, so that of two far modes
/// the nearer one costs less.
constexpr double kFarSteps = 4.0, kFarther = 0.05;
/// Weight of the squared steps. With it, modes without shapes are paired in the order of their frequencies. Without it, two
/// pairs would cost the same crossed, and rounding would decide.
constexpr double kUncrossed = 1e-6;

/// Difference of ln of damping ratios above which the cost is constant, and the least total damping of a computed mode over its
/// structural damping, if its dampers' part is negative.
constexpr double kFarDamping = 3.0, kLeastDamping = 1e-3;

/// Steps that 1 - MAC = 1 costs: for a shape measured in this condition, for one measured under the same name in another
/// condition, and for the model's mode that the name is bound to. The last is more than `kFarSteps`, so a bound name decides up
/// to a distance of 40 steps. The others are less, so two far frequencies outweigh two measured shapes.
constexpr double kShapeHere = 3.0, kShapeElsewhere = 2.0, kBoundShape = 6.0;

/// Steps that it costs a measured mode with a shape to have no mode of the model: a far frequency and half the weight of its
/// shape. The right shape at a far frequency costs less, and so does a poor shape at the right frequency. A MAC below
/// kLeastAlike means another mode. A mode without a shape is left without a partner only if the model has too few modes.
constexpr double kNoCounterpart = kFarSteps + 0.5 * kShapeHere, kLeastAlike = 0.2;

}  // namespace

VectorXd likeness(const MatrixXcd& shapes, const VectorXcd& measured) {
  VectorXd mac(shapes.cols());
  if (shapes.cols() == 0) return mac;
  const double norm = measured.squaredNorm();
  const double least = kAtRest * kAtRest * shapes.colwise().squaredNorm().maxCoeff();
  for (Index j = 0; j < mac.size(); ++j) {
    const double own = shapes.col(j).squaredNorm(), norms = norm * own;
    mac[j] = norms > 0.0 && own > least ? std::norm(shapes.col(j).dot(measured)) / norms : 0.0;
  }
  return mac;
}

bool Predictor::may_be_none(const MeasuredMode& measured) const {
  return measured.real_rows.size() >= 2 && !map_.features().rows[static_cast<std::size_t>(measured.real_rows.front())].held_out;
}

const MeasuredMode& Predictor::shaped_like(const MeasuredMode& measured) const {
  const auto has_shape = [](const MeasuredMode& m) { return m.real_rows.size() >= 2; };
  const MeasuredMode* shaped = &measured;
  if (!has_shape(measured))
    for (const MeasuredMode& other : map_.modes_)
      if (other.label == measured.label && map_.same_state(other.condition, measured.condition) && has_shape(other)) {
        shaped = &other;
        break;
      }
  each_action(Primitive::modes_exchange, map_.features().conditions[static_cast<std::size_t>(measured.condition)],
              [&](const Candidate& c, const VectorXd&, const ActionSpec&) {
                // The shape under this label and that of the next mode of the list are exchanged. The list is not sorted by
                // frequency, because close modes differ in order between data sets.
                std::vector<const MeasuredMode*> same;
                for (const MeasuredMode& other : map_.modes_)
                  if (other.condition == shaped->condition && has_shape(other)) same.push_back(&other);
                for (std::size_t k = 0; k + 1 < same.size(); ++k) {
                  if (same[k]->label != c.mode) continue;
                  if (shaped == same[k])
                    shaped = same[k + 1];
                  else if (shaped == same[k + 1])
                    shaped = same[k];
                  break;
                }
              });
  return *shaped;
}

VectorXd Predictor::unlike_measured(const MeasuredMode& shaped, const SolvedState& state) {
  VectorXcd y(static_cast<Index>(shaped.real_rows.size()));
  for (std::size_t k = 0; k < shaped.real_rows.size(); ++k) {
    Complex value = map_.values_[shaped.real_rows[k]];
    for (std::size_t q = 0; q < shaped.imag_rows.size(); ++q)
      if (shaped.imag_channels[q] == shaped.real_channels[k]) value += Complex(0.0, map_.values_[shaped.imag_rows[q]]);
    y[static_cast<Index>(k)] = value;
  }
  const MatrixXcd moved = motion(state, reading(shaped.condition))(shaped.real_channels, Eigen::all);
  VectorXd unlike = 1.0 - likeness(moved, y).array();
  const VectorXd own =
      moved.colwise().squaredNorm();  // a mode with a measured shape moves the channels, so no mode at rest can be its partner
  for (Index j = 0; j < own.size(); ++j)
    if (own[j] <= kAtRest * kAtRest * own.maxCoeff()) unlike[j] = kNever;
  return unlike;
}

VectorXd Predictor::unlike_bound(int position, const SolvedState& state) const {
  // Modes of the unchanged model use the common coordinates only.
  const Index common = map_.model().common;
  const VectorXd reference = map_.model().mode_coordinates.col(position);
  const VectorXd mass_reference = matrices(state.columns).second.leftCols(common) * reference;
  const double norm = reference.dot(mass_reference.head(common));
  const MatrixXd re = state.modes.shapes.real(), im = state.modes.shapes.imag();
  const Index rows = mass_reference.size();
  const VectorXd along =
      (re.topRows(rows).transpose() * mass_reference).cwiseAbs2() + (im.topRows(rows).transpose() * mass_reference).cwiseAbs2();
  const VectorXd own = re.cwiseProduct(linalg::product(state.state.mass, re)).colwise().sum() +
                       im.cwiseProduct(linalg::product(state.state.mass, im)).colwise().sum();
  return 1.0 - along.cwiseQuotient(norm * own).cwiseMin(1.0).array();
}

VectorXd Predictor::far_from_measured(const MeasuredMode& measured, const SolvedState& state, double width) const {
  const Index n = state.modes.s.size();
  VectorXd steps = VectorXd::Zero(n);
  if (measured.frequency >= 0)
    for (Index j = 0; j < n; ++j) {
      const double f = state.modes.frequency_Hz(j);
      if (!(f > 0.0)) continue;
      const double distance = std::abs(std::log(f / measured.frequency_Hz)) / width;
      steps[j] += std::min(distance, kFarSteps) + kFarther * distance + kUncrossed * distance * distance;
    }
  // The damping by dampers separates close modes without shapes. A factor e is the uncertainty of structural damping.
  if (measured.damping < 0 || !state.state.damped()) return steps;
  const double own = structural_damping(map_.damping_name(measured.label, measured.condition));
  for (Index j = 0; j < n; ++j) {
    const double total = std::max(own + 100.0 * state.modes.damping(j), kLeastDamping * own);
    steps[j] += std::min(std::abs(std::log(total) - map_.values_[measured.damping]), kFarDamping);
  }
  return steps;
}

void Predictor::pair(const std::vector<int>& conditions) {
  SolvedState& state = solved(conditions.front());
  const Index n = state.modes.s.size();
  if (n == 0) return;
  // In one state of the structure, a label is one mode in all conditions. So no cause may exchange it with its neighbour at a
  // large amplitude.
  std::vector<std::string> labels;
  std::map<std::string, VectorXd> cost, by_shape;
  std::map<std::string, double> cost_of_none;
  std::vector<std::size_t> here;
  for (std::size_t m = 0; m < map_.modes_.size(); ++m) {
    const MeasuredMode& measured = map_.modes_[m];
    if (!contains(conditions, measured.condition)) continue;
    here.push_back(m);
    VectorXd& sum = cost.try_emplace(measured.label, VectorXd::Zero(n)).first->second;
    double& open = cost_of_none[measured.label];
    open += may_be_none(measured) ? kNoCounterpart : kNever;
    if (!contains(labels, measured.label)) labels.push_back(measured.label);
    const bool first = map_.features().condition_of(measured).state == map_.states_.front();
    sum += far_from_measured(measured, state, first ? kFrequencyWidth : kChangedWidth);
    if (measured.damping >= 0 && state.state.damped()) open += 0.5 * kFarDamping;
    // Shapes are known from this condition, or from another in which the label was measured with one.
    const MeasuredMode& shaped = shaped_like(measured);
    // Labels are bound to modes of the model in the first state only.
    const auto bound = first ? map_.bound_modes_.find(measured.label) : map_.bound_modes_.end();
    if (shaped.real_rows.size() >= 2) {
      VectorXd unlike = unlike_measured(shaped, state);
      for (double& u : unlike)
        if (may_be_none(measured) && u > 1.0 - kLeastAlike && u <= 1.0) u = 2.0 * kNoCounterpart / kShapeHere;
      sum += (measured.real_rows.size() >= 2 ? kShapeHere : kShapeElsewhere) * unlike;
    } else if (bound != map_.bound_modes_.end() && bound->second < map_.model().mode_coordinates.cols()) {
      // Without a shape: the mode of the unchanged structure that the label is bound to, followed by likeness of shapes.
      VectorXd& unlike = by_shape[measured.label];
      if (unlike.size() == 0) unlike = unlike_bound(bound->second, state);
      sum += kBoundShape * unlike;
    }
  }
  const Index count = std::ssize(labels);
  Eigen::MatrixXd gain(count, n + count);  // the last columns mean: no mode of the model
  for (Index i = 0; i < count; ++i) {
    const std::string& label = labels[static_cast<std::size_t>(i)];
    gain.row(i) << -cost.at(label).transpose(), Eigen::RowVectorXd::Constant(count, -cost_of_none.at(label));
  }
  const std::vector<int> chosen = matching::best_assignment(gain);
  for (const std::size_t m : here) {
    const auto at = std::ranges::find(labels, map_.modes_[m].label) - labels.begin();
    const int mode = chosen[static_cast<std::size_t>(at)];
    out_.paired[m] = mode < n ? mode : -1;
  }
}

}  // namespace twindeck::diagnosis
