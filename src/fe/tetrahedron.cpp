#include "fe/tetrahedron.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"
#include "fe/solid_strain.hpp"

namespace twindeck::fe {
namespace {

/// Rows are the edges from node 1.
Eigen::Matrix3d edges_of(const TetrahedronGeometry& geometry) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i)
    edges.row(i) = (geometry.node_m[static_cast<std::size_t>(i) + 1] - geometry.node_m[0]).transpose();
  return edges;
}

using Matrix3x4 = Eigen::Matrix<double, 3, 4>;

/// Of L_1 to L_4, one column each [1/m].
Matrix3x4 gradients_of(const TetrahedronGeometry& geometry) {
  Matrix3x4 gradient;
  gradient.rightCols<3>() = edges_of(geometry).inverse();
  gradient.col(0) = -gradient.rightCols<3>().rowwise().sum();
  return gradient;
}

Eigen::Matrix<double, 6, 12> strain_of(const Matrix3x4& gradient) {
  Eigen::Matrix<double, 6, 12> b;
  for (int i = 0; i < 4; ++i) set_strain(gradient.col(i), i, b);
  return b;
}

double sound_volume(const TetrahedronGeometry& geometry) {
  const double volume = tetrahedron_volume(geometry);
  if (volume > 0.0) return volume;
  const Eigen::Vector3d& x = geometry.node_m[0];
  throw InputError(
      {},
      fmt::format("tetrahedron with first corner ({:.6g}, {:.6g}, {:.6g}) m has volume {:.3g} m3, expected a positive one",
                  x.x(), x.y(), x.z(), volume),
      "give three corners round one face, anticlockwise as seen from the fourth");
}

}  // namespace

double tetrahedron_volume(const TetrahedronGeometry& geometry) {
  constexpr double rounding = 1e-12;  ///< [-] of the cube of the longest edge
  const Eigen::Matrix3d edges = edges_of(geometry);
  const double volume = edges.determinant() / 6.0, longest = edges.rowwise().norm().maxCoeff();
  return std::abs(volume) < rounding * longest * longest * longest ? 0.0 : volume;
}

MatrixTetrahedron tetrahedron_stiffness(const TetrahedronGeometry& geometry, const SolidProperties& properties) {
  const double volume = sound_volume(geometry);
  const Eigen::Matrix<double, 6, 12> b = strain_of(gradients_of(geometry));
  const MatrixTetrahedron k = volume * properties.youngs_modulus_Pa * b.transpose() * elasticity(properties.poisson_ratio) * b;
  return 0.5 * (k + k.transpose());
}

MatrixTetrahedron tetrahedron_geometric_stiffness(const TetrahedronGeometry& geometry, const SolidProperties& properties,
                                                  const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  const double volume = sound_volume(geometry);
  const Matrix3x4 gradient = gradients_of(geometry);
  const Eigen::Matrix<double, 6, 1> stress =
      properties.youngs_modulus_Pa * elasticity(properties.poisson_ratio) * (strain_of(gradient) * displacement);
  const Eigen::Matrix4d slope = volume * gradient.transpose() * stress_tensor(stress) * gradient;
  return for_three(slope);
}

MatrixTetrahedron tetrahedron_mass(const TetrahedronGeometry& geometry, double density_kg_m3) {
  const double each = density_kg_m3 * sound_volume(geometry) / 20.0;
  return for_three(Eigen::Matrix4d(each * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity())));
}

MatrixTetrahedron tetrahedron_mass_lumped(const TetrahedronGeometry& geometry, double density_kg_m3) {
  return MatrixTetrahedron::Identity() * (density_kg_m3 * sound_volume(geometry) / 4.0);
}

}  // namespace twindeck::fe
