#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>
#include <vector>

#include "diagnosis/undamped_modes.hpp"

namespace twindeck::diagnosis {

/// A one-dimensional element between the structure's motion b'u and the ground (or a second point that b includes).
struct Attachment {
  enum class Kind { dashpot, maxwell, jenkins } kind = Kind::dashpot;
  Eigen::VectorXd direction;  ///< b (n)
  double stiffness = 0.0;     ///< maxwell: of the spring in series; jenkins: while it sticks [N/m]
  double damping = 0.0;       ///< [N s/m]; jenkins: of a dashpot beside the slider
  double threshold_N = 0.0;   ///< jenkins: slip force
};

/// One state of the structure: matrices and attachments under one set of circumstances.
struct StructureState {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n)
  std::vector<Attachment> attachments;
  Eigen::RowVectorXd amplitude_row;  ///< (n) motion at the channel that the amplitude is known at; empty if unknown
  double amplitude_m = 0.0;          ///< RMS displacement there; 0: small, nothing slips
  [[nodiscard]] bool damped() const { return !attachments.empty(); }
};

/// Modes of a state: eigenvalues s = -zeta omega ± i omega sqrt(1 - zeta²) with positive imaginary part.
struct StateModes {
  Eigen::VectorXcd s;       ///< (n_modes) [rad/s], ascending in |s|
  Eigen::MatrixXcd shapes;  ///< (n × n_modes) phi' T'(s) phi = 2 s (mass-normalised where undamped)
  [[nodiscard]] double frequency_Hz(Eigen::Index i) const;  ///< |s| / 2 pi
  [[nodiscard]] double damping(Eigen::Index i) const;       ///< -Re s / |s|
};

/// Dynamic stiffness of a Jenkins element (spring k in series with a slider F_c) at peak amplitude X, by harmonic balance:
/// X_y = F_c/k, cos t = 1 - 2 X_y/X:  Re = (k/pi)(t - sin(2t)/2), Im = (4 F_c/(pi X))(1 - X_y/X); k where X <= X_y.
/// Reference: Caughey (1960), Journal of Applied Mechanics 27, 640-643.
[[nodiscard]] std::complex<double> jenkins_stiffness(double stiffness, double threshold_N, double amplitude_m);

/// The same with a dashpot c beside the slider: a damper whose mount is a spring k and that friction holds until the force
/// exceeds F_c. First-harmonic balance at the slider; with c = 0 the Jenkins element.
[[nodiscard]] std::complex<double> sliding_stiffness(double stiffness, double threshold_N, double damping, double omega,
                                                     double amplitude_m);

/// d(s, X) of an attachment at peak amplitude X [N/m], and its derivative in s (of friction none: it goes by |s| alone).
[[nodiscard]] std::pair<std::complex<double>, std::complex<double>> dynamic_stiffness(const Attachment& a,
                                                                                      std::complex<double> s,
                                                                                      double amplitude_m);

/// T(s) of a state with attachments at the amplitudes of the shape phi (n), and T'(s) phi.
void dynamic_matrices(const StructureState& state, std::complex<double> s, const Eigen::VectorXcd& phi, Eigen::MatrixXcd& t,
                      Eigen::VectorXcd& t_prime_phi);

/// Modes up to `highest_Hz`. Undamped states by a symmetric eigenproblem; damped ones, T(s) phi = 0 with
/// T = s² M + K + sum d_k(s, X_k) b_k b_k' and X_k the mode's own amplitude at the element, by Newton on their characteristic
/// equation in the undamped modes. It starts from the roots of `neighbour` (same attachments, other matrices) where there is
/// one, else from the eigenvalues of the low modes. Where two roots end in one, or one is lost: a larger state space, each root
/// then refined.
/// @param store  undamped modes known so far
[[nodiscard]] StateModes solve_state(const StructureState& state, double highest_Hz, UndampedStore& store,
                                     const StateModes* neighbour = nullptr);

/// Derivatives of one mode with respect to changes dK_j, dM_j, from the bordered system (Nelson 1976; Lee, Kim and Jung 1999
/// for damped systems). Amplitudes at friction elements are held.
struct ModeDerivative {
  Eigen::VectorXcd s;       ///< (n_changes)
  Eigen::MatrixXcd shapes;  ///< (n × n_changes)
};
/// @param stiffness, mass  (n_changes) matrices (n × n), size 0 for no change
[[nodiscard]] ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                           const std::vector<Eigen::MatrixXd>& stiffness,
                                           const std::vector<Eigen::MatrixXd>& mass);

}  // namespace twindeck::diagnosis
