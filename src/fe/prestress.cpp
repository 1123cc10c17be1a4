#include "fe/prestress.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "fe/assembly_pattern.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/large_displacement.hpp"
#include "fe/mechanism.hpp"
#include "fe/static_stage.hpp"
#include "fe/structure_parts.hpp"

namespace twindeck::fe {
namespace {

/// Relative change of the cable forces below which shape finding under large displacements has settled: a hundredth of what
/// they can be measured to.
constexpr double settled_pulls = 1e-4;
/// Enough where each leaves less than a fifth of the change of the one before.
constexpr int shape_finding_rounds = 6;

std::vector<int> find_stays(const Model& model) {
  std::vector<int> stays;
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    if (model.elements[i].type == ElementType::stay) stays.push_back(static_cast<int>(i));
  return stays;
}

/// Bars that are under force in the geometry of nodes.csv: what draws their ends together. Under tension it also holds a chain
/// of them in shape.
double tension_of_bar(const Model& model, const Element& e) {
  return e.type == ElementType::bar ? initial_tension(model, e) : 0.0;
}

Eigen::VectorXd initial_tension_load(const Model& model) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()));
  for (const Element& e : model.elements) {
    const double tension = tension_of_bar(model, e);
    if (tension == 0.0) continue;
    const auto ends = end_nodes(model, e);
    const Eigen::Vector3d pull = tension * (ends[1] - ends[0]).normalized();
    load.segment<3>(6 * e.nodes[0]) += pull;
    load.segment<3>(6 * e.nodes[1]) -= pull;
  }
  return load;
}

/// Loads of one newton of pull in each stay: its ends are drawn together. (6 n_nodes × n_stays)
Eigen::MatrixXd unit_pull_loads(const Model& model, const std::vector<int>& stays) {
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()), std::ssize(stays));
  for (std::size_t s = 0; s < stays.size(); ++s) {
    const Element& stay = element_at(model, stays[s]);
    const auto ends = end_nodes(model, stay);
    const Eigen::Vector3d direction = (ends[1] - ends[0]).normalized();
    loads.col(static_cast<Eigen::Index>(s)).segment<3>(6 * stay.nodes[0]) += direction;
    loads.col(static_cast<Eigen::Index>(s)).segment<3>(6 * stay.nodes[1]) -= direction;
  }
  return loads;
}

/// Least pulls for zero displacement at the conditions, blended with site pulls: minimises over T >= T_min
///   |w_0 + W T|² / |w_0|² + ridge |T|² / (n T_ref²) + site_weight |T - T_site|² / (n_site T_ref²),
/// T_ref = weight / n, n the number of stays; stays without a site pull are left out of the last sum.
/// @param w         (n_conditions × n_stays) displacement of one newton of pull [m/N]
/// @param w_dead_m  (n_conditions) displacement of the dead load
BoundedLeastSquares find_shape(const Model& model, const std::vector<int>& stays, const Eigen::MatrixXd& w,
                               const Eigen::VectorXd& w_dead_m, double weight_N) {
  const Prestress& rule = model.prestress;
  const Eigen::Index n = w.cols(), m = w.rows();
  const double T_ref = weight_N / static_cast<double>(n);
  const double displacement = w_dead_m.norm();
  if (!(displacement > 0.0) || !(weight_N > 0.0))
    return {Eigen::VectorXd::Constant(n, rule.minimum_pull_N),
            {false, "shape finding: the dead load moves none of the conditions, so no pull can be found from them"}};
  Eigen::Index n_site = 0;
  for (const int s : stays) n_site += element_at(model, s).pull_N > 0.0 ? 1 : 0;

  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m + 2 * n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m + 2 * n);
  a.topRows(m) = w / displacement;
  b.head(m) = -w_dead_m / displacement;
  for (Eigen::Index i = 0; i < n; ++i) {
    a(m + i, i) = std::sqrt(rule.ridge / static_cast<double>(n)) / T_ref;
    const double site = element_at(model, stays[static_cast<std::size_t>(i)]).pull_N;
    if (site <= 0.0) continue;
    a(m + n + i, i) = std::sqrt(rule.site_weight / static_cast<double>(n_site)) / T_ref;
    b[m + n + i] = a(m + n + i, i) * site;
  }
  return solve_bounded_least_squares(a, b, rule.minimum_pull_N);
}

/// Axial forces of beams and bars at mid-length.
Eigen::VectorXd axial_forces(const Model& model, const Eigen::VectorXd& u) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.elements.size()));
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& e = model.elements[i];
    if (e.type == ElementType::beam) {
      Vector12 ends;
      ends << u.segment<6>(6 * e.nodes[0]), u.segment<6>(6 * e.nodes[1]);
      if (e.free_strain != 0.0) ends -= free_displacement(model, e);
      force[static_cast<Eigen::Index>(i)] =
          e.section2 >= 0 ? tapered_beam_axial_force(beam_geometry(model, e), beam_end_properties(model, e), ends)
                          : beam_axial_force(beam_geometry(model, e), beam_properties(model, e), ends);
    } else if (e.type == ElementType::bar) {
      const auto x = end_nodes(model, e);
      const Eigen::Vector3d chord = x[1] - x[0];
      const double stretch = chord.normalized().dot(u.segment<3>(6 * e.nodes[1]) - u.segment<3>(6 * e.nodes[0]));
      force[static_cast<Eigen::Index>(i)] = initial_tension(model, e) + material_of(model, e).youngs_modulus_Pa *
                                                                            section_of(model, e).area_m2 * stretch /
                                                                            chord.norm();
    }
  }
  return force;
}

/// Replaces the linear state by equilibrium in the deformed geometry. For shape finding the pulls follow: with the
/// displacements of the true state in place of the linear ones, w(T) ~ w(T_k) + W (T - T_k), until they change by less than
/// `settled_pulls`.
/// @param w  (n_conditions × 1 + n_stays) linear displacements of dead load and of one newton in each stay; empty for given
/// pulls
void deform(const Model& model, const std::vector<int>& stays, const Eigen::MatrixXd& w, double weight_N,
            PrestressState& state) {
  const Eigen::VectorXd load = dead_load(model) + stage_load(model, Eigen::VectorXd::Zero(6 * std::ssize(model.nodes)));
  Configuration c = find_equilibrium(model, load, state.stay_pull_N, model.prestress.load_steps);
  double change = 0.0;  // of the pulls in the last round, relative
  for (int round = 0; w.size() > 0 && c.status.converged && round < shape_finding_rounds; ++round) {
    const Eigen::VectorXd pull = state.stay_pull_N(stays);
    Eigen::VectorXd displacement(w.rows());
    for (Eigen::Index i = 0; i < w.rows(); ++i) {
      const auto& condition = model.prestress.conditions[static_cast<std::size_t>(i)];
      displacement[i] = c.displacement[6 * condition.node + condition.dof];
    }
    const Eigen::MatrixXd influence = w.rightCols(w.cols() - 1);
    const BoundedLeastSquares found = find_shape(model, stays, influence, displacement - influence * pull, weight_N);
    state.stay_pull_N(stays) = found.x;
    state.status = found.status;
    const Configuration last = std::move(c);
    c = find_equilibrium(model, load, state.stay_pull_N, 1, &last);
    change = (found.x - pull).norm() / pull.norm();
    if (!found.status.converged || !(change >= settled_pulls)) break;
  }
  if (!c.status.converged) {  // the linear state stays, with the reason
    state.status = c.status;
    return;
  }
  if (state.status.converged && change >= settled_pulls)
    state.status = {false, fmt::format("the cable forces still change by {:.2g} % after {} rounds of shape finding under large "
                                       "displacements; ask for linear displacements, or give the forces",
                                       100.0 * change, shape_finding_rounds)};
  state.displacement = c.displacement;
  state.rotation = c.rotation;
  state.axial_force_N = c.axial_force_N;
  state.strained = std::move(c.strained);
}

/// Least squares over the free unknowns alone, the others zero.
Eigen::VectorXd solve_free(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const std::vector<bool>& is_free) {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (is_free[i]) columns.push_back(static_cast<Eigen::Index>(i));
  const Eigen::VectorXd z = a(Eigen::indexing::all, columns).colPivHouseholderQr().solve(b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  x(columns) = z;
  return x;
}

}  // namespace

Term initial_tension_stiffness(const Model& model, const linalg::SparseMatrix& pattern, const DofMap& map) {
  Scatter scatter(pattern, map);
  for (const Element& e : model.elements)
    if (const double tension = tension_of_bar(model, e); tension > 0.0)
      scatter.add({three_per_node(e), string_stiffness(end_nodes(model, e), tension)});
  Term term;
  term.label = "initial tension";
  scatter.take(term);
  return term;
}

PrestressState unstressed(const Model& model) {
  PrestressState state;
  state.stay_pull_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.elements.size()));
  state.axial_force_N = state.stay_pull_N;
  state.displacement = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()));
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    state.axial_force_N[static_cast<Eigen::Index>(i)] = tension_of_bar(model, model.elements[i]);
  return state;
}

PrestressState prestress_of(const Model& base, const DofMap& map, const linalg::SparseMatrix& lower,
                            const Eigen::VectorXd& theta) {
  const Model model = with_parameters(base, theta);
  PrestressState state = unstressed(model);

  // 1. One factorisation of the structure without stays, one solution a load: dead load and each stay's pull.
  const std::vector<int> stays = find_stays(model);
  const linalg::Cholesky factor = factorize_or_refuse(lower, map.dofs, model.source, " without its stays");
  const Eigen::VectorXd movement = support_movement(model);
  const Eigen::VectorXd load = dead_load(model) + initial_tension_load(model) + stage_load(model, movement);
  const bool shape_finding = model.prestress.rule == PullRule::shape_finding;
  Eigen::VectorXd pull(std::ssize(stays));
  for (std::size_t s = 0; s < stays.size(); ++s) pull[static_cast<Eigen::Index>(s)] = element_at(model, stays[s]).pull_N;
  const Eigen::MatrixXd unit_loads = unit_pull_loads(model, stays);

  // 2. Pulls.
  Eigen::MatrixXd w;  // displacements of the conditions: dead load, one newton in each stay
  double weight = 0.0;
  Eigen::MatrixXd q;  // columns: dead load, then (for shape finding) one newton in each stay
  if (shape_finding) {
    Eigen::MatrixXd loads(load.size(), 1 + unit_loads.cols());
    loads << load, unit_loads;
    q = factor.solve(map.expansion.transpose() * loads);
    const Eigen::Index m = std::ssize(model.prestress.conditions);
    w.resize(m, q.cols());
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto& condition = model.prestress.conditions[static_cast<std::size_t>(i)];
      w.row(i).setZero();
      for (const DofMap::Entry& entry : map.rows[static_cast<std::size_t>(6 * condition.node + condition.dof)])
        w.row(i) += entry.factor * q.row(entry.dof);
    }
    // tensions of bars are in balance with themselves
    for (Eigen::Index i = 2; i < load.size(); i += 6) weight -= load[i];
    BoundedLeastSquares found = find_shape(model, stays, w.rightCols(w.cols() - 1), w.col(0), weight);
    pull = std::move(found.x);
    state.status = std::move(found.status);
  } else {
    q = factor.solve(map.expansion.transpose() * (load + unit_loads * pull));
  }
  state.stay_pull_N(stays) = pull;

  // 3. The state that they make.
  const Eigen::VectorXd total = shape_finding ? Eigen::VectorXd(q.col(0) + q.rightCols(q.cols() - 1) * pull) : q.col(0);
  state.displacement = map.expansion * total + movement;
  state.axial_force_N = axial_forces(model, state.displacement);
  if (model.prestress.displacements == Displacements::large && state.status.converged) deform(model, stays, w, weight, state);
  return state;
}

BoundedLeastSquares solve_bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double lower) {
  // y = x - lower >= 0 turns the bound into Lawson and Hanson's; columns of unit length make one tolerance serve all.
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd length = a.colwise().norm().transpose();
  const Eigen::MatrixXd scaled = a * length.cwiseInverse().asDiagonal();
  const Eigen::VectorXd rest = b - a * Eigen::VectorXd::Constant(n, lower);
  const double tolerance = 1e-12 * (1.0 + rest.norm());

  std::vector<bool> is_free(static_cast<std::size_t>(n), false);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  const auto finish = [&](Status status) {
    return BoundedLeastSquares{Eigen::VectorXd::Constant(n, lower) + y.cwiseQuotient(length), std::move(status)};
  };
  for (Eigen::Index outer = 0; outer < 10 * n; ++outer) {
    const Eigen::VectorXd descent = scaled.transpose() * (rest - scaled * y);
    Eigen::Index steepest = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!is_free[static_cast<std::size_t>(i)] && descent[i] > tolerance && (steepest < 0 || descent[i] > descent[steepest]))
        steepest = i;
    if (steepest < 0) return finish({});
    is_free[static_cast<std::size_t>(steepest)] = true;

    Eigen::VectorXd z = solve_free(scaled, rest, is_free);
    while (true) {
      double step = 1.0;
      for (Eigen::Index i = 0; i < n; ++i)
        if (is_free[static_cast<std::size_t>(i)] && z[i] <= 0.0) step = std::min(step, y[i] / (y[i] - z[i]));
      if (step >= 1.0) break;
      y += step * (z - y);
      for (Eigen::Index i = 0; i < n; ++i)
        if (is_free[static_cast<std::size_t>(i)] && z[i] <= 0.0 && y[i] <= 1e-14 * (1.0 + y.cwiseAbs().maxCoeff())) {
          y[i] = 0.0;
          is_free[static_cast<std::size_t>(i)] = false;
        }
      z = solve_free(scaled, rest, is_free);
    }
    y = z;
  }
  return finish({false, "the active set of the pulls did not settle"});
}

}  // namespace twindeck::fe
