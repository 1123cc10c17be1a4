#pragma once

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "aero/follow_mode.hpp"
#include "linear_polar.hpp"
#include "test_places.hpp"

/// Systems in wind that the verification cases share.
namespace twindeck::wind_test {

inline std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/data/wind" / name;
}

/// Motions of a strip of a straight deck along X in wind along Y: lateral, vertical, nose-up rotation.
inline aero::StripMotion motion(const std::vector<std::array<double, 3>>& y_z_alpha) {
  aero::StripMotion m = aero::StripMotion::Zero(6, static_cast<Eigen::Index>(y_z_alpha.size()));
  for (std::size_t i = 0; i < y_z_alpha.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    m(1, c) = y_z_alpha[i][0];
    m(2, c) = y_z_alpha[i][1];
    m(3, c) = -y_z_alpha[i][2];  // nose-up is about -X
  }
  return m;
}

inline aero::ReducedStructure structure(const std::vector<double>& frequency_Hz, double damping_ratio) {
  aero::ReducedStructure s;
  s.omega_rad_s = 2 * std::numbers::pi *
                  Eigen::Map<const Eigen::VectorXd>(frequency_Hz.data(), static_cast<Eigen::Index>(frequency_Hz.size()));
  s.damping_ratio = Eigen::VectorXd::Constant(s.size(), damping_ratio);
  return s;
}

/// A unit length of a rigid section on springs.
inline aero::AeroelasticSystem section_model(const aero::ReducedStructure& s, double chord_m, double density_kg_m3,
                                             aero::DerivativesPtr derivatives,
                                             const std::vector<std::array<double, 3>>& y_z_alpha,
                                             const aero::StaticCoefficients& coefficients = {}) {
  const aero::Wind wind{density_kg_m3, Eigen::Vector3d::UnitY()};
  const aero::Strip strip = aero::make_strip("section", 0, 0.0, 1.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), wind);
  return {s,       {{"section", chord_m, aero::linear_polar(coefficients), std::move(derivatives)}},
          {strip}, {motion(y_z_alpha)},
          wind,    aero::everywhere(aero::published_yaw_rule("A"))};
}

inline std::vector<double> speeds(double first, double last, double step) {
  std::vector<double> v;
  for (double x = first; x <= last + 1e-9; x += step) v.push_back(x);
  return v;
}

inline std::vector<aero::Branch> follow_all(const aero::AeroelasticSystem& system, const std::vector<double>& v) {
  std::vector<aero::Branch> branches;
  int mode = 0;
  for (const aero::ComplexMode& start : aero::still_air_modes(system.structure())) {
    branches.push_back(aero::follow_mode(system, start, ++mode, v));
  }
  return branches;
}

/// The lowest critical point of the branches.
inline std::optional<aero::CriticalPoint> lowest_critical_point(const aero::AeroelasticSystem& system,
                                                                const std::vector<aero::Branch>& branches) {
  std::optional<aero::CriticalPoint> lowest;
  for (const aero::Branch& branch : branches) {
    const std::optional<aero::CriticalPoint> found = aero::critical_point(system, branch);
    if (found && (!lowest || found->speed_m_s < lowest->speed_m_s)) lowest = found;
  }
  return lowest;
}

inline double critical_speed(const aero::AeroelasticSystem& system, const std::vector<double>& v) {
  const auto found = lowest_critical_point(system, follow_all(system, v));
  return found ? found->speed_m_s : std::nan("");
}

}  // namespace twindeck::wind_test
