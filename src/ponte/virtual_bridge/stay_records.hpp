#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "fe/model.hpp"
#include "ponte/virtual_bridge/campaign_settings.hpp"

namespace twindeck::ponte {

/// A stay between fixed ends, as its own test finds it.
struct StayTruth {
  Eigen::VectorXd frequency_Hz;    ///< (5) of the first in-plane modes
  double pull_per_mass_m2_s2 = 0;  ///< T/m
  double lambda_squared = 0;
  double length_m = 0;
  bool is_string = true;  ///< false where frequencies were imposed: T/m and lambda² are then not those of these frequencies
};
struct StayRecord {
  StayTruth truth;
  Eigen::VectorXd acceleration_m_s2;  ///< (n_samples) in the vertical plane, across the chord
  Eigen::Vector3d x_m, direction;     ///< of the sensor
};

/// The stay of a test. @throws InputError  if there is no such stay
[[nodiscard]] const fe::Element& stay_of(const fe::Model& model, const StayTest& test);

/// A record of an accelerometer on a stay that hangs between its anchorages in the model, as a chain of 96 pieces: pull as
/// given, axial stiffness such that Irvine's parameter
///
///     lambda² = (m g L cos(theta) / T)² EA L / (T L_e),   L_e = L (1 + (m g L cos(theta) / T)² / 8)
///
/// is the given one; white forces across it, five in-plane modes with the given damping, trapezoidal rule.
/// @throws InputError  as stay_of
/// Reference: Irvine (1981), Cable Structures, section 2.4 and 3.2.
[[nodiscard]] StayRecord stay_record(const fe::Model& model, const StayTest& test, const CampaignSettings& settings,
                                     std::uint64_t seed, std::uint64_t stream);

}  // namespace twindeck::ponte
