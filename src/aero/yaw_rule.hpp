#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::aero {

/// Treatment of static coefficients for a wind at yaw theta to the deck's normal.
enum class StaticRule {
  normal,        ///< C(alpha, 0), B, L: as if the wind blew along the normal
  cosine,        ///< C(alpha, 0) cos² theta, B, L: only the normal component acts
  oblique_strip  ///< C(alpha, 0), B' = B/cos theta, L' = L cos theta: the strip that the wind crosses
};

/// "normal", "cosine", "oblique_strip".
[[nodiscard]] std::string name_of(StaticRule rule);

/// Axes of forces and motions.
enum class ForceAxes {
  deck,  ///< y = the deck's horizontal normal, alpha about the deck's axis
  wind   ///< y = the wind's direction, alpha about the horizontal normal to it
};

/// A row of the paper's Table 11 as algebra: with the self-excited block in dimensional form, c = ½ρωB²L H*(K), everything is a
/// reduced velocity to look up, a factor on each entry, and axes. Powers are of cos theta.
struct YawRule {
  std::string name, group, description;  ///< as in Table 12: "A", "Orthogonal wind", ""
  StaticRule statics = StaticRule::normal;
  int lookup_power = 0;  ///< reduced velocity V cosⁿ theta/(f B)
  /// Entry (i, j) of the block is multiplied by 1/cosⁿ theta; rows D, L, M, columns y, z, alpha.
  Eigen::Matrix3i inverse_power = Eigen::Matrix3i::Zero();
  ForceAxes axes = ForceAxes::deck;
};

/// Models A, C, D, G, H, I of Table 11 as printed. H has derivatives H*(alpha, 0, K') with factor 1, B' and L' in its static
/// part alone.
[[nodiscard]] const std::vector<YawRule>& published_yaw_rules();
/// "A", "C", … in that order.
[[nodiscard]] std::vector<std::string> published_yaw_rule_names();
/// Another reading of H, which is not the printed one: its block on the oblique strip as its static part is. B'²L' gives 1/cos
/// for forces due to y and z, 1/cos² across to alpha, 1/cos³ for the moment due to alpha. The printed speeds of C, H and G form
/// a geometric series, as factors 1, 1/cos and 1/cos² give.
[[nodiscard]] YawRule oblique_rule_H();
/// @throws InputError  for an unknown name, naming the known ones
[[nodiscard]] const YawRule& published_yaw_rule(const std::string& name);

/// Rules by location: one everywhere, or (Table 14) another beyond a yaw angle.
struct Deployment {
  struct Zone {
    std::string deck;
    double beyond_rad;  ///< where |theta| is larger
    YawRule rule;
  };
  std::string name;
  YawRule everywhere;
  std::vector<Zone> zones;
  [[nodiscard]] const YawRule& at(const std::string& deck, double yaw_rad) const;
};
[[nodiscard]] Deployment everywhere(const YawRule& rule);

/// Factor of each entry of the block at this yaw. @throws InputError for |yaw| of 90 degrees and beyond
[[nodiscard]] Eigen::Matrix3d block_factor(const YawRule& rule, double yaw_rad);
/// Reduced velocity to look up, over V/(omega B).
[[nodiscard]] double lookup_factor(const YawRule& rule, double yaw_rad);
/// What the static drag and lift (q B L C) and moment (q B² L C) are multiplied with.
struct StaticFactor {
  double force, moment;
};
[[nodiscard]] StaticFactor static_factor(const YawRule& rule, double yaw_rad);
/// Its derivatives by the yaw [1/rad].
[[nodiscard]] StaticFactor static_slope(const YawRule& rule, double yaw_rad);
/// cos theta. @throws InputError where it is not positive
[[nodiscard]] double yaw_cosine(double yaw_rad);

}  // namespace twindeck::aero
