#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

/// Room diagnosis/features: common errors of the rows of a measurement if the model's form is wrong. It takes modes of
/// the model and the rows that they are paired with, as plain numbers, and gives columns of unknowns with unit deviation
/// (decision 0013).
namespace twindeck::diagnosis {

/// Undamped modes of the model as the channels see them.
struct ModelModes {
  Eigen::VectorXd omega_rad_s;  ///< (n_modes) ascending
  Eigen::MatrixXd shapes;       ///< (n_channels × n_modes) of mass-normalised shapes
};

/// A measured mode of one condition with the model mode that it is paired with.
struct PairedMode {
  int model_mode = -1;  ///< position in ModelModes, -1 for none
  int condition = 0;
  int frequency_row = -1;           ///< -1: no frequency was measured
  std::vector<int> shape_rows;      ///< real parts
  std::vector<int> shape_channels;  ///< (n_shape_rows)
};

/// Errors of the model's form, equal in all conditions; one column per unknown.
struct FormColumns {
  Eigen::MatrixXd frequency;  ///< F (n_rows × paired model modes): ln f of one model mode
  Eigen::MatrixXd shape;  ///< U (n_rows × pairs of modes): a random symmetric stiffness in the model's modes (Soize 2000): of
                          ///< the pair (i, j) shape i gains w_i w_j / (w_i² - w_j²) phi_j and shape j the reverse
  Eigen::MatrixXd kinks;  ///< W (n_rows × paired model modes and channels): a quarter of a shape's norm at one channel
};

/// @param predicted  (n_rows) of the model; it gives a shape its size and sign
[[nodiscard]] FormColumns form_columns(const ModelModes& modes, const std::vector<PairedMode>& paired,
                                       const Eigen::VectorXd& predicted);

/// Rotations of measured shapes among modes of one condition whose frequencies are between 6 and 12 % apart (closer ones have
/// theirs in the rows' covariance). @param frequency_Hz (n_paired) measured
[[nodiscard]] Eigen::MatrixXd close_rotations(const std::vector<PairedMode>& paired, const std::vector<double>& frequency_Hz,
                                              const Eigen::VectorXd& values);

/// Contrast between conditions: a key of conditions.toml, from 0 to 1 at its extreme.
struct Contrast {
  std::string key;
  Eigen::VectorXd weight;  ///< (n_conditions)
};
/// Empty if fewer than two different values are known. Temperatures count from their mean, other keys from zero.
/// @param values  (n_conditions)
[[nodiscard]] std::optional<Contrast> contrast_of(const std::string& key, const std::vector<std::optional<double>>& values);

}  // namespace twindeck::diagnosis
