#pragma once

#include <Eigen/Core>

#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// Modes that the reduced basis needs for the measured frequencies to lie well inside it.
struct BasisModes {
  int modes = 0;                  ///< of the basis
  int in_band = 0;                ///< of these up to the highest measured frequency; 0 where the least number suffices
  double reach_Hz = 0.0;          ///< up to which the basis should hold every mode
  bool enough = true;             ///< false: not even as many modes as a basis may have reach that far
  Eigen::VectorXd frequency_Hz;   ///< of the structure as it stands, as far as they were computed
  double eighth_of_wave_m = 0.0;  ///< of the shortest wave among the modes of the measured band; 0 for a matrix model
};

/// A wave's length in a mode is 2 pi times the root of its mean square displacement over that of its slope along the elements.
/// @param least  modes that the basis has in any case
[[nodiscard]] BasisModes modes_of_basis(const Structure& structure, const FeatureSet& features, int least);

}  // namespace twindeck::diagnosis
