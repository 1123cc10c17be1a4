#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "diagnosis/reduction/attachment_stiffness.hpp"

namespace twindeck::diagnosis {

/// One state of the structure: matrices and attachments under one set of circumstances.
struct StructureState {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n)
  std::vector<Attachment> attachments;
  Eigen::RowVectorXd amplitude_row;  ///< (n) motion at the channel that the amplitude is known at; empty if unknown
  double amplitude_m = 0.0;          ///< RMS displacement there; 0: small, nothing slips
  [[nodiscard]] bool damped() const { return !attachments.empty(); }
};

/// Motion b' phi along a direction.
[[nodiscard]] std::complex<double> along(const Eigen::Ref<const Eigen::VectorXd>& b, const Eigen::VectorXcd& phi);

/// [m] Peak amplitude of an element that moves by `here` in a mode that moves the amplitude's channel, where the RMS is known,
/// by `there`. A mode that hardly moves the channel cannot be scaled by it: at most 50 times the channel's amplitude.
[[nodiscard]] double peak(const StructureState& state, std::complex<double> here, std::complex<double> there);

/// The same of an element of direction b (n) in the mode phi (n); 0 where no amplitude is known.
[[nodiscard]] double peak(const StructureState& state, const Eigen::VectorXcd& phi, const Eigen::VectorXd& b);

/// T(s) of a state with attachments at the amplitudes of the shape phi (n), and T'(s) phi.
void dynamic_matrices(const StructureState& state, std::complex<double> s, const Eigen::VectorXcd& phi, Eigen::MatrixXcd& t,
                      Eigen::VectorXcd& t_prime_phi);

}  // namespace twindeck::diagnosis
