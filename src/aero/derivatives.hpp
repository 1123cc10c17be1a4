#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>

namespace twindeck::aero {

/// Flutter derivatives of a deck section at one reduced velocity and angle of attack. All conversions between conventions are
/// in this file.
///
/// Sign frame of the whole library: y downwind, z up, alpha nose-up; drag D downwind, lift L up, moment M nose-up; the nose is
/// the upwind edge. Rows of every 3 × 3 block are (D, L, M), columns (y, z, alpha).
///
/// Scanlan's form with the half-rho prefactor (Simiu and Scanlan 1996), K = omega B / V:
///   D = ½ρV²B  (K P1 ẏ/V + K P5 ż/V + K P2 Bα̇/V + K² P4 y/B + K² P6 z/B + K² P3 α)
///   L = ½ρV²B  (K H5 ẏ/V + K H1 ż/V + K H2 Bα̇/V + K² H6 y/B + K² H4 z/B + K² H3 α)
///   M = ½ρV²B² (K A5 ẏ/V + K A1 ż/V + K A2 Bα̇/V + K² A6 y/B + K² A4 z/B + K² A3 α)
/// Other conventions, which are not read here: the older form with ½ρV²(2B) has half of these values; the classic h and L,
/// positive down, change the sign of H2, H3, H5, H6, A1, A4, P5, P6.
struct DerivativeBlock {
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();    ///< [[P1,P5,P2],[H5,H1,H2],[A5,A1,A2]]
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< [[P4,P6,P3],[H6,H4,H3],[A6,A4,A3]]
};

enum class Convention { scanlan, zasso };

/// Eighteen values in the order X1 … X6 of lift (H, h), drag (P, p), moment (A, a).
using Derivatives18 = std::array<double, 18>;

/// Which entry of a DerivativeBlock the i-th of the eighteen is.
struct DerivativeEntry {
  int row;       ///< 0 D, 1 L, 2 M
  int column;    ///< 0 y, 1 z, 2 alpha
  bool damping;  ///< else stiffness
};
[[nodiscard]] DerivativeEntry entry_of(Convention convention, int index);
/// "H1" … "A6" of Scanlan's form, "h1" … "a6" of Zasso's.
[[nodiscard]] std::string name_of(Convention convention, int index);

/// From either convention, at V* = V/(omega B). Zasso's form is the paper's Eq. (8); there p1, p4 multiply the vertical and p5,
/// p6 the horizontal motion, so that (paper Eq. (9), corrected: a2* with V*, drag rows exchanged)
///   H1 = -V* h1, H2 = -V* h2, H3 = V*² h3, H4 = (π/2) h4, H5 = -V* h5, H6 = (π/2) h6;  A the same;
///   P1 = -V* p5, P2 = -V* p2, P3 = V*² p3, P4 = (π/2) p6, P5 = -V* p1, P6 = (π/2) p4.
/// Reference: Zasso (1996), J. Wind Eng. Ind. Aerodyn. 60, 161-173.
[[nodiscard]] DerivativeBlock to_block(Convention convention, const Derivatives18& values, double v_over_omegaB);
/// The inverse of to_block.
[[nodiscard]] Derivatives18 from_block(Convention convention, const DerivativeBlock& block, double v_over_omegaB);

/// Flutter derivatives of a section as a function of angle of attack and reduced velocity, from any source.
class FlutterDerivatives {
 public:
  virtual ~FlutterDerivatives() = default;
  /// @param alpha_rad      mean angle of attack, nose-up
  /// @param v_over_omegaB  V* = V/(omega B) = 1/K; a wind tunnel's V/(f B) is 2π times that
  [[nodiscard]] virtual DerivativeBlock at(double alpha_rad, double v_over_omegaB) const = 0;
  /// Whether `at` has a value there; false where it would refuse.
  [[nodiscard]] virtual bool covers(double /*alpha_rad*/, double /*v_over_omegaB*/) const { return true; }
};
using DerivativesPtr = std::shared_ptr<const FlutterDerivatives>;

}  // namespace twindeck::aero
