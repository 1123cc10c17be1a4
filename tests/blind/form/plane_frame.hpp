#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

/// The truths' own structural analysis: plane frames of Timoshenko beams with dense matrices. Nothing of src/fe is in it, so
/// that a truth and the model that is fitted to it have no line of code in common. It takes nodes, beams, springs and masses
/// and gives modes.
namespace twindeck::blind::form {

/// A linear combination of unknowns: the stretch of a spring, the movement of a mass.
struct Part {
  int unknown;
  double factor;
};
using Movement = std::vector<Part>;

/// A uniform straight beam. Its end rotations may be unknowns of their own (a joint that turns).
struct BeamPart {
  int from = -1, to = -1;
  double axial_N = 0.0;       ///< EA
  double bending_N_m2 = 0.0;  ///< EI
  double shear_N = 0.0;       ///< kappa G A; 0: rigid in shear
  double mass_kg_m = 0.0;
  double rotary_kg_m = 0.0;          ///< rho I
  double compression_N = 0.0;        ///< axial force that softens bending
  int turn_from = -1, turn_to = -1;  ///< unknowns of the end rotations; -1: the nodes'
};

/// Undamped modes, lowest first, mass-normalised.
struct FrameModes {
  Eigen::VectorXd omega2;  ///< (n) squared angular frequencies
  Eigen::MatrixXd shapes;  ///< (n_unknowns × n); zero in fixed unknowns
};

class PlaneFrame {
 public:
  /// A node with three unknowns: x, z, and the turn w' of a beam along x (anticlockwise with z upwards).
  int add_node(const Eigen::Vector2d& x_m);
  /// An unknown of its own: a beam's end rotation, an attached mass.
  int add_unknown();
  [[nodiscard]] int unknown(int node, int direction) const { return first_[static_cast<std::size_t>(node)] + direction; }
  [[nodiscard]] const Eigen::Vector2d& position(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] int unknowns() const { return unknowns_; }

  void add_beam(const BeamPart& beam) { beams_.push_back(beam); }
  void add_spring(const Movement& stretch, double N_m) { springs_.push_back({stretch, N_m}); }
  void add_mass(const Movement& movement, double kg) { masses_.push_back({movement, kg}); }
  void fix(int unknown) { fixed_.push_back(unknown); }

  [[nodiscard]] Eigen::MatrixXd stiffness() const;
  [[nodiscard]] Eigen::MatrixXd mass() const;
  /// All modes that have mass. @throws std::runtime_error where the stiffness is not positive definite
  [[nodiscard]] FrameModes modes() const;
  /// Displacement under a load. @param load (n_unknowns)
  [[nodiscard]] Eigen::VectorXd displacement(const Eigen::VectorXd& load) const;

 private:
  struct Rank {
    Movement movement;
    double amount;
  };
  [[nodiscard]] std::vector<int> free() const;
  std::vector<Eigen::Vector2d> nodes_;
  std::vector<int> first_, fixed_;
  std::vector<BeamPart> beams_;
  std::vector<Rank> springs_, masses_;
  int unknowns_ = 0;
};

/// Modes with a spring whose stiffness depends on frequency (a damper's storage stiffness), each mode with the stiffness at its
/// own frequency. @param keep  so many of the lowest modes without it carry the motion
[[nodiscard]] FrameModes with_varying_spring(const FrameModes& modes, const Movement& stretch,
                                             const std::function<double(double omega_rad_s)>& N_m, int count, int keep);

}  // namespace twindeck::blind::form
