#include "fe/large_displacement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fe/assembly_elements.hpp"
#include "fe/assembly_pattern.hpp"
#include "fe/beam_frame.hpp"
#include "fe/corotational.hpp"
#include "fe/matrix_element.hpp"
#include "fe/shell_quad.hpp"
#include "fe/static_stage.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::fe {

namespace {

using corotational::Motion;
constexpr double kTolerance = 1e-8, kRounding = 1e-5, kNoMove = 1e-11;
constexpr int kMaxIterations = 30, kMaxHalvings = 6;

/// A point that rides on a node (the end of its chain of links) at the end of a rigid arm.
struct RidingPoint {
  int root;
  Eigen::Vector3d arm_m;  ///< from the root, before any rotation
};

/// What stays the same through all iterations.
struct Part {
  int element;
  std::vector<RidingPoint> points;
  corotational::Element linear;  ///< beams, shells, solids
  double axial_EA_N = 0.0, initial_tension_N = 0.0;
};

bool is_string(ElementType type) { return type == ElementType::bar || type == ElementType::stay; }

Eigen::MatrixXd solid_stiffness_six(const Model& model, const Element& e) {
  const Eigen::MatrixXd k = solid_stiffness_of(model, e);
  const auto nodes = static_cast<Eigen::Index>(e.nodes.size());
  Eigen::MatrixXd six = Eigen::MatrixXd::Zero(6 * nodes, 6 * nodes);
  for (Eigen::Index a = 0; a < nodes; ++a)
    for (Eigen::Index b = 0; b < nodes; ++b) six.block<3, 3>(6 * a, 6 * b) = k.block<3, 3>(3 * a, 3 * b);
  return six;
}

class MovingStructure {
 public:
  MovingStructure(const Model& model, const Eigen::VectorXd& load, const Eigen::VectorXd& stay_pull_N)
      : model_(model),
        straight_sides_(sides_beside_four_nodes(model)),
        map_(make_dof_map(model)),
        pattern_(make_pattern(model, map_)),
        scatter_(pattern_, map_),
        load_(load) {
    for (int i = 0; i < std::ssize(model.elements); ++i) add_part(i, stay_pull_N);
  }

  [[nodiscard]] Eigen::Index size() const { return std::ssize(map_.dofs); }
  [[nodiscard]] const DofLabel& label(Eigen::Index i) const { return map_.dofs[static_cast<std::size_t>(i)]; }

  /// Unbalanced forces f_int - λ f_ext over the free degrees of freedom; with `tangent` also K into it.
  Eigen::VectorXd residual(const Configuration& c, double lambda, linalg::SparseMatrix* tangent);

  /// Norm of the loads at full size: what unbalanced forces are measured against.
  [[nodiscard]] double load_norm() const { return load_norm_; }

  /// The configuration turned and moved by a correction of the free degrees of freedom.
  [[nodiscard]] Configuration moved(const Configuration& c, const Eigen::VectorXd& correction) const;

  [[nodiscard]] Configuration undeformed() const {
    Configuration c;
    c.displacement = Eigen::VectorXd::Zero(6 * std::ssize(model_.nodes));
    c.rotation.assign(model_.nodes.size(), Eigen::Matrix3d::Identity());
    return c;
  }

  /// Axial forces of beams and bars in a converged configuration.
  [[nodiscard]] Eigen::VectorXd axial_forces(const Configuration& c) const;
  /// Displacements that strain each shell and solid, turned with its frame.
  [[nodiscard]] std::vector<Eigen::VectorXd> strained(const Configuration& c) const;

 private:
  void add_part(int i, const Eigen::VectorXd& stay_pull_N);
  [[nodiscard]] RidingPoint point_on(int node, const Eigen::Vector3d& offset) const {
    const int root = map_.root[slot(node)];
    return {root, model_.nodes[slot(node)].x_m + offset - model_.nodes[slot(root)].x_m};
  }
  [[nodiscard]] Motion motion_of(const Part& part, const Configuration& c) const;
  /// Adds forces (and the tangent) of points, carried to their roots over the arms as they now lie.
  void add(const std::vector<RidingPoint>& points, const Configuration& c, const Eigen::VectorXd& force,
           const Eigen::MatrixXd& k, Eigen::VectorXd& sum, bool with_tangent);
  void add_springs(const Configuration& c, Eigen::VectorXd& sum, bool with_tangent);
  void add_matrix_elements(const Configuration& c, Eigen::VectorXd& sum, bool with_tangent);

  const Model& model_;
  std::vector<std::uint8_t> straight_sides_;  ///< by element
  DofMap map_;
  linalg::SparseMatrix pattern_;
  Scatter scatter_;
  Eigen::VectorXd load_;
  std::vector<Part> parts_;
  double load_norm_ = 0.0;
};

void MovingStructure::add_part(int i, const Eigen::VectorXd& stay_pull_N) {
  const Element& e = model_.elements[slot(i)];
  Part part;
  part.element = i;
  for (std::size_t a = 0; a < e.nodes.size(); ++a) {
    const Eigen::Vector3d offset = e.type == ElementType::beam ? e.offset_m[a] : Eigen::Vector3d(Eigen::Vector3d::Zero());
    part.points.push_back(point_on(e.nodes[a], offset));
    part.linear.start_m.push_back(model_.nodes[slot(e.nodes[a])].x_m + offset);
  }
  if (e.type == ElementType::beam) {
    BeamGeometry g = beam_geometry(model_, e);
    part.linear.across = beam_axes(g).row(1).transpose();
    g.orientation = beam_axes(g).row(2).transpose();
    for (std::size_t a = 0; a < 2; ++a) g.node_m[a] += g.offset_m[a];
    g.offset_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    const TaperedProperties ends = beam_end_properties(model_, e);
    part.linear.stiffness =
        e.section2 >= 0 ? Eigen::MatrixXd(tapered_beam_stiffness(g, ends)) : Eigen::MatrixXd(beam_stiffness(g, ends.end1));
  } else if (e.type == ElementType::shell) {
    part.linear.frame = is_triangle(e) ? corotational::Frame::triangle : corotational::Frame::quad;
    part.linear.stiffness = shell_bending_of(model_, e) + shell_membrane_of(model_, e, straight_sides_[slot(i)]);
  } else if (e.type == ElementType::solid) {
    const bool hexahedron = e.nodes.size() == 8 || e.nodes.size() == 20;
    part.linear.frame = hexahedron ? corotational::Frame::box : corotational::Frame::corner;
    part.linear.stiffness = solid_stiffness_six(model_, e);
  } else if (e.type == ElementType::bar) {
    part.axial_EA_N = material_of(model_, e).youngs_modulus_Pa * section_of(model_, e).area_m2;
    part.initial_tension_N = initial_tension(model_, e);
  } else {
    part.initial_tension_N = stay_pull_N.size() > 0 ? stay_pull_N[i] : 0.0;
    if (part.initial_tension_N == 0.0) return;
  }
  parts_.push_back(std::move(part));
}

Motion MovingStructure::motion_of(const Part& part, const Configuration& c) const {
  Motion motion;
  for (const RidingPoint& p : part.points) {
    const Eigen::Matrix3d& t = c.rotation[slot(p.root)];
    motion.displacement_m.emplace_back(c.displacement.segment<3>(6 * p.root) + (t * p.arm_m - p.arm_m));
    motion.rotation.push_back(t);
  }
  return motion;
}

void MovingStructure::add(const std::vector<RidingPoint>& points, const Configuration& c, const Eigen::VectorXd& force,
                          const Eigen::MatrixXd& k, Eigen::VectorXd& sum, bool with_tangent) {
  const auto n = static_cast<Eigen::Index>(6 * points.size());
  Eigen::VectorXd f = force;
  Eigen::MatrixXd tangent = k;
  for (std::size_t a = 0; a < points.size(); ++a) {
    if (points[a].arm_m.isZero(0.0)) continue;
    // δu = δu_root + δω × arm:  f_root = f, m_root = m + arm × f; the arm itself turns: δ(arm × f) = f × (arm × δω).
    const auto i = static_cast<Eigen::Index>(6 * a);
    const Eigen::Matrix3d s = beam::cross_matrix(c.rotation[slot(points[a].root)] * points[a].arm_m);
    const Eigen::Vector3d n_a = f.segment<3>(i);
    f.segment<3>(i + 3) += s * n_a;
    if (!with_tangent) continue;
    tangent.middleCols<3>(i + 3) -= (tangent.middleCols<3>(i) * s).eval();
    tangent.middleRows<3>(i + 3) += (s * tangent.middleRows<3>(i)).eval();
    const Eigen::Matrix3d turn = beam::cross_matrix(n_a) * s;
    tangent.block<3, 3>(i + 3, i + 3) += 0.5 * (turn + turn.transpose());
  }
  ElementMatrix matrix;
  for (std::size_t a = 0; a < points.size(); ++a) {
    sum.segment<6>(6 * points[a].root) += f.segment<6>(static_cast<Eigen::Index>(6 * a));
    for (int d = 0; d < 6; ++d) matrix.dofs.push_back(6 * points[a].root + d);
  }
  if (!with_tangent) return;
  TWINDECK_ASSERT(tangent.rows() == n);
  matrix.matrix = std::move(tangent);
  scatter_.add(matrix);
}

void MovingStructure::add_springs(const Configuration& c, Eigen::VectorXd& sum, bool with_tangent) {
  for (const Spring& s : model_.springs) {
    if (!carries_stiffness(s)) continue;
    std::vector<RidingPoint> points = {point_on(s.node, Eigen::Vector3d::Zero())};
    if (s.node2 >= 0) points.push_back(point_on(s.node2, Eigen::Vector3d::Zero()));
    const auto n = static_cast<Eigen::Index>(6 * points.size());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n), u(n);
    for (std::size_t a = 0; a < points.size(); ++a) {
      const auto i = static_cast<Eigen::Index>(6 * a);
      b.segment<3>(i + (s.rotation ? 3 : 0)) = (a == 0 ? 1.0 : -1.0) * s.direction.normalized();
      const Eigen::Matrix3d& t = c.rotation[slot(points[a].root)];
      u.segment<3>(i) = c.displacement.segment<3>(6 * points[a].root) + (t * points[a].arm_m - points[a].arm_m);
      u.segment<3>(i + 3) = corotational::rotation_vector(t);
    }
    add(points, c, s.stiffness * b.dot(u) * b, s.stiffness * b * b.transpose(), sum, with_tangent);
  }
}

void MovingStructure::add_matrix_elements(const Configuration& c, Eigen::VectorXd& sum, bool with_tangent) {
  for (const MatrixElement& element : model_.matrix_elements) {
    const ElementMatrix small = conservative_part(element).stiffness;
    std::vector<RidingPoint> points;
    for (const int dof : small.dofs) points.push_back(point_on(dof / 6, Eigen::Vector3d::Zero()));
    const auto n = std::ssize(small.dofs);
    Eigen::VectorXd u(n), force = Eigen::VectorXd::Zero(6 * n);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const RidingPoint& p = points[static_cast<std::size_t>(i)];
      const int direction = small.dofs[static_cast<std::size_t>(i)] % 6;
      const Eigen::Matrix3d& t = c.rotation[slot(p.root)];
      u[i] = direction < 3 ? (c.displacement.segment<3>(6 * p.root) + (t * p.arm_m - p.arm_m))[direction]
                           : corotational::rotation_vector(t)[direction - 3];
    }
    const Eigen::VectorXd f = small.matrix * u;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index row = 6 * i + small.dofs[static_cast<std::size_t>(i)] % 6;
      force[row] = f[i];
      for (Eigen::Index j = 0; j < n; ++j) k(row, 6 * j + small.dofs[static_cast<std::size_t>(j)] % 6) = small.matrix(i, j);
    }
    add(points, c, force, k, sum, with_tangent);
  }
}

Eigen::VectorXd MovingStructure::residual(const Configuration& c, double lambda, linalg::SparseMatrix* tangent) {
  const bool with_tangent = tangent != nullptr;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(6 * std::ssize(model_.nodes)), outside = sum;
  for (const Part& part : parts_) {
    const Motion motion = motion_of(part, c);
    const ElementType type = model_.elements[slot(part.element)].type;
    if (!is_string(type)) {
      const corotational::Response response = corotational::respond(part.linear, motion, with_tangent);
      add(part.points, c, response.force, response.tangent, sum, with_tangent);
      continue;
    }
    const corotational::BarResponse bar = corotational::respond_bar({part.linear.start_m[0], part.linear.start_m[1]}, motion,
                                                                    part.axial_EA_N, lambda * part.initial_tension_N);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(12);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(12, 12);
    for (int a = 0; a < 2; ++a) {
      force.segment<3>(6 * a) = bar.force.segment<3>(3 * a);
      for (int b = 0; b < 2; ++b) k.block<3, 3>(6 * a, 6 * b) = bar.tangent.block<3, 3>(3 * a, 3 * b);
    }
    add(part.points, c, force, k, sum, with_tangent);
    if (type == ElementType::stay)
      for (int a = 0; a < 2; ++a) outside.segment<3>(6 * part.points[slot(a)].root) -= force.segment<3>(6 * a);
  }
  add_springs(c, sum, with_tangent);
  add_matrix_elements(c, sum, with_tangent);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(6, 6);
  for (int node = 0; node < std::ssize(model_.nodes); ++node) {
    const Eigen::VectorXd f = -lambda * load_.segment<6>(6 * node);
    if (f.isZero(0.0)) continue;
    add({point_on(node, Eigen::Vector3d::Zero())}, c, f, none, sum, with_tangent);
    outside.segment<6>(6 * map_.root[slot(node)]) -= f;
  }
  if (with_tangent) {
    Term term;
    scatter_.take(term);
    *tangent = pattern_;
    for (std::size_t i = 0; i < term.position.size(); ++i) tangent->valuePtr()[term.position[i]] = term.value[i];
  }
  // Roots carry everything by now, and of them only the free directions count.
  Eigen::VectorXd free(size());
  double norm2 = 0.0;
  for (int node = 0; node < std::ssize(model_.nodes); ++node) {
    if (map_.root[slot(node)] != node) continue;
    for (int d = 0; d < 6; ++d)
      for (const DofMap::Entry& entry : map_.rows[slot(6 * node + d)]) {
        free[entry.dof] = sum[6 * node + d];
        norm2 += outside[6 * node + d] * outside[6 * node + d];
      }
  }
  load_norm_ = std::max(load_norm_, std::sqrt(norm2));
  return free;
}

Configuration MovingStructure::moved(const Configuration& c, const Eigen::VectorXd& correction) const {
  Configuration next = c;
  for (int node = 0; node < std::ssize(model_.nodes); ++node) {
    if (map_.root[slot(node)] != node) continue;
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    for (int d = 0; d < 6; ++d)
      for (const DofMap::Entry& entry : map_.rows[slot(6 * node + d)]) step[d] = correction[entry.dof];
    next.displacement.segment<3>(6 * node) += step.head<3>();
    next.rotation[slot(node)] = corotational::rotation_of(step.tail<3>()) * c.rotation[slot(node)];
    next.displacement.segment<3>(6 * node + 3) = corotational::rotation_vector(next.rotation[slot(node)]);
  }
  for (int node = 0; node < std::ssize(model_.nodes); ++node) {  // slaves follow
    const int root = map_.root[slot(node)];
    if (root == node) continue;
    const Eigen::Vector3d arm = model_.nodes[slot(node)].x_m - model_.nodes[slot(root)].x_m;
    next.rotation[slot(node)] = next.rotation[slot(root)];
    next.displacement.segment<3>(6 * node) = next.displacement.segment<3>(6 * root) + (next.rotation[slot(root)] * arm - arm);
    next.displacement.segment<3>(6 * node + 3) = next.displacement.segment<3>(6 * root + 3);
  }
  return next;
}

Eigen::VectorXd MovingStructure::axial_forces(const Configuration& c) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(std::ssize(model_.elements));
  for (const Part& part : parts_) {
    const Element& e = model_.elements[slot(part.element)];
    const Motion motion = motion_of(part, c);
    if (e.type == ElementType::bar) {
      force[part.element] = corotational::respond_bar({part.linear.start_m[0], part.linear.start_m[1]}, motion, part.axial_EA_N,
                                                      part.initial_tension_N)
                                .tension_N;
    } else if (e.type == ElementType::beam) {
      const corotational::Response response = corotational::respond(part.linear, motion, false);
      const Eigen::VectorXd f = part.linear.stiffness * response.deformation;
      const Eigen::Vector3d axis = (part.linear.start_m[1] - part.linear.start_m[0]).normalized();
      force[part.element] = 0.5 * axis.dot(f.segment<3>(6) - f.segment<3>(0));
    }
  }
  return force;
}

std::vector<Eigen::VectorXd> MovingStructure::strained(const Configuration& c) const {
  std::vector<Eigen::VectorXd> all(model_.elements.size());
  for (const Part& part : parts_) {
    const ElementType type = model_.elements[slot(part.element)].type;
    if (type != ElementType::shell && type != ElementType::solid) continue;
    const corotational::Response response = corotational::respond(part.linear, motion_of(part, c), false);
    const Eigen::Index points = std::ssize(part.points), kept = type == ElementType::solid ? 1 : 2;
    Eigen::VectorXd& u = all[slot(part.element)];
    u.resize(3 * kept * points);
    for (Eigen::Index a = 0; a < points; ++a)
      for (Eigen::Index half = 0; half < kept; ++half)
        u.segment<3>(3 * (kept * a + half)) = response.rotation * response.deformation.segment<3>(6 * a + 3 * half);
  }
  return all;
}

/// Newton's method at one load factor.
struct NewtonResult {
  Configuration configuration;
  bool converged = false;
  std::string why;
};

NewtonResult newton(MovingStructure& structure, Configuration c, double lambda, linalg::Cholesky& factor) {
  linalg::SparseMatrix k;
  Eigen::VectorXd r = structure.residual(c, lambda, &k);
  bool still = false;  // the last correction moved nothing: what is unbalanced is rounding of stiff members
  for (int iteration = 0;; ++iteration) {
    const double limit = kTolerance * std::max(structure.load_norm(), 1e-30);
    Eigen::Index worst = 0;
    r.cwiseAbs().maxCoeff(&worst);
    const std::string where = fmt::format("unbalanced forces are {:.2g} of the loads, most at node {}",
                                          r.norm() / std::max(structure.load_norm(), 1e-30), structure.label(worst).node);
    if (r.norm() <= limit ||
        (still && r.norm() <= kRounding * structure.load_norm())) {  // balanced; a column that stands on its tip is that too
      ++c.iterations;
      if (factor.factorize(k).converged) return {std::move(c), true, ""};
      return {std::move(c), false,
              fmt::format("the equilibrium there is unstable, its stiffness not positive definite at node {}: the structure "
                          "buckles or is loose",
                          structure.label(factor.failed_column()).node)};
    }
    if (!std::isfinite(r.norm())) return {std::move(c), false, "displacements grow beyond all bounds"};
    if (iteration == kMaxIterations) return {std::move(c), false, fmt::format("after {} iterations the {}", iteration, where)};
    if (!factor.factorize(k).converged) {
      const DofLabel& weak = structure.label(factor.failed_column());
      return {std::move(c), false,
              fmt::format("the tangent stiffness is not positive definite at node {}: the structure buckles there or is loose "
                          "({})",
                          weak.node, where)};
    }
    ++c.iterations;
    const Eigen::VectorXd step = -factor.solve(r);
    // Line search: the work of the unbalanced forces along the step, negative at its start, should have fallen to 0.8 at its
    // end.
    const double before = step.dot(r);
    double s = 1.0, best_s = 1.0, best = std::numeric_limits<double>::infinity();
    double low = 0.0, low_work = before;
    for (int trial = 0; trial < 6; ++trial) {
      const double work = step.dot(structure.residual(structure.moved(c, s * step), lambda, nullptr));
      if (std::isfinite(work) && std::abs(work) < best) best = std::abs(work), best_s = s;
      if (best <= 0.8 * std::abs(before)) break;
      if (std::isfinite(work) && work < 0.0) {
        low = s, low_work = work;
        s *= 2.0;
      } else {
        const double guess = std::isfinite(work) ? low + (s - low) * low_work / (low_work - work) : 0.0;
        s = std::clamp(guess, low + 0.1 * (s - low), low + 0.5 * (s - low));
      }
    }
    c = structure.moved(c, best_s * step);
    still = best_s * step.norm() <= kNoMove * c.displacement.norm();
    r = structure.residual(c, lambda, &k);
  }
}

}  // namespace

Configuration find_equilibrium(const Model& model, const Eigen::VectorXd& load, const Eigen::VectorXd& stay_pull_N,
                               int load_steps, const Configuration* start) {
  MovingStructure structure(model, load, stay_pull_N);
  Configuration c = start != nullptr ? *start : structure.undeformed();
  static_cast<void>(structure.residual(structure.undeformed(), 1.0, nullptr));  // measures the loads
  linalg::Cholesky factor;
  double lambda = start != nullptr ? 1.0 : 0.0;
  double step = start != nullptr ? 0.0 : 1.0 / std::max(load_steps, 1);
  int halvings = 0;
  const double shortest = step / 64.0;
  while (true) {
    const double next = std::min(1.0, lambda + step);
    NewtonResult result = newton(structure, c, next, factor);
    if (result.converged) {
      c = std::move(result.configuration);
      lambda = next;
      if (lambda >= 1.0 - 1e-12) break;
      continue;
    }
    c.iterations = result.configuration.iterations;
    if (step > shortest && ++halvings <= kMaxHalvings && start == nullptr) {
      step *= 0.5;
      continue;
    }
    c.status = {false, fmt::format("large displacements: no equilibrium at {:.3g} % of dead load and pulls: {}", 100.0 * next,
                                   result.why)};
    break;
  }
  c.axial_force_N = structure.axial_forces(c);
  if (model.prestress.shells_and_solids) c.strained = structure.strained(c);
  return c;
}

Model deformed_model(const Model& model, const PrestressState& state) {
  Model moved = model;
  if (state.rotation.empty()) return moved;
  const auto n = static_cast<std::size_t>(std::ssize(model.nodes));
  TWINDECK_ASSERT(state.rotation.size() == n && state.displacement.size() == std::ssize(model.nodes) * 6);
  for (std::size_t i = 0; i < n; ++i) moved.nodes[i].x_m += state.displacement.segment<3>(6 * static_cast<Eigen::Index>(i));
  for (Element& e : moved.elements) {
    if (e.type != ElementType::beam) continue;
    const Eigen::Vector3d z = beam_axes(beam_geometry(model, e)).row(2).transpose();
    e.orientation = 0.5 * (state.rotation[slot(e.nodes[0])] * z + state.rotation[slot(e.nodes[1])] * z);
    for (std::size_t a = 0; a < 2; ++a) e.offset_m[a] = (state.rotation[slot(e.nodes[a])] * e.offset_m[a]).eval();
  }
  return moved;
}

}  // namespace twindeck::fe
