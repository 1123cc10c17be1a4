#include "fe/solid_quadratic.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "fe/element_products.hpp"
#include "fe/solid_strain.hpp"

namespace twindeck::fe {

namespace {

using Index = Eigen::Index;
using Matrix3xN = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Natural coordinates of the nodes of a hexahedron: -1, 0 or 1 each.
constexpr std::array<std::array<double, 3>, 20> hexahedron_nodes = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
     {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
     {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}}};

/// Corners at the ends of the edges that have a node.
constexpr std::array<std::array<Index, 2>, 6> tetrahedron_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The functions of the nodes at a point, and their derivatives by the natural coordinates.
struct ShapeFunctions {
  Eigen::VectorXd value;  ///< (n)
  Matrix3xN natural;      ///< (3 × n)
};

/// Serendipity functions. Corner: (1 + ξξ_i)(1 + ηη_i)(1 + ζζ_i)(ξξ_i + ηη_i + ζζ_i - 2)/8; middle of an edge along ξ:
/// (1 - ξ²)(1 + ηη_i)(1 + ζζ_i)/4, and so on.
ShapeFunctions of_hexahedron(const Eigen::Vector3d& xi) {
  ShapeFunctions f{Eigen::VectorXd(20), Matrix3xN(3, 20)};
  for (Index i = 0; i < 20; ++i) {
    const auto& c = hexahedron_nodes[static_cast<std::size_t>(i)];
    Eigen::Vector3d factor, slope;
    for (Index d = 0; d < 3; ++d) {
      const double at = c[static_cast<std::size_t>(d)];
      factor[d] = at == 0.0 ? 1.0 - xi[d] * xi[d] : 1.0 + at * xi[d];
      slope[d] = at == 0.0 ? -2.0 * xi[d] : at;
    }
    const bool corner = i < 8;
    const double along = corner ? c[0] * xi[0] + c[1] * xi[1] + c[2] * xi[2] - 2.0 : 2.0;
    f.value[i] = 0.125 * factor.prod() * along;
    for (Index d = 0; d < 3; ++d) {
      const double others = factor[(d + 1) % 3] * factor[(d + 2) % 3];
      f.natural(d, i) = 0.125 * others * (slope[d] * along + (corner ? factor[d] * c[static_cast<std::size_t>(d)] : 0.0));
    }
  }
  return f;
}

/// In volume coordinates, of which L_2, L_3, L_4 are ξ, η, ζ: L_i (2 L_i - 1) at corners, 4 L_i L_j on edges.
ShapeFunctions of_tetrahedron(const Eigen::Vector3d& xi) {
  const Eigen::Vector4d l(1.0 - xi.sum(), xi[0], xi[1], xi[2]);
  Eigen::Matrix<double, 3, 4> slope;
  slope << Eigen::Vector3d::Constant(-1.0), Eigen::Matrix3d::Identity();
  ShapeFunctions f{Eigen::VectorXd(10), Matrix3xN(3, 10)};
  for (Index i = 0; i < 4; ++i) {
    f.value[i] = l[i] * (2.0 * l[i] - 1.0);
    f.natural.col(i) = (4.0 * l[i] - 1.0) * slope.col(i);
  }
  for (Index e = 0; e < 6; ++e) {
    const auto [a, b] = tetrahedron_edges[static_cast<std::size_t>(e)];
    f.value[4 + e] = 4.0 * l[a] * l[b];
    f.natural.col(4 + e) = 4.0 * (l[a] * slope.col(b) + l[b] * slope.col(a));
  }
  return f;
}

/// A point of an integration rule with the functions there.
struct RulePoint {
  Eigen::Vector3d xi;
  double weight;
  ShapeFunctions at;
};
using Rule = std::vector<RulePoint>;

void add_point(Rule& rule, bool hexahedron, const Eigen::Vector3d& xi, double weight) {
  rule.push_back({xi, weight, hexahedron ? of_hexahedron(xi) : of_tetrahedron(xi)});
}

/// Irons' 14 points on the cube.
Rule rule_of_irons() {
  Rule rule;
  const double face = std::sqrt(19.0 / 30.0), corner = std::sqrt(19.0 / 33.0);
  for (Index d = 0; d < 3; ++d)
    for (const double side : {-1.0, 1.0}) add_point(rule, true, side * face * Eigen::Vector3d::Unit(d), 320.0 / 361.0);
  for (std::size_t i = 0; i < 8; ++i)
    add_point(rule, true, corner * Eigen::Vector3d(hexahedron_nodes[i].data()), 121.0 / 361.0);
  return rule;
}

Rule four_points_of_tetrahedron() {
  Rule rule;
  const double a = (5.0 - std::sqrt(5.0)) / 20.0, b = 1.0 - 3.0 * a;
  add_point(rule, false, Eigen::Vector3d::Constant(a), 1.0 / 24.0);
  for (Index d = 0; d < 3; ++d)
    add_point(rule, false, Eigen::Vector3d::Constant(a) + (b - a) * Eigen::Vector3d::Unit(d), 1.0 / 24.0);
  return rule;
}

/// Four Gauss points a direction on the cube; on the tetrahedron those of a cube that is drawn together into a corner.
Rule rule_of_mass(bool hexahedron) {
  Rule rule;
  const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2)),
               inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2));
  const double of_inner = (18.0 + std::sqrt(30.0)) / 36.0, of_outer = (18.0 - std::sqrt(30.0)) / 36.0;
  const std::array<double, 4> x = {-outer, -inner, inner, outer}, w = {of_outer, of_inner, of_inner, of_outer};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = w[i] * w[j] * w[k];
        if (hexahedron) {
          add_point(rule, true, {x[i], x[j], x[k]}, weight);
          continue;
        }
        const double r = 0.5 * (1.0 + x[i]), s = 0.5 * (1.0 + x[j]) * (1.0 - r), t = 0.5 * (1.0 + x[k]) * (1.0 - r - s);
        add_point(rule, false, {r, s, t}, 0.125 * weight * (1.0 - r) * (1.0 - r - s));
      }
  return rule;
}

const Rule& stiffness_rule(const QuadraticSolid& solid) {
  static const Rule hexahedron = rule_of_irons(), tetrahedron = four_points_of_tetrahedron();
  return solid.node_m.size() == 20 ? hexahedron : tetrahedron;
}

const Rule& mass_rule(const QuadraticSolid& solid) {
  static const Rule hexahedron = rule_of_mass(true), tetrahedron = rule_of_mass(false);
  return solid.node_m.size() == 20 ? hexahedron : tetrahedron;
}

/// Rows are d(x, y, z)/dξ, /dη, /dζ.
Eigen::Matrix3d jacobian_at(const QuadraticSolid& solid, const RulePoint& point) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < solid.node_m.size(); ++i)
    jacobian += point.at.natural.col(static_cast<Index>(i)) * solid.node_m[i].transpose();
  return jacobian;
}

void require_sound_quadratic(const QuadraticSolid& solid) {
  const SolidShape shape = quadratic_solid_shape(solid);
  if (is_sound(shape)) return;
  const Eigen::Vector3d& x = solid.node_m[0];
  throw InputError({},
                   fmt::format("solid of {} nodes with first corner ({:.6g}, {:.6g}, {:.6g}) m has volume {:.3g} m3 and a "
                               "point with {:.3g} of the mean Jacobian, expected both positive",
                               solid.node_m.size(), x.x(), x.y(), x.z(), shape.volume_m3, shape.least_ratio),
                   "give the corners first, then the nodes in the middles of their edges");
}

/// Calls use(weight · det J, gradient (3 × n)) at the points of the stiffness.
template <typename Use>
void at_points(const QuadraticSolid& solid, Use use) {
  require_sound_quadratic(solid);
  for (const RulePoint& point : stiffness_rule(solid)) {
    const Eigen::Matrix3d jacobian = jacobian_at(solid, point);
    const Matrix3xN gradient = jacobian.inverse() * point.at.natural;
    use(point.weight * jacobian.determinant(), gradient);
  }
}

Eigen::MatrixXd quadratic_strain(const Matrix3xN& gradient) {
  Eigen::MatrixXd b(6, 3 * gradient.cols());
  for (Index i = 0; i < gradient.cols(); ++i) set_strain(gradient.col(i), static_cast<int>(i), b);
  return b;
}

}  // namespace

SolidShape quadratic_solid_shape(const QuadraticSolid& solid) {
  TWINDECK_ASSERT(solid.node_m.size() == 10 || solid.node_m.size() == 20);
  SolidShape shape{0.0, 0.0, 0};
  double measure = 0.0, least = std::numeric_limits<double>::infinity(), size = 0.0;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
  for (const Rule* rule : {&stiffness_rule(solid), &mass_rule(solid)})
    for (const RulePoint& point : *rule) {
      const double determinant = jacobian_at(solid, point).determinant();
      if (rule == &mass_rule(solid)) shape.volume_m3 += point.weight * determinant, measure += point.weight;
      if (determinant >= least) continue;
      least = determinant, where.setZero();
      for (std::size_t i = 0; i < solid.node_m.size(); ++i) where += point.at.value[static_cast<Index>(i)] * solid.node_m[i];
    }
  for (const Eigen::Vector3d& x : solid.node_m) size = std::max(size, (x - solid.node_m[0]).norm());
  if (std::abs(shape.volume_m3) < 1e-12 * size * size * size) return {0.0, 0.0, 0};  // rounding of the coordinates
  shape.least_ratio = least * measure / std::abs(shape.volume_m3);
  const auto nearer = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - where).squaredNorm() < (b - where).squaredNorm();
  };
  const auto nearest = std::min_element(solid.node_m.begin(), solid.node_m.end(), nearer);
  shape.least_corner = static_cast<int>(nearest - solid.node_m.begin());
  return shape;
}

Eigen::MatrixXd quadratic_solid_stiffness(const QuadraticSolid& solid, const SolidProperties& properties) {
  const Eigen::Matrix<double, 6, 6> d = properties.youngs_modulus_Pa * elasticity(properties.poisson_ratio);
  const auto n = 3 * static_cast<Index>(solid.node_m.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  at_points(solid, [&](double weight, const Matrix3xN& gradient) {
    const Eigen::MatrixXd b = quadratic_strain(gradient);
    k += transposed_product(b, transposed_product(weight * d, b));  // D is symmetric
  });
  return 0.5 * (k + k.transpose());
}

Eigen::MatrixXd quadratic_solid_geometric_stiffness(const QuadraticSolid& solid, const SolidProperties& properties,
                                                    const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  const Eigen::Matrix<double, 6, 6> d = properties.youngs_modulus_Pa * elasticity(properties.poisson_ratio);
  const auto n = static_cast<Index>(solid.node_m.size());
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, n);
  at_points(solid, [&](double weight, const Matrix3xN& gradient) {
    const Eigen::Matrix<double, 6, 1> stress = d * (quadratic_strain(gradient) * displacement);
    slope += weight * transposed_product(gradient, stress_tensor(stress) * gradient);
  });
  return for_three(slope);
}

Eigen::MatrixXd quadratic_solid_mass(const QuadraticSolid& solid, double density_kg_m3) {
  require_sound_quadratic(solid);
  const auto n = static_cast<Index>(solid.node_m.size());
  Eigen::MatrixXd scalar = Eigen::MatrixXd::Zero(n, n);
  for (const RulePoint& point : mass_rule(solid)) {
    const Eigen::VectorXd& value = point.at.value;
    scalar += density_kg_m3 * point.weight * jacobian_at(solid, point).determinant() * value * value.transpose();
  }
  return for_three(scalar);
}

Eigen::MatrixXd quadratic_solid_mass_lumped(const QuadraticSolid& solid, double density_kg_m3) {
  const Eigen::MatrixXd consistent = quadratic_solid_mass(solid, density_kg_m3);
  const double scale = consistent.sum() / consistent.trace();  // both three times: of all, and of the diagonal
  return (scale * consistent.diagonal()).asDiagonal();
}

}  // namespace twindeck::fe
