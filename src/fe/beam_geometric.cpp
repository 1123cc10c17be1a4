#include "fe/beam_geometric.hpp"

#include "fe/beam_frame.hpp"
#include "fe/element_products.hpp"

namespace twindeck::fe {

/// K_G = N ∫ (dw/dx)ᵀ (dw/dx) dx with Hermite cubics. The twist term N (Iy+Iz)/A (Wagner) is left out: it matters for open
/// thin-walled sections alone. Released rotations follow as those of a slender beam, for which the shapes do not depend on EI.
Matrix12 beam_geometric_stiffness(const BeamGeometry& geometry, double axial_force_N) {
  const double length = beam_length(geometry);
  Matrix12 local = Matrix12::Zero();
  for (const beam::GaussPoint& point : beam::gauss_points()) {
    const beam::Shape shape = beam::shape_at(point.xi, length, Eigen::Matrix2d::Zero());
    local += quadratic_form(axial_force_N * length * point.weight, shape.deflection_slope);
  }
  Matrix12 t = beam::end_displacements(geometry);
  if (geometry.releases != 0) {
    const BeamStiffnessProperties slender{1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0};
    t = (beam::release_transformation(beam::local_stiffness(slender, length), geometry.releases) * t).eval();
  }
  return congruence(t, local);
}

}  // namespace twindeck::fe
