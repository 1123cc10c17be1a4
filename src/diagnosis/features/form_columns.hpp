#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

/// Room diagnosis/features: common errors of the rows of a measurement if the model's form is wrong. It takes modes of
/// the model and the rows that they are paired with, as plain numbers, and gives columns of unknowns with unit deviation
/// (decision 0013).
namespace twindeck::diagnosis {

/// Undamped modes of a structure as the channels see them.
struct ModelModes {
  Eigen::VectorXd omega_rad_s;  ///< (n_modes) ascending
  Eigen::MatrixXd shapes;       ///< (n_channels × n_modes) of mass-normalised shapes
  Eigen::MatrixXd along;        ///< C = Phi' M Psi (n_modes of the base × n_modes): what of the base's modes they hold
};

/// 1 / (w_i² - w_j²), the relative gap held at 5 %: nearer modes turn no further into each other.
[[nodiscard]] double turning(double wi, double wj);

/// A measured mode of one condition with the model modes that it is paired with.
struct PairedMode {
  int model_mode = -1;  ///< of the base's modes the one that it is most like, -1 for none
  int condition = 0;
  int frequency_row = -1;           ///< -1: no frequency was measured
  std::vector<int> shape_rows;      ///< real parts
  std::vector<int> shape_channels;  ///< (n_shape_rows)
  int structure = 0, own_mode = 0;  ///< the structure of its condition, and position among that one's modes
};

/// Errors of the model's form, equal in all conditions; one column per unknown. The form's error belongs to the structure:
/// dK = M Phi A Phi' M in the base's modes Phi. In another state (a part is lost, a mass was added) the modes are Psi, and rows
/// see C' A C. A change that turns modes into each other therefore leaves errors of its own in the rows, and no further cause
/// is needed for them.
struct FormColumns {
  Eigen::MatrixXd frequency;  ///< F (n_rows × modes of the base): ln f of one of them
  Eigen::MatrixXd shape;  ///< U (n_rows × pairs of modes): A is a random symmetric stiffness (Soize 2000), w_i w_j in the pair
                          ///< (i, j). In the base shape i gains w_i w_j / (w_i² - w_j²) phi_j and shape j the reverse
  Eigen::MatrixXd kinks;  ///< W (n_rows × modes of the base and channels): a quarter of a shape's norm at one channel
};

/// @param structures  the base first
/// @param predicted   (n_rows) of the model; it gives a shape its size and sign
[[nodiscard]] FormColumns form_columns(const std::vector<ModelModes>& structures, const std::vector<PairedMode>& paired,
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
