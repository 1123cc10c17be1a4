#pragma once

#include <array>

#include "fe/model.hpp"
#include "model_io/profiles.hpp"

/// What a beam has to be called in an .inp file so that CalculiX's solid in its place has the beam's stiffness.
///
/// CalculiX makes a solid of 20 nodes with reduced integration (C3D20R) out of every B32R, and where members meet it lets the
/// end sections move and turn as rigid plates. Cantilevers with a member across every joint show what comes out of that:
///
/// - E A as given; but E I times 1.15 with Poisson's ratio 0.3 and times 1.6 with 0.46, for the plates do not let the section
///   narrow on one side and widen on the other. With Poisson's ratio 0 it is E I to four digits, however long the element.
/// - Torsion of plane sections, G12 Iy + G13 Iz, or 4 G12 Iy G13 Iz/(G12 Iy + G13 Iz) where the section may warp; never
///   Saint-Venant's. Both are 2 G12 Iy where G12 Iy = G13 Iz.
/// - Shear over the whole area, G12 A along y and G13 A along z.
///
/// Hence an orthotropic material without Poisson's ratio, whose two shear moduli are chosen for torsion, or for shear where
/// torsion would leave too little of it (open sections).
namespace twindeck::model_io {

struct ExpandedBeam {
  Profile profile;  ///< "PIPE" where the section is one, else "RECT" with the section's radii of gyration
  bool scaled;      ///< the rectangle has another area than the section: the moduli and the density make up for it
  double youngs_modulus_Pa, shear_modulus_y_Pa, shear_modulus_z_Pa, density_kg_m3;
  std::array<double, 2> torsion;  ///< torsional stiffness over the section's own: free to warp, held plane
  std::array<double, 2> shear;  ///< shear stiffness over the section's own, along y and z (over G A where it has no shear area)
};

/// @param section  of a beam: A, Iy, Iz, J above 0; its product of inertia does not enter
[[nodiscard]] ExpandedBeam expanded_beam(const fe::Section& section, const fe::Material& material);

/// The way back: what CalculiX makes of a profile in a material with two shear moduli, as the section of a beam in a material
/// of modulus `shear_modulus_y_Pa`.
[[nodiscard]] fe::Section contracted_beam(const fe::Section& profile, double shear_modulus_y_Pa, double shear_modulus_z_Pa);

}  // namespace twindeck::model_io
