#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/state_space.hpp"

namespace twindeck::identification {

/// Poles of frequency response functions by poly-reference least squares in the frequency domain (pLSCF). The model of order p
/// is
///
///     H(f) A(z) = B(z),   A(z) = I + A_1 z + … + A_p z^p,   B(z) = B_0 + … + B_p z^p,   z = exp(i (omega - omega_1) T),
///
/// with complex coefficients. The band from its first line omega_1 to its last turns z through nine tenths of a circle, so that
/// it may begin anywhere. The coefficients of B follow from those of A line by line of least squares, which leaves normal
/// equations for A of all channels together. det A = 0 gives the poles, and B(z) v with A(z) v = 0 the shape. A_0 = I makes the
/// poles that are none of the structure unstable, so that the limits of the diagram remove them. The damping of a single order
/// is biased by noise: fit_modes (modal_fit.hpp) ends that.
/// @param frequency_Hz  (n_lines) ascending, even or not
/// @param values        (n_lines × n_outputs n_inputs) column output · n_inputs + input, scaled alike
/// @param orders        ascending, even numbers: twice p, as a state space counts one input
/// @return one list an order, ascending in frequency; frequencies may lie outside the band
/// Reference: Guillaume, Verboven, Vanlanduit, Van der Auweraer and Peeters (2003), IMAC 21; Peeters, Van der Auweraer,
/// Guillaume and Leuridan (2004), Shock and Vibration 11, 395-409; Cauberghe (2004), thesis, Vrije Universiteit Brussel (A_0 =
/// I).
[[nodiscard]] std::vector<std::vector<Pole>> plscf_poles(const Eigen::VectorXd& frequency_Hz, const Eigen::MatrixXcd& values,
                                                         Eigen::Index n_inputs, const std::vector<int>& orders);

}  // namespace twindeck::identification
