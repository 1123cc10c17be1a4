#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe/model.hpp"

/// Models after years in service and with faults.
namespace twindeck::reliability {

/// Atmospheric corrosion of a steel surface: loss D(t) = r t^b up to 20 years. After that the loss grows linearly with the
/// slope at 20 years, r b 20^(b-1). While a coating lasts, there is no loss. Reference: ISO 9224:2012, 6 (b of carbon steel
/// 0.523, upper bound 0.575); first years' rates r by category: ISO 9223:2012, table 2.
struct Corrosion {
  double first_year_m = 0.0;  ///< r: loss of thickness of the first year
  double exponent = 0.523;    ///< b [-]
  double coating_life_years = 0.0;
  /// Loss of one surface after so many years in service [m].
  [[nodiscard]] double loss_m(double years) const;
  /// Years in service after which one surface has lost so much. @pre first_year_m > 0
  [[nodiscard]] double years_until(double loss_m) const;
};

/// Sections whose steel corrodes alike.
struct Wall {
  std::vector<std::string> sections;  ///< names in sections.csv
  double thickness_m = 0.0;           ///< of the wall; 0: round ropes or rods, diameters from the areas of the sections
  int sides = 1;                      ///< 1 or 2 surfaces of the wall that corrode
  Corrosion corrosion;
  /// Remaining share of a section's area after some years in service [-]. @throws InputError  if nothing is left
  [[nodiscard]] double remaining(const fe::Section& section, double years) const;
};

/// The model after so many years: areas, shear areas, inertias and torsion constants of thin walls go with the thickness, those
/// of ropes and rods with their diameter; the thickness of shells is reduced. Mass goes with the area.
/// @throws InputError  for a section that the model does not have, and as `Wall::remaining`
[[nodiscard]] fe::Model worn_model(fe::Model model, const std::vector<Wall>& walls, double years);

/// Fault of a damper: it is taken out, or static friction holds it, so that only the spring in series with it deforms.
enum class DamperFault { lost, held };
/// @param held_stiffness_N_m  of the mounts of a held damper that has no spring in series
/// @throws InputError  for a damper that the model does not have
[[nodiscard]] fe::Model with_damper_fault(fe::Model model, const std::string& damper, DamperFault fault,
                                          double held_stiffness_N_m);

/// First year's loss of carbon steel in a category of atmosphere, C1 … C5 and CX: the middle of its range.
/// Reference: ISO 9223:2012, table 2.  @return nothing for an unknown name
[[nodiscard]] std::optional<double> first_year_loss_m(const std::string& category);

/// What is left of a thin-walled section whose walls lose thickness: area, bending inertia and torsion constant go with the
/// thickness.
/// @param exposed_sides  1 or 2 surfaces that corrode
/// @throws InputError  if the loss eats the wall through
[[nodiscard]] double remaining_share(double thickness_m, double loss_m, int exposed_sides);

/// What is left of a round wire rope or rod [-]: of its area, ((d - 2 D)/d)².
/// @throws InputError  if the loss eats it through
[[nodiscard]] double remaining_round_share(double diameter_m, double loss_m);

}  // namespace twindeck::reliability
