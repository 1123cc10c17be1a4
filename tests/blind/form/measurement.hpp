#pragma once

#include "blind/form/hidden.hpp"
#include "diagnosis/features/features.hpp"

/// What a test measures on a truth: frequencies and shapes of the lowest modes that the channels see, in every condition.
namespace twindeck::blind::form {

constexpr double kFrequencyError = 0.002;  ///< relative deviation
constexpr double kShapeError = 0.01;       ///< deviation, of the shape's largest value

/// Modes of a truth in every condition, without errors; a mode has one label in all conditions of a state.
struct Measured {
  std::vector<SeenModes> modes;                  ///< (n_conditions)
  std::vector<Eigen::MatrixXd> shapes;           ///< (n_channels × n_modes) each, faults of sensors in them, largest value 1
  std::vector<std::vector<std::string>> labels;  ///< (n_conditions × n_modes)
};
[[nodiscard]] Measured measure(const Truth& truth, const Hidden& hidden);

/// How far what was hidden moves the rows, against the same test on the sound structure.
[[nodiscard]] double visibility(const Truth& truth, const Hidden& hidden);

/// Rows with errors, as the diagnosis reads them. Nothing is held out: the diagnosis leaves out whole modes in turn.
[[nodiscard]] diagnosis::FeatureSet rows_of(const Layout& layout, const Hidden& hidden, const Measured& measured,
                                            Stream& random);

}  // namespace twindeck::blind::form
