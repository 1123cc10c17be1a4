#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "aero/strip.hpp"

namespace twindeck::aero {

/// Self-excited forces of a strip on its own motions q = (y, z, alpha), harmonic at omega: F = damping q̇ + stiffness q, rows
/// (D, L, M) [N, N, N m]. Both are unsymmetric and must be stored full.
struct StripBlock {
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
};

/// Paper Eq. (8) in the dimensional form of Scanlan's derivatives with a rule of Table 11:
///   damping   = ½ρωB²L  ∘ H*(alpha, K') ∘ factor,   stiffness = ½ρω²B²L ∘ H*(alpha, K') ∘ factor,
/// The column of alpha and the row of the moment have one factor B more each. K' belongs to the rule's reduced velocity.
/// @param speed_m_s  > 0;  @param omega_rad_s > 0
/// @throws InputError  from the derivatives, outside their range
[[nodiscard]] StripBlock self_excited(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                                      double speed_m_s, double omega_rad_s);

/// Whether to use the paper's equations as printed where the print cannot be right.
enum class Equations { consistent, as_printed };

/// Static drag, lift and moment of a strip, paper Eq. (7), q = ½ρV²:  D = qBL C_D, L = qBL C_L, M = qB²L C_M (as printed: qBL),
/// at the strip's mean angle of attack, with the rule's factors. @return (D, L, M) along the rule's axes [N, N, N m]
[[nodiscard]] Eigen::Vector3d static_force(const SectionAero& section, const Strip& strip, const YawRule& rule,
                                           double density_kg_m3, double speed_m_s, Equations equations = Equations::consistent);

/// Forces per radian of a slow rotation: (C_D', C_L', C_M') with the same prefactors. For divergence.
[[nodiscard]] Eigen::Vector3d static_slope(const SectionAero& section, const Strip& strip, const YawRule& rule,
                                           double density_kg_m3, double speed_m_s);

/// Lists where the paper's equations (7) to (10) cannot hold as printed, what is used instead, and whether `as_printed`
/// restores the print.
struct EquationDifference {
  std::string equation, printed, taken, reason;
  bool selectable;
};
[[nodiscard]] const std::vector<EquationDifference>& equation_differences();

/// Spring and dashpot in series on a reduced structure: stiffness seen at s is k s c/(k + s c).
struct MaxwellUnit {
  double stiffness_N_m = 0.0, damping_N_s_m = 0.0;
  Eigen::VectorXd direction;  ///< (m) elongation per unit of each coordinate
};

/// A structure in m coordinates that make mass the unit matrix and stiffness diagonal: modes, or modes and static corrections
/// orthogonalised among each other.
struct ReducedStructure {
  Eigen::VectorXd omega_rad_s;    ///< (m) of each coordinate
  Eigen::VectorXd damping_ratio;  ///< (m) structural, of each coordinate
  Eigen::MatrixXd viscous;        ///< (m × m) of dashpots [N s/m]; empty: none
  std::vector<MaxwellUnit> maxwell;
  [[nodiscard]] Eigen::Index size() const { return omega_rad_s.size(); }
  /// 2 ξ ω on the diagonal, and the dashpots.
  [[nodiscard]] Eigen::MatrixXd damping() const;
  /// The coordinates listed alone: one mode at a time, for instance.
  [[nodiscard]] ReducedStructure restricted(const std::vector<Eigen::Index>& coordinates) const;
};

/// Global motions (x y z rx ry rz) of one strip by each coordinate: (6 × m).
using StripMotion = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// A reduced structure in wind:  q̈ + C q̇ + Λ q = Ca(V, ω) q̇ + Ka(V, ω) q, strips by the rules of a deployment.
class AeroelasticSystem {
 public:
  /// @param motions  one a strip, columns as the structure's coordinates
  AeroelasticSystem(ReducedStructure structure, std::vector<SectionAero> sections, std::vector<Strip> strips,
                    std::vector<StripMotion> motions, Wind wind, Deployment deployment);

  struct Block {
    Eigen::MatrixXd damping, stiffness;  ///< (m × m) Ca, Ka
  };
  /// Self-excited forces on the coordinates, harmonic at omega; zero without wind.
  [[nodiscard]] Block self_excited(double speed_m_s, double omega_rad_s) const;
  /// Static aerodynamic stiffness at 1 m/s, slopes of the polars on alpha: grows with V². @return (m × m)
  [[nodiscard]] Eigen::MatrixXd static_stiffness() const;
  /// The same system of the coordinates listed alone.
  [[nodiscard]] AeroelasticSystem restricted(const std::vector<Eigen::Index>& coordinates) const;

  [[nodiscard]] const ReducedStructure& structure() const { return structure_; }
  [[nodiscard]] const std::vector<Strip>& strips() const { return strips_; }
  [[nodiscard]] const std::vector<SectionAero>& sections() const { return sections_; }
  [[nodiscard]] const std::vector<StripMotion>& motions() const { return motions_; }
  [[nodiscard]] const Wind& wind() const { return wind_; }
  [[nodiscard]] const Deployment& deployment() const { return deployment_; }
  [[nodiscard]] const YawRule& rule(const Strip& strip) const { return deployment_.at(strip.deck, strip.yaw_rad); }

 private:
  ReducedStructure structure_;
  std::vector<SectionAero> sections_;
  std::vector<Strip> strips_;
  std::vector<StripMotion> motions_;
  Wind wind_;
  Deployment deployment_;
  Eigen::MatrixXd along_rule_;  ///< (3 n_strips × m) y, z, alpha of each strip along its rule's axes
};

/// A of ẋ = A x, x = (q, q̇, e): coordinates, their velocities, and the elongation e of the dashpot of each Maxwell unit,
/// c ė = k (d·q - e).
/// @param air  self-excited forces of one speed and frequency; empty matrices: still air
/// @return (2m + n × 2m + n) for n Maxwell units
[[nodiscard]] Eigen::MatrixXd state_matrix(const ReducedStructure& structure, const AeroelasticSystem::Block& air = {});

}  // namespace twindeck::aero
