#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// Room diagnosis/causes: causes of the model's side that are more than a number at a place, a file each. It takes modes and
/// matrices as plain numbers. It gives what such a cause explains of the measurement, by odds.
namespace twindeck::diagnosis {

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

/// Which measured modes a model explains. The likelihood is that of a density in two levels over what could have been measured:
/// a mode of the structure is explained with probability `hit`, and what is not a mode of the model is explained by accident
/// with probability c_i, the part of the measured band (in ln f) in which this very shape would find a mode of the model that
/// is like it. So
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

}  // namespace twindeck::diagnosis
