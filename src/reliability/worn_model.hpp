#pragma once

#include <string>
#include <vector>

#include "fe/model.hpp"
#include "reliability/corrosion.hpp"

/// What years and faults make of a model.
namespace twindeck::reliability {

/// Sections whose steel corrodes alike.
struct Wall {
  std::vector<std::string> sections;  ///< names in sections.csv
  double thickness_m = 0.0;           ///< of the wall; 0: round ropes or rods of the sections' own areas
  int sides = 1;                      ///< 1 or 2 surfaces of the wall that corrode
  Corrosion corrosion;
  /// What is left of a section's area after so many years [-]. @throws InputError  if nothing is left
  [[nodiscard]] double remaining(const fe::Section& section, double years) const;
};

/// The model after so many years: areas, shear areas, inertias and torsion constants of thin walls go with the thickness, those
/// of ropes and rods with their diameter; the thickness of shells is reduced. Mass goes with the area.
/// @throws InputError  for a section that the model does not have, and as `Wall::remaining`
[[nodiscard]] fe::Model worn_model(fe::Model model, const std::vector<Wall>& walls, double years);

/// What can become of a damper: it is taken out, or static friction holds it, so that only the spring in series with it yields.
enum class DamperFault { lost, held };
/// @param held_stiffness_N_m  of a held damper that has no spring in series: of its mounts
/// @throws InputError  for a damper that the model does not have
[[nodiscard]] fe::Model with_damper_fault(fe::Model model, const std::string& damper, DamperFault fault,
                                          double held_stiffness_N_m);

}  // namespace twindeck::reliability
