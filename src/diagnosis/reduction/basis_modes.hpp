#pragma once

#include <Eigen/Core>

#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// Modes that the reduced basis needs for the measured frequencies to lie well inside it.
struct BasisModes {
  int modes = 0;                  ///< of the basis
  int in_band = 0;                ///< number of modes up to the highest measured frequency; 0 if the least number suffices
  double reach_Hz = 0.0;          ///< frequency up to which the basis should have every mode
  bool enough = true;             ///< false: even the largest allowed number of modes does not reach that frequency
  Eigen::VectorXd frequency_Hz;   ///< of the unchanged structure, as far as computed
  double eighth_of_wave_m = 0.0;  ///< of the shortest wavelength in the measured band; 0 for a matrix model
};

/// A wave's length in a mode is 2 pi times the root of its mean square displacement over that of its slope along the elements.
/// @param least  least number of modes of the basis
[[nodiscard]] BasisModes modes_of_basis(const Structure& structure, const FeatureSet& features, int least);

}  // namespace twindeck::diagnosis
