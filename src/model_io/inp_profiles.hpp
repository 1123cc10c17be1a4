#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe/model.hpp"

/// Cross-sections of *BEAM SECTION as area, second moments, torsion constant and shear areas, and the way back.
///
/// Axes: n1 is our local y, n2 our local z, so that I11 = ∫ x2² dA is inertia_y and I22 = ∫ x1² dA is inertia_z. Torsion:
/// closed form for circles, Roark's series for the rectangle (relative error under 1e-4 against Saint-Venant's), Bredt for the
/// box, sum b t³/3 for the I. Shear areas: Cowper (1966), J. Appl. Mech. 33, 335-340, for circles, rectangles and thin tubes;
/// webs for box and I.
namespace twindeck::model_io {

/// Number of dimensions of "RECT", "CIRC", "PIPE", "BOX", "I"; 0 for a profile that is not supported.
[[nodiscard]] std::size_t profile_size(const std::string& profile);
[[nodiscard]] const std::vector<std::string>& profile_names();

/// RECT: a (along n1), b (along n2). CIRC: radius. PIPE: outer radius, wall. BOX: a, b and four walls (opposite ones equal). I:
/// l, h, b1, b2, t1, t2, t3 (Abaqus; doubly symmetric with l = h/2).
/// @param values   (profile_size) [m]
/// @param problem  set to what is wrong with the dimensions, else left empty
[[nodiscard]] fe::Section profile_section(const std::string& profile, const std::vector<double>& values, double poisson_ratio,
                                          std::string& problem);

/// Position of the section of this name and these numbers. A section of other numbers under a name that is taken is added under
/// the name and a count, "deck_2".
[[nodiscard]] int find_or_add_section(std::vector<fe::Section>& sections, fe::Section section);

/// Saint-Venant torsion constant of a rectangle [m4].
[[nodiscard]] double rectangle_torsion(double a, double b);

struct Profile {
  std::string name;            ///< "PIPE", "RECT"
  std::vector<double> values;  ///< its dimensions [m]
};
/// The pipe that has the section's area, second moments and torsion constant to `tolerance`, if there is one; none for a full
/// circle.
[[nodiscard]] std::optional<Profile> recognise_pipe(const fe::Section& section, double tolerance = 2e-3);

}  // namespace twindeck::model_io
