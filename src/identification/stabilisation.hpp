#pragma once

#include <vector>

#include "identification/state_space.hpp"

namespace twindeck::identification {

/// The criteria of paper section 3.1, each against the model of the next smaller order.
struct StabilisationCriteria {
  double frequency = 0.02;  ///< relative change below which a frequency is stable
  double damping = 0.01;    ///< change of the damping ratio [-], one percentage point, below which it is stable
  double mac = 0.95;        ///< MAC from which a shape is stable
};

/// Hard limits that every mode of a structure meets.
struct PoleLimits {
  double lowest_Hz = 0.0, highest_Hz = 1e300;
  double largest_damping = 0.20;  ///< 0 < zeta < largest_damping
};

/// A pole of the diagram.
struct DiagramPole {
  Pole pole;
  bool stable_frequency = false, stable_damping = false, stable_shape = false;
  int mode = -1;                  ///< position in the list of identified modes, -1 for none
  double frequency_std_Hz = 0.0;  ///< from the data's covariance; 0 where that is unknown
  [[nodiscard]] bool stable() const { return stable_frequency && stable_damping && stable_shape; }
};

/// The stabilisation diagram: poles of all orders within the limits, each compared with the pole of the next smaller order that
/// has the highest MAC with it among those within the frequency criterion (close modes may change their order in frequency, not
/// their shapes).
/// @param poles  one list an order, orders ascending
[[nodiscard]] std::vector<DiagramPole> stabilisation_diagram(const std::vector<std::vector<Pole>>& poles,
                                                             const StabilisationCriteria& criteria, const PoleLimits& limits);

}  // namespace twindeck::identification
