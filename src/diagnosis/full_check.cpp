#include "diagnosis/full_check.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "linalg/generalized_eigen.hpp"

namespace twindeck::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void add_outer(MatrixXd& to, double amount, const VectorXd& u, const VectorXd& v) { to += amount * u * v.transpose(); }
void add_outer(Symmetric& to, double amount, const VectorXd& u, const VectorXd& v) {
  const Eigen::SparseMatrix<double> a = u.sparseView(), b = v.sparseView();
  to += amount * Eigen::SparseMatrix<double>(a * Eigen::SparseMatrix<double>(b.transpose()));
}
void grow(MatrixXd& k) { k.conservativeResizeLike(MatrixXd::Zero(k.rows() + 1, k.cols() + 1)); }
void grow(Symmetric& k) { k.conservativeResize(k.rows() + 1, k.cols() + 1); }

void add_part(MatrixXd& to, double amount, const ReducedMatrix& part, const std::vector<int>& columns) {
  to.topLeftCorner(std::ssize(columns), std::ssize(columns)) += amount * part.part(columns);
}
/// Adds entry by entry, because adding a hundred whole sparse matrices would take seconds.
void add_part(Symmetric& to, double amount, const CompactMatrix& part, const std::vector<int>&) {
  const auto dof = [&](Index i) { return part.dofs()[static_cast<std::size_t>(i)]; };
  for (int c = 0; c < part.block().outerSize(); ++c)
    for (Symmetric::InnerIterator e(part.block(), c); e; ++e) to.coeffRef(dof(e.row()), dof(e.col())) += amount * e.value();
}

VectorXd unit_force(const ReducedPlace& place, Index d, const std::vector<int>& columns) {
  return place.directions.part(d, columns);
}
VectorXd unit_force(const Place& place, Index d, const std::vector<int>&) { return VectorXd(place.directions.col(d)); }

/// Stiffness and mass, dense in the reduced basis or sparse in full coordinates.
template <typename Matrix, typename OnePlace>
struct Assembly {
  Matrix stiffness, mass;
  const std::map<std::string, std::vector<OnePlace>>& sets;
  const VectorXd& theta;                                              ///< values of the parameters
  const std::vector<int> columns;                                     ///< of the reduced basis that are used
  std::map<std::pair<const OnePlace*, bool>, double> own_error = {};  ///< of a location's mass (true) or stiffness

  /// The location of a candidate, in the set of its hypothesis or else in any set, because a support and its foundation have
  /// one name.
  [[nodiscard]] const OnePlace* find(const Candidate& candidate, std::size_t which) const {
    const std::string& id = candidate.places[which]->id;
    const OnePlace* found = nullptr;
    for (const auto& [set, list] : sets)
      for (const OnePlace& place : list)
        if (place.id == id && (found == nullptr || set == candidate.hypothesis->set)) found = &place;
    return found;
  }
  [[nodiscard]] VectorXd direction(const OnePlace& place, Index d) const {
    VectorXd b = VectorXd::Zero(stiffness.rows());
    const VectorXd force = unit_force(place, d, columns);
    b.head(force.size()) = force;
    return b;
  }
  template <typename Part>
  void add(Matrix& to, double amount, const Part& what) {
    if (what.size() != 0 && amount != 0.0) add_part(to, amount, what, columns);
  }
  /// Calls with a location's matrix, including the factors of the parameters.
  template <typename Part>
  void add(Matrix& to, double amount, const Part& whole, const ParameterLaw<Part>& law) {
    law.each(whole, theta, [&](double times, const Part& part) { add(to, amount * times, part); });
  }
  void scatter(const FeatureMap& map, const VectorXd& x) {
    for (std::size_t j = 0; j < map.nuisances().size(); ++j) {
      const Nuisance& v = map.nuisances()[j];
      if (v.kind != Nuisance::Kind::place) continue;
      const double amount = v.deviation * x[static_cast<Index>(j)];
      const OnePlace& place = sets.at(v.set)[static_cast<std::size_t>(v.index)];
      add(v.of_mass ? mass : stiffness, amount, v.of_mass ? place.mass : place.stiffness);
      own_error[{&place, v.of_mass}] = amount;
    }
  }
  [[nodiscard]] double own_error_of(const OnePlace& place, bool of_mass) const {
    const auto own = own_error.find({&place, of_mass});
    return own == own_error.end() ? 0.0 : own->second;
  }
  void apply(const Cause& cause) {
    const Candidate& candidate = *cause.candidate;
    if (candidate.places.empty()) return;
    const OnePlace* place = find(candidate, 0);
    for (const ActionSpec& action : candidate.hypothesis->actions) {
      if (!changes_structure(action.primitive)) continue;
      TWINDECK_ASSERT(place != nullptr);
      const auto value = [&](const char* name) { return candidate.value(action.number.at(name), cause.a); };
      if (action.primitive == Primitive::scale_stiffness) {
        add(stiffness, value("factor") - 1.0, place->stiffness, place->stiffness_law);
        add(stiffness, (value("factor") - 1.0) * own_error_of(*place, false), place->stiffness);
      }
      if (action.primitive == Primitive::scale_mass) {
        add(mass, value("factor") - 1.0, place->mass, place->mass_law);
        add(mass, (value("factor") - 1.0) * own_error_of(*place, true), place->mass);
      }
      if (action.primitive == Primitive::mass_add)
        for (Index d = 0; d < place->directions.cols(); ++d)
          add_outer(mass, value("mass"), direction(*place, d), direction(*place, d));
      if (action.primitive == Primitive::support_move) move(*place, value("position"));
      if (action.primitive == Primitive::element_spring && candidate.places.size() == 2)
        tie(*place, *find(candidate, 1), value("stiffness"));
      else if (action.primitive == Primitive::element_spring)
        prop(*place, action, value("stiffness"));
      if (has_own_motion(action.primitive)) swing(*place, action, value("mass"), 2.0 * std::numbers::pi * value("frequency"));
    }
  }
  /// Takes the support away and puts its springs up again between the nodes where it stands.
  void move(const OnePlace& place, double position) {
    add(stiffness, -1.0, place.stiffness, place.stiffness_law);
    if (const auto supports = sets.find("supports"); supports != sets.end())
      for (const OnePlace& own : supports->second)
        if (own.id == place.id) add(stiffness, -own_error_of(own, false), own.stiffness);
    const double ratio = place.stiffness_law.ratio.value(theta);
    const auto [station, part] = on_line(place.attributes, position);
    const Index springs = place.directions.cols() / static_cast<Index>(place.attributes.at("stations"));
    for (Index d = 0; d < springs; ++d) {
      const VectorXd b =
          (1.0 - part) * direction(place, station * springs + d) + part * direction(place, (station + 1) * springs + d);
      add_outer(stiffness, ratio * place.attributes.at("k_" + std::to_string(d)), b, b);
    }
  }
  /// First direction of an action: the last one, vertical, if the action says so and the location can move vertically;
  /// otherwise 0, and the action uses all directions.
  [[nodiscard]] Index first_direction(const OnePlace& place, const ActionSpec& action) const {
    const auto named = action.text.find("direction");
    const bool vertical = named != action.text.end() && named->second == "vertical" && place.directions.cols() == 3 &&
                          direction(place, 2).squaredNorm() > 0.0;
    return vertical ? 2 : 0;
  }
  void prop(const OnePlace& place, const ActionSpec& action, double k) {
    for (Index d = first_direction(place, action); d < place.directions.cols(); ++d)
      add_outer(stiffness, k, direction(place, d), direction(place, d));
  }
  void tie(const OnePlace& place, const OnePlace& other, double k) {
    const Index shared = std::min(place.directions.cols(), other.directions.cols());
    const Eigen::Vector3d along = other.x_m - place.x_m;
    VectorXd pull = VectorXd::Zero(stiffness.rows());
    const bool line = along.allFinite() && along.norm() > 0.0 && shared == 3;
    for (Index d = 0; d < shared; ++d) {
      const VectorXd b = direction(place, d) - direction(other, d);
      if (line)
        pull += along.normalized()[d] * b;
      else
        add_outer(stiffness, k, b, b);
    }
    if (line) add_outer(stiffness, k, pull, pull);
  }
  void swing(const OnePlace& place, const ActionSpec& action, double m, double omega) {
    const bool string = action.primitive == Primitive::element_string;
    for (Index d = first_direction(place, action); d < place.directions.cols(); ++d) {
      grow(stiffness);
      grow(mass);
      const Index k = stiffness.rows() - 1;
      const VectorXd b = direction(place, d), own = VectorXd::Unit(k + 1, k);
      if (string) {
        add_outer(mass, m / 3.0, b, b);
        add_outer(mass, 0.5 * m, own, own);
        add_outer(mass, m / std::numbers::pi, b, own);
        add_outer(mass, m / std::numbers::pi, own, b);
        add_outer(stiffness, 0.5 * m * omega * omega, own, own);
      } else {
        add_outer(mass, m, own, own);
        add_outer(stiffness, m * omega * omega, own - b, own - b);
      }
    }
  }
};

/// omega² of a small system, ascending. Responses to loads have hardly any mass, so that M is singular to rounding. If K is not
/// singular, the problem is solved for 1/omega².
VectorXd lowest_squares(const MatrixXd& k, const MatrixXd& m) {
  if (Eigen::LLT<MatrixXd>(k).info() == Eigen::Success) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> inverse(m, k, Eigen::EigenvaluesOnly);
    constexpr double kMassless = 1e-300;  // far above every frequency, to avoid a division by zero
    return inverse.eigenvalues().reverse().cwiseMax(kMassless).cwiseInverse();
  }
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(k, m, Eigen::EigenvaluesOnly).eigenvalues();
}

/// [%] Error of a frequency by the basis that is always allowed, equal to the least error of identification
/// (scatter.frequency_floor).
constexpr double kBasisErrorPct = 0.1;
/// [-] Part of the model's form error that is also allowed: a tenth adds half a per cent to it, in squares.
constexpr double kPartOfForm = 0.1;

/// Positions in the model of the modes that the measured ones of a state are paired with, ascending.
std::vector<int> paired_positions(const FeatureMap& map, const Fit& fit, const std::string& state) {
  std::set<int> out;
  const auto& modes = map.measured_modes();
  for (std::size_t m = 0; m < std::min(modes.size(), fit.all.paired.size()); ++m) {
    const auto& condition = map.features().condition_of(modes[m]);
    if (condition.state == state && fit.all.paired[m] >= 0) out.insert(fit.all.paired[m]);
  }
  return {out.begin(), out.end()};
}

FullCheck of_modes(const FullCheck& all, std::vector<int> positions) {
  std::erase_if(positions, [&](int p) { return p >= all.full_Hz.size(); });
  FullCheck out{all.reduced_Hz(positions), all.full_Hz(positions), 0.0, all.message};
  for (Eigen::Index i = 0; i < out.full_Hz.size(); ++i)
    if (out.full_Hz[i] > 0.0)
      out.largest_pct = std::max(out.largest_pct, 100.0 * std::abs(out.reduced_Hz[i] / out.full_Hz[i] - 1.0));
  return out;
}

}  // namespace

FullCheck check_against_full(const Structure& structure, const Places& places, const FeatureMap& map, const Fit& fit,
                             int modes) {
  const fe::ParametricSystem& system = *structure.system;
  Assembly<Symmetric, Place> full{Symmetric(system.stiffness(fit.base.theta).selfadjointView<Eigen::Lower>()),
                                  Symmetric(system.mass(fit.base.theta).selfadjointView<Eigen::Lower>()),
                                  places.sets,
                                  fit.base.theta,
                                  {}};
  full.scatter(map, fit.base.x);
  std::vector<int> columns(static_cast<std::size_t>(map.model().common));
  std::iota(columns.begin(), columns.end(), 0);
  for (const Cause& cause : fit.causes)
    for (const ReducedPlace* place : cause.candidate->places)
      for (const int k : place->columns)
        if (!contains(columns, k)) columns.push_back(k);
  // The matrices of the map include parameters and element scatter.
  const auto [stiffness, mass] = map.matrices(fit.base, columns);
  Assembly<MatrixXd, ReducedPlace> reduced{stiffness, mass, map.model().sets, fit.base.theta, columns};
  for (const Cause& cause : fit.causes) {
    full.apply(cause);
    reduced.apply(cause);
  }
  const MatrixXd &k = reduced.stiffness, &m = reduced.mass;
  const VectorXd small = lowest_squares(k, m);
  const int count = std::min(modes, static_cast<int>(k.rows()));
  linalg::Cholesky factor;
  const linalg::SparseMatrix lower_k = full.stiffness.triangularView<Eigen::Lower>();
  const linalg::SparseMatrix lower_m = full.mass.triangularView<Eigen::Lower>();
  const linalg::EigenPairs pairs = linalg::lowest_eigenpairs(lower_k, lower_m, count, 0.0, factor);
  FullCheck check;
  if (!pairs.status.converged) {
    check.message = pairs.status.message;
    return check;
  }
  const auto hertz = [](const VectorXd& values) {
    return VectorXd(values.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi));
  };
  check.full_Hz = hertz(pairs.values.head(count));
  check.reduced_Hz = hertz(small.head(count));
  for (int i = 0; i < count; ++i)
    if (check.full_Hz[i] > 0.0)
      check.largest_pct = std::max(check.largest_pct, 100.0 * std::abs(check.reduced_Hz[i] / check.full_Hz[i] - 1.0));
  return check;
}

double allowed_basis_error_pct(const Diagnosis& result) {
  return std::max(kBasisErrorPct, result.form ? 100.0 * kPartOfForm * result.form->frequency.level : 0.0);
}

FullCheck check_paired_modes(const Structure& structure, const Places& places, const FeatureMap& map, const Diagnosis& result,
                             const std::string& state) {
  Fit fit = result.after;
  std::erase_if(fit.causes, [&](const Cause& cause) { return !cause.candidate->acts_in_state(state); });
  std::vector<int> positions = paired_positions(map, result.after, state);
  if (positions.empty()) positions = {0};
  const FullCheck all = check_against_full(structure, places, map, fit, positions.back() + 1);
  return all.message.empty() ? of_modes(all, positions) : all;
}

}  // namespace twindeck::diagnosis
