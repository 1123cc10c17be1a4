#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::diagnosis {

// Room diagnosis/causes: errors of the model that are more than a number at a location, one file each. It takes modes and
// matrices as plain numbers, and gives the odds that such a cause explains the measurement.

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

/// Conditions under which a mode of the model explains a measured one.
struct ExplanationRule {
  double least_mac = 0.6;  ///< [-]
  double within = 0.05;    ///< [-] largest |ln(f computed / f measured)|
};

/// Measured modes that a model explains. A mode of the structure is explained with probability `hit`. Any other shape may be
/// explained by accident. Its probability c_i is the part of the measured band (in ln f) where the model has a mode like that
/// shape. So
///
///     ln L = sum over modes of  ln(hit / c_i) where it is explained, ln((1 - hit) / (1 - c_i)) where it is not,
///
/// where a mode of several conditions counts once, by its mean. A model with many modes explains much by accident: its c_i are
/// large.
struct ExplainedModes {
  std::vector<int> mode;        ///< (n_measured) mode of the model, one-to-one in each condition; -1: not explained
  std::vector<bool> explained;  ///< (n_measured)
  int count = 0;                ///< of those explained
  double log_likelihood = 0.0;  ///< ln L
};
[[nodiscard]] ExplainedModes explain(const std::vector<MeasuredShape>& measured, const VisibleModes& modes,
                                     const ExplanationRule& rule);

/// Estimates the rule's `within` from the model: twice the robust deviation of ln f of the modes that it resembles (median of
/// |ln f| / 0.6745), between 2 % (the accuracy of cables) and 10 % (a larger distance means another mode).
[[nodiscard]] double frequency_scatter(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, double least_mac);

/// Modes of a structure whose stays are bars: mass-normalised, stiffness diag(omega²).
struct BarModes {
  Eigen::VectorXd omega2;    ///< [rad²/s²] (n_modes)
  Eigen::MatrixXd channels;  ///< (n_channels × n_modes)
};

/// A stay's motion between its ends, in the coordinates [structure's modes; cable's modes between fixed ends] (component mode
/// synthesis, Craig and Bampton 1968); it is added to a structure in which the stay is a bar.
struct SwingingCable {
  Eigen::MatrixXd ends_mass;  ///< (n_modes × n_modes) mass in addition to that of the bar
  Eigen::MatrixXd coupling;   ///< (n_modes × h) mass between both kinds of coordinates
  Eigen::VectorXd omega2;     ///< (h) of the mass-normalised modes between fixed ends
};

/// @param stiffness, mass  (6 + n)² of fe::Cable: x y z of both ends first @param end_motion (6 × n_modes) of the structure's
///         modes
/// @param highest_Hz  highest frequency of the kept cable modes
[[nodiscard]] SwingingCable swinging_cable(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                           const Eigen::MatrixXd& end_motion, double highest_Hz);

/// Modes of the structure with some of its stays swinging.
[[nodiscard]] VisibleModes modes_with(const BarModes& bars, const std::vector<const SwingingCable*>& cables);

/// Stays that swing by what was measured.
struct StayChoice {
  std::vector<int> swinging;  ///< positions among the cables, ascending; empty if no stay explains a mode by swinging
  double log_odds = 0.0;      ///< of these stays as cables, against all stays as bars
  ExplainedModes before, after;
  VisibleModes modes;  ///< with these stays swinging
};

/// Looks for the stays whose swinging explains the most. Stays with own measured frequencies are known to swing. They are added
/// first, all together, if that raises ln L. Then the stay, or the set of stays of one frequency, that raises ln L most is
/// added, as long as it raises ln L by more than ln of the number of choices. Then stays that no longer help are removed. All
/// stays at once are tried too, without a cost of choosing.
/// @param own_Hz  (n_cables) first frequency of each between fixed ends
/// @param least_gain  [nats] least gain of a stay without own measured frequency
/// @param known   positions of stays whose own frequencies, or those of their mirror image, were measured
[[nodiscard]] StayChoice choose_swinging(const BarModes& bars, const std::vector<SwingingCable>& cables,
                                         const std::vector<double>& own_Hz, const std::vector<int>& known,
                                         const std::vector<MeasuredShape>& measured, const ExplanationRule& rule,
                                         double least_gain);

}  // namespace twindeck::diagnosis
