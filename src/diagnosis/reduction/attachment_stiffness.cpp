#include "diagnosis/reduction/attachment_stiffness.hpp"

#include <cmath>
#include <numbers>

namespace twindeck::diagnosis {

std::complex<double> jenkins_stiffness(double stiffness, double threshold_N, double amplitude_m) {
  const double yield = threshold_N / stiffness;
  if (amplitude_m <= yield) return stiffness;
  const double t = std::acos(1.0 - 2.0 * yield / amplitude_m);
  return {stiffness / std::numbers::pi * (t - 0.5 * std::sin(2.0 * t)),
          4.0 * threshold_N / (std::numbers::pi * amplitude_m) * (1.0 - yield / amplitude_m)};
}

std::complex<double> sliding_stiffness(double stiffness, double threshold_N, double damping, double omega, double amplitude_m) {
  if (damping <= 0.0) return jenkins_stiffness(stiffness, threshold_N, amplitude_m);
  // Balance of the first harmonic at the slider, amplitude Y:  (k Y)² + (c omega Y + 4 F_c/pi)² = (k X)².
  const double held = 4.0 * threshold_N / std::numbers::pi;
  if (stiffness * amplitude_m <= held) return stiffness;
  const double a = stiffness * stiffness + std::pow(damping * omega, 2), b = damping * omega * held;
  const double c = held * held - std::pow(stiffness * amplitude_m, 2);
  const double slide = (-b + std::sqrt(b * b - a * c)) / a;
  const std::complex<double> dashpot(0.0, damping * omega + held / slide);
  return stiffness * dashpot / (stiffness + dashpot);
}

std::pair<std::complex<double>, std::complex<double>> dynamic_stiffness(const Attachment& a, std::complex<double> s,
                                                                        double amplitude_m) {
  switch (a.kind) {
    case Attachment::Kind::dashpot:
      return {a.damping * s, a.damping};
    case Attachment::Kind::maxwell: {
      const std::complex<double> below = a.stiffness + a.damping * s;
      return {a.stiffness * a.damping * s / below, a.stiffness * a.stiffness * a.damping / (below * below)};
    }
    case Attachment::Kind::jenkins:
      return {sliding_stiffness(a.stiffness, a.threshold_N, a.damping, std::abs(s), amplitude_m), 0.0};
  }
  return {0.0, 0.0};
}

std::complex<double> second_derivative(const Attachment& a, std::complex<double> s) {
  if (a.kind != Attachment::Kind::maxwell) return 0.0;
  const std::complex<double> below = a.stiffness + a.damping * s;
  return -2.0 * std::pow(a.stiffness * a.damping, 2) / (below * below * below);
}

}  // namespace twindeck::diagnosis
