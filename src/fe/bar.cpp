#include "fe/bar.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::fe {

namespace {

using Nodes = std::array<Eigen::Vector3d, 2>;

double length_of(const Nodes& x) {
  const double length = (x[1] - x[0]).norm();
  if (!(length > 1e-12 * (x[0].norm() + x[1].norm())) || !std::isfinite(length))
    throw InputError({},
                     fmt::format("bar at ({:.6g}, {:.6g}, {:.6g}) m has length {:.3g} m, expected two distinct ends", x[0].x(),
                                 x[0].y(), x[0].z(), length),
                     "give the bar two nodes at different places");
  return length;
}

/// [[a, -a], [-a, a]]: a spring matrix between two nodes.
Matrix6 between(const Eigen::Matrix3d& a) {
  Matrix6 k;
  k << a, -a, -a, a;
  return k;
}

}  // namespace

Matrix6 bar_stiffness(const Nodes& node_m, double youngs_modulus_Pa, double area_m2) {
  const double length = length_of(node_m);
  const Eigen::Vector3d n = (node_m[1] - node_m[0]) / length;
  return between(youngs_modulus_Pa * area_m2 / length * n * n.transpose());
}

Matrix6 string_stiffness(const Nodes& node_m, double pull_N) {
  const double length = length_of(node_m);
  const Eigen::Vector3d n = (node_m[1] - node_m[0]) / length;
  return between(pull_N / length * (Eigen::Matrix3d::Identity() - n * n.transpose()));
}

Matrix6 bar_mass_consistent(const Nodes& node_m, double mass_per_length_kg_m) {
  const double sixth = mass_per_length_kg_m * length_of(node_m) / 6.0;
  Matrix6 m = 2.0 * sixth * Matrix6::Identity();
  m.topRightCorner<3, 3>() = sixth * Eigen::Matrix3d::Identity();
  m.bottomLeftCorner<3, 3>() = sixth * Eigen::Matrix3d::Identity();
  return m;
}

Matrix6 bar_mass_lumped(const Nodes& node_m, double mass_per_length_kg_m) {
  return 0.5 * mass_per_length_kg_m * length_of(node_m) * Matrix6::Identity();
}

}  // namespace twindeck::fe
