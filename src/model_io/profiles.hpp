#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fe/model.hpp"

/// Cross-sections of every dialect by their drawings: a shape is a list of rectangles, a convex polygon or a hollow circle,
/// from which area, second moments, torsion constant and shear areas follow. A dialect names its shapes and the order of their
/// dimensions; nothing here knows of it.
///
/// Axes of a drawing: h to the right, v up, which are our local y and z. Area and second moments are exact. Torsion: closed
/// form for circles, Roark's series for one rectangle and Trefftz' method for a polygon (both within 1e-4 to 1e-3 of
/// Saint-Venant's), Bredt for cells, sum b t³/3 for open walls. Shear areas: Cowper (1966), J. Appl. Mech. 33, 335-340, for
/// circles, rectangles and thin tubes; walls by their direction, five sixths of those that end free.
namespace twindeck::model_io {

struct Shape {
  /// A rectangle about its middle line.
  struct Wall {
    Eigen::Vector2d from, to;
    double thickness = 0.0;
  };
  std::vector<Wall> walls = {};               ///< do not overlap
  std::vector<Eigen::Vector2d> outline = {};  ///< corners of a convex polygon in order
  double radius = 0.0, inner = 0.0;           ///< of a circle and its hole
  double closed_torsion = 0.0;                ///< of the cells that the walls enclose; 0: the section is open
  bool fits = true;                           ///< no dimension is negative, no wall lies inside out
};

/// Rectangles by their left, lower, right and upper sides. One without width or height is left out.
[[nodiscard]] Shape rectangles(const std::vector<std::array<double, 4>>& sides);
[[nodiscard]] Shape circle(double radius, double inner = 0.0);
/// Width along h, height along v, walls at the right, top, left, bottom.
[[nodiscard]] Shape box(double width, double height, const std::array<double, 4>& walls);
/// An I, or with one flange a T; its lower side is v = 0.
/// @param b, t  widths and thicknesses of the lower and the upper flange
[[nodiscard]] Shape i_shape(double height, const std::array<double, 2>& b, const std::array<double, 2>& t, double web);
/// A channel open to the right, or a Z whose lower flange points right; the web's lower left corner is the origin.
[[nodiscard]] Shape channel(double height, const std::array<double, 2>& b, const std::array<double, 2>& t, double web,
                            bool as_z = false);
/// Legs along h and v from the outer corner at the origin, with the thickness of each.
[[nodiscard]] Shape angle(double width, double height, double t_h, double t_v);
/// A hat of two brims (each with the thickness of its web), a top and two webs of their own thicknesses.
[[nodiscard]] Shape hat(double height, double top, const std::array<double, 2>& brims, const std::array<double, 5>& t);
/// Torsion constant of one or two cells: enclosed areas, sums of length over thickness around each, and of the wall between.
[[nodiscard]] double bredt(double area, double around, double area2 = 0.0, double around2 = 1.0, double common = 0.0);
/// The shape turned by a right angle to the left.
[[nodiscard]] Shape turned(Shape shape);

struct ProfileSection {
  fe::Section section;                                 ///< about the centroid; without a name
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< in the drawing
  bool beside = false;                                 ///< its shear centre lies beside its centroid
  bool possible = false;                               ///< the dimensions fit together
};
[[nodiscard]] ProfileSection profile_section(const Shape& shape, double poisson_ratio);
/// The section with v along local y and h against local z, as Nastran and SAP2000 draw.
[[nodiscard]] fe::Section upright(const ProfileSection& profile);

/// What a dialect says of a section whose shear centre lies beside its centroid.
[[nodiscard]] std::string note_beside(const std::string& section);

/// Position of the section of this name and these numbers. A section of other numbers under a name that is taken is added under
/// the name and a count, "deck_2".
[[nodiscard]] int find_or_add_section(std::vector<fe::Section>& sections, fe::Section section);

/// Saint-Venant torsion constant of a rectangle [m4].
[[nodiscard]] double rectangle_torsion(double a, double b);

struct Profile {
  std::string name;            ///< "PIPE", "RECT" of *BEAM SECTION
  std::vector<double> values;  ///< its dimensions [m]
};
/// The pipe that has the section's area, second moments and torsion constant to `tolerance`, if there is one; none for a full
/// circle.
[[nodiscard]] std::optional<Profile> recognise_pipe(const fe::Section& section, double tolerance = 2e-3);

}  // namespace twindeck::model_io
