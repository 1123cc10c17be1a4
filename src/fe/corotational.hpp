#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

/// Co-rotational elements for large displacements and rotations with small strains. The linear element moves with its own
/// frame.
///
/// R is the rotation of the element's frame from the start to now, C and c are the means of its points at the start and now,
/// and T_a is the rotation of point a. The deformation of the element, in its initial orientation, is
///   d_a = Rᵀ (x_a - c) - (X_a - C),   θ_a = log(Rᵀ T_a),
/// and its forces are those of its own linear stiffness, K d, turned by R. Variations go through the projector P = 1 - S G that
/// takes the rigid motion out (S: displacements of a rigid turn, G: turn of the frame from displacements of the points), and
/// H = dθ/dω. The tangent
///   Pᵀ R Hᵀ K H Rᵀ P - Pᵀ F_nm G + Gᵀ F_n
/// is consistent but for terms of the order of the strain, and is returned in its symmetric part, which is the second
/// derivative of the energy at equilibrium. One formula serves beams, shells and solids; only frame and G differ. References:
/// Nour-Omid and Rankin (1991), CMAME 93, 353-384; Felippa and Haugen (2005), CMAME 194, 2285-2335 (section 7, terms K_M, K_GR,
/// K_GP); Battini and Pacoste (2002), CMAME 191, 1755-1789 (frame of a beam).
namespace twindeck::fe::corotational {

enum class Frame {
  chord,     ///< 2 points: along the chord, turned about it by the mean twist of both ends
  quad,      ///< 4 points: normal to both diagonals, first axis along their difference (as shell_frame.hpp)
  triangle,  ///< 3 points: normal to the plane through them, first axis along 1-2
  corner,    ///< 4 or 10 points: first axis along 1-2, plane of 1-2-3
  box        ///< 8 or 20 points: along the mean of the four edges 1-2, plane of the mean of the edges 1-4
};

struct Element {
  Frame frame = Frame::chord;
  std::vector<Eigen::Vector3d> start_m;  ///< (p) points before any displacement
  Eigen::Vector3d across;                ///< chord: a vector normal to it that turns with the ends
  Eigen::MatrixXd stiffness;             ///< (6p × 6p) in global axes at the start; no stiffness at rotations of a box
};

/// Current positions of the points.
struct Motion {
  std::vector<Eigen::Vector3d> displacement_m;  ///< (p)
  std::vector<Eigen::Matrix3d> rotation;        ///< (p) from the start; identity where the element has no rotations
};

struct Response {
  Eigen::VectorXd force;        ///< (6p) forces and moments at the points, global axes
  Eigen::MatrixXd tangent;      ///< (6p × 6p) with spins as rotations
  Eigen::VectorXd deformation;  ///< (6p) d and θ, in global axes at the start
  Eigen::Matrix3d rotation;     ///< R of the frame
};
/// @param with_tangent  false: `tangent` stays empty
[[nodiscard]] Response respond(const Element& element, const Motion& motion, bool with_tangent);

/// A straight bar between two points with tension N = N_0 + E A (l - l_0)/l_0: forces and tangent of its two points (6 × 6).
struct BarResponse {
  Eigen::Matrix<double, 6, 1> force;
  Eigen::Matrix<double, 6, 6> tangent;
  double tension_N;
};
[[nodiscard]] BarResponse respond_bar(const std::array<Eigen::Vector3d, 2>& start_m, const Motion& motion, double axial_EA_N,
                                      double initial_tension_N);

/// Rotation vector of a rotation (angle below π) and back; H(θ) with δθ = H δω for a spin δω from the left.
[[nodiscard]] Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);
[[nodiscard]] Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector);
[[nodiscard]] Eigen::Matrix3d spin_to_vector(const Eigen::Vector3d& theta);

}  // namespace twindeck::fe::corotational
