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
  Eigen::MatrixXd along;        ///< C = Phi' M Psi (n_modes of the base × n_modes): parts of the base's modes in these modes
};

/// 1 / (w_i² - w_j²). A relative gap below 5 % counts as 5 %: nearer modes do not mix more.
[[nodiscard]] double turning(double wi, double wj);

/// A measured mode of one condition with the model modes that it is paired with.
struct PairedMode {
  int model_mode = -1;  ///< mode of the base with the highest likeness, -1 for none
  int condition = 0;
  int frequency_row = -1;           ///< -1: no frequency was measured
  std::vector<int> shape_rows;      ///< real parts
  std::vector<int> shape_channels;  ///< (n_shape_rows)
  int structure = 0, own_mode = 0;  ///< structure of its condition, and position among the modes of that structure
};

/// Errors of the model's form, equal in all conditions; one column per unknown. The form's error belongs to the structure: dK =
/// M Phi A Phi' M in the base's modes Phi. In another state (a part is lost, a mass was added) the modes are Psi, and the rows
/// contain C' A C. So the same form error gives other errors of the rows if a change mixes the modes, and no further cause is
/// needed for these.
struct FormColumns {
  Eigen::MatrixXd frequency;  ///< F (n_rows × modes of the base): change of ln f of one mode
  Eigen::MatrixXd shape;  ///< U (n_rows × pairs of modes): A is a random symmetric stiffness (Soize 2000), w_i w_j in the pair
                          ///< (i, j). In the base shape i gains w_i w_j / (w_i² - w_j²) phi_j and shape j the reverse
  Eigen::MatrixXd kinks;  ///< W (n_rows × modes of the base and channels): a quarter of the shape's norm at one channel
};

/// @param structures  the base first
/// @param predicted   (n_rows) of the model; it gives a shape its size and sign
[[nodiscard]] FormColumns form_columns(const std::vector<ModelModes>& structures, const std::vector<PairedMode>& paired,
                                       const Eigen::VectorXd& predicted);

/// Rotations of measured shapes among modes of one condition whose frequencies are between 6 and 12 % apart (the covariance of
/// the rows has those of closer modes). @param frequency_Hz (n_paired) measured
[[nodiscard]] Eigen::MatrixXd close_rotations(const std::vector<PairedMode>& paired, const std::vector<double>& frequency_Hz,
                                              const Eigen::VectorXd& values);

/// Weight of each condition by a key of conditions.toml, scaled so that the largest absolute value is 1.
struct Contrast {
  std::string key;
  Eigen::VectorXd weight;  ///< (n_conditions)
};
/// Empty if fewer than two different values are known. Temperatures count from their mean, other keys from zero.
/// @param values  (n_conditions)
[[nodiscard]] std::optional<Contrast> contrast_of(const std::string& key, const std::vector<std::optional<double>>& values);

}  // namespace twindeck::diagnosis
