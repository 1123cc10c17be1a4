#include "fe/assembly_drilling.hpp"

#include <Eigen/Geometry>

namespace twindeck::fe {

Matrix24 drilling_spread(const ShellGeometry& geometry, const ShellProperties& properties, double factor) {
  const auto& x = geometry.node_m;
  const Eigen::Vector3d n = (x[2] - x[0]).cross(x[3] - x[1]).normalized();  // of the mean plane
  const double k =
      (factor > 0.0 ? factor : 0.03) * properties.youngs_modulus_Pa * properties.thickness_m * shell_area(geometry);
  Matrix24 spread = Matrix24::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) spread.block<3, 3>(6 * i + 3, 6 * j + 3) = -k / 3.0 * n * n.transpose();
  return spread;
}

}  // namespace twindeck::fe
