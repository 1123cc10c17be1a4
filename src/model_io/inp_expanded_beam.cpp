#include "model_io/inp_expanded_beam.hpp"

#include <cmath>

namespace twindeck::model_io {
namespace {

/// Least share of the section's shear stiffness with which its torsion is kept. Shear is some per cent of a member's
/// flexibility, so that half or double of it is the smaller error; an open section would be left with a hundredth.
constexpr double kLeastShear = 0.5;

/// Torsional stiffness of a section that may warp, from its shares G12 Iy and G13 Iz.
double free_torsion(double share_y, double share_z) { return 4.0 * share_y * share_z / (share_y + share_z); }

}  // namespace

ExpandedBeam expanded_beam(const fe::Section& s, const fe::Material& m) {
  ExpandedBeam beam{};
  double factor = 1.0;
  if (const auto pipe = recognise_pipe(s)) {
    beam.profile = *pipe;
  } else {
    const double a = std::sqrt(12.0 * s.inertia_z_m4 / s.area_m2), b = std::sqrt(12.0 * s.inertia_y_m4 / s.area_m2);
    beam.profile = {"RECT", {a, b}};
    factor = s.area_m2 / (a * b);
  }
  beam.scaled = std::abs(factor - 1.0) > 1e-6;

  const double wished_y = s.shear_area_y_m2 > 0.0 ? s.shear_area_y_m2 : s.area_m2,
               wished_z = s.shear_area_z_m2 > 0.0 ? s.shear_area_z_m2 : s.area_m2;
  // Shear moduli over G: equal shares of the torsion, or what makes the shear stiffness.
  double over_y = s.torsion_m4 / (2.0 * s.inertia_y_m4), over_z = s.torsion_m4 / (2.0 * s.inertia_z_m4);
  if (over_y * s.area_m2 < kLeastShear * wished_y || over_z * s.area_m2 < kLeastShear * wished_z) {
    over_y = wished_y / s.area_m2;
    over_z = wished_z / s.area_m2;
  }
  const double share_y = over_y * s.inertia_y_m4, share_z = over_z * s.inertia_z_m4;
  beam.torsion = {free_torsion(share_y, share_z) / s.torsion_m4, (share_y + share_z) / s.torsion_m4};
  beam.shear = {over_y * s.area_m2 / wished_y, over_z * s.area_m2 / wished_z};
  beam.youngs_modulus_Pa = factor * m.youngs_modulus_Pa;
  beam.shear_modulus_y_Pa = factor * over_y * m.shear_modulus_Pa;
  beam.shear_modulus_z_Pa = factor * over_z * m.shear_modulus_Pa;
  beam.density_kg_m3 = factor * m.density_kg_m3;
  return beam;
}

fe::Section contracted_beam(const fe::Section& profile, double shear_modulus_y_Pa, double shear_modulus_z_Pa) {
  fe::Section s = profile;
  const double ratio = shear_modulus_z_Pa / shear_modulus_y_Pa;
  s.torsion_m4 = free_torsion(s.inertia_y_m4, ratio * s.inertia_z_m4);
  s.shear_area_y_m2 = s.area_m2;
  s.shear_area_z_m2 = ratio * s.area_m2;
  return s;
}

}  // namespace twindeck::model_io
