#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/causes/explained_modes.hpp"

namespace twindeck::diagnosis {

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
/// measured, come in first and together where that raises ln L (explained_modes.hpp); there is nothing to choose. Then,
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
