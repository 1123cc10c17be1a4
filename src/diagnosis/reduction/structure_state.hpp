#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>
#include <vector>

namespace twindeck::diagnosis {

/// A one-dimensional element between the structure's motion b'u and the ground (or a second point that b includes).
struct Attachment {
  enum class Kind { dashpot, maxwell, jenkins } kind = Kind::dashpot;
  Eigen::VectorXd direction;  ///< b (n)
  double stiffness = 0.0;     ///< maxwell: of the spring in series; jenkins: while it sticks [N/m]
  double damping = 0.0;       ///< [N s/m]; jenkins: of a dashpot beside the slider
  double threshold_N = 0.0;   ///< jenkins: slip force
};

/// Dynamic stiffness of a Jenkins element (spring k in series with a slider F_c) at peak amplitude X, by harmonic balance:
/// X_y = F_c/k, cos t = 1 - 2 X_y/X:  Re = (k/pi)(t - sin(2t)/2), Im = (4 F_c/(pi X))(1 - X_y/X); k where X <= X_y.
/// Reference: Caughey (1960), Journal of Applied Mechanics 27, 640-643.
[[nodiscard]] std::complex<double> jenkins_stiffness(double stiffness, double threshold_N, double amplitude_m);

/// The same with a dashpot c beside the slider: a damper whose mount is a spring k and that friction holds until the force
/// exceeds F_c. First-harmonic balance at the slider; with c = 0 the Jenkins element.
[[nodiscard]] std::complex<double> sliding_stiffness(double stiffness, double threshold_N, double damping, double omega,
                                                     double amplitude_m);

/// d(s, X) of an attachment at peak amplitude X [N/m], and its derivative in s (zero for friction, which depends on |s| only).
[[nodiscard]] std::pair<std::complex<double>, std::complex<double>> dynamic_stiffness(const Attachment& a,
                                                                                      std::complex<double> s,
                                                                                      double amplitude_m);

/// d²d/ds² of an attachment [N s²/m]: of a Maxwell element -2 k² c²/(k + c s)³, of others zero.
[[nodiscard]] std::complex<double> second_derivative(const Attachment& a, std::complex<double> s);

/// One state of the structure: matrices and attachments in one set of conditions.
struct StructureState {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n)
  std::vector<Attachment> attachments;
  Eigen::RowVectorXd amplitude_row;  ///< (n) motion at the channel of the known amplitude; empty if unknown
  double amplitude_m = 0.0;          ///< RMS displacement there; 0: small, nothing slips
  [[nodiscard]] bool damped() const { return !attachments.empty(); }
};

/// Motion b' phi along a direction.
[[nodiscard]] std::complex<double> along(const Eigen::Ref<const Eigen::VectorXd>& b, const Eigen::VectorXcd& phi);

/// [m] Peak amplitude of an element that moves by `here` in a mode; the mode moves the channel with the known RMS by `there`. A
/// mode that hardly moves that channel cannot be scaled by it, so the result is at most 50 times the channel's amplitude.
[[nodiscard]] double peak(const StructureState& state, std::complex<double> here, std::complex<double> there);

/// The same of an element of direction b (n) in the mode phi (n); 0 where no amplitude is known.
[[nodiscard]] double peak(const StructureState& state, const Eigen::VectorXcd& phi, const Eigen::VectorXd& b);

/// T(s) of a state with attachments at the amplitudes of the shape phi (n), and T'(s) phi.
void dynamic_matrices(const StructureState& state, std::complex<double> s, const Eigen::VectorXcd& phi, Eigen::MatrixXcd& t,
                      Eigen::VectorXcd& t_prime_phi);

}  // namespace twindeck::diagnosis
