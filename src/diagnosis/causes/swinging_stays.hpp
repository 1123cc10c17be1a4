#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::diagnosis {

// Room diagnosis/causes: causes of the model's side that are more than a number at a place, a file each. It takes modes and
// matrices as plain numbers. It gives what such a cause explains of the measurement, by odds.

/// A measured mode whose shape is known.
struct MeasuredShape {
  std::string name;  ///< the mode's; one name in several conditions is one mode
  int condition = 0;
  double frequency_Hz = 0.0;
  std::vector<int> channels;
  Eigen::VectorXcd values;  ///< (n_channels of this shape), any norm
};

/// Modes of a model as the channels see them.
struct VisibleModes {
  Eigen::VectorXd frequency_Hz;  ///< (n_modes) ascending
  Eigen::MatrixXd shapes;        ///< (n_channels × n_modes)
};

/// When a model's mode explains a measured one.
struct ExplanationRule {
  double least_mac = 0.6;  ///< [-]
  double within = 0.05;    ///< [-] largest |ln(f computed / f measured)|
};

/// Which measured modes a model explains. A mode of the structure is explained with probability `hit`. Any other shape may be
/// explained by accident. Its probability c_i is the part of the measured band (in ln f) where the model has a mode like that
/// shape. So
///
///     ln L = sum over modes of  ln(hit / c_i) where it is explained, ln((1 - hit) / (1 - c_i)) where it is not,
///
/// a mode of several conditions counting once, by its mean. A model with many modes explains much by accident: its c_i are
/// large.
struct ExplainedModes {
  std::vector<int> mode;        ///< (n_measured) of the model, one-to-one in each condition; -1: none left
  std::vector<bool> explained;  ///< (n_measured)
  int count = 0;                ///< of those explained
  double log_likelihood = 0.0;  ///< ln L
};
[[nodiscard]] ExplainedModes explain(const std::vector<MeasuredShape>& measured, const VisibleModes& modes,
                                     const ExplanationRule& rule);

/// The rule's `within` by what the model itself shows: twice the robust deviation of ln f of the modes that it resembles
/// (median of |ln f| / 0.6745), between 2 % (cables are not known better) and 10 % (a mode further off is another one).
[[nodiscard]] double frequency_scatter(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, double least_mac);

/// Modes of a structure whose stays are bars: mass-normalised, stiffness diag(omega²).
struct BarModes {
  Eigen::VectorXd omega2;    ///< [rad²/s²] (n_modes)
  Eigen::MatrixXd channels;  ///< (n_channels × n_modes)
};

/// A stay's motion between its ends, in the coordinates [structure's modes; cable's modes between fixed ends] (component mode
/// synthesis, Craig and Bampton 1968): what swinging adds to a structure in which the stay is a bar.
struct SwingingCable {
  Eigen::MatrixXd ends_mass;  ///< (n_modes × n_modes) beyond the bar's
  Eigen::MatrixXd coupling;   ///< (n_modes × h) mass between the two
  Eigen::VectorXd omega2;     ///< (h) of the mass-normalised modes between fixed ends
};

/// @param stiffness, mass  (6 + n)² of fe::Cable: both ends' x y z first @param end_motion (6 × n_modes) of the structure's
/// modes
/// @param highest_Hz  modes of the cable up to it are kept
[[nodiscard]] SwingingCable swinging_cable(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                           const Eigen::MatrixXd& end_motion, double highest_Hz);

/// Modes of the structure with some of its stays swinging.
[[nodiscard]] VisibleModes modes_with(const BarModes& bars, const std::vector<const SwingingCable*>& cables);

/// Stays that swing by what was measured.
struct StayChoice {
  std::vector<int> swinging;  ///< positions among the cables, ascending; empty where none helps
  double log_odds = 0.0;      ///< of these stays as cables against all as bars
  ExplainedModes before, after;
  VisibleModes modes;  ///< with these stays swinging
};

/// Looks for the stays whose swinging explains the most. Stays that are known to swing, since their own frequencies were
/// measured, come in first and together where that raises ln L; there is nothing to choose. Then,
/// forwards, the stay, or the stays of one frequency together (twins move together), that raises ln L most comes in while it
/// raises it by more than what choosing it costs, ln of the number of choices; then any chosen one that no longer helps goes.
/// All stays at once are tried too, which costs no choice.
/// @param own_Hz  (n_cables) first frequency of each between fixed ends
/// @param least_gain  [nats] that a stay must bring of which nobody measured that it swings
/// @param known   positions of those whose own frequencies were measured, or their mirror images'
[[nodiscard]] StayChoice choose_swinging(const BarModes& bars, const std::vector<SwingingCable>& cables,
                                         const std::vector<double>& own_Hz, const std::vector<int>& known,
                                         const std::vector<MeasuredShape>& measured, const ExplanationRule& rule,
                                         double least_gain);

}  // namespace twindeck::diagnosis
