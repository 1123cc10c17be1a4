#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "modal/modes.hpp"

/// What was measured of a structure, as plain data: modes with names, channels and covariance. Readers are in records.
namespace twindeck::matching {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  ///< a number that a file leaves empty
/// Empty for kUnknown, as a file has it.
[[nodiscard]] inline std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

/// A measuring channel of channels.csv: its position and direction.
struct Channel {
  std::string name;
  std::string point;                                    ///< "" where channels.csv gives none
  std::optional<Eigen::Vector3d> x_m;                   ///< position, where it is known
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< direction cosines dx dy dz, unit length; axis of a rotation
  std::string element;  ///< of a strain gauge: name or number in elements.csv; "" for no such gauge
  double xi = 0.5;      ///< its place, as a part of the element's length from the first end
  Eigen::Vector2d fibre_m = Eigen::Vector2d::Zero();  ///< its local y and z in the section
  std::string support;  ///< of a force gauge: the support that it stands under; "" for no such gauge
  long line = 0;        ///< of channels.csv
  [[nodiscard]] bool is_at_a_point() const { return element.empty() && support.empty(); }
};

/// A measured frequency or component of a shape, as a row of a covariance.
struct MeasuredRow {
  Eigen::Index mode = 0;   ///< position in Measured::modes
  Eigen::Index dof = -1;   ///< row of the shapes; -1 for the frequency
  bool imaginary = false;  ///< of a component
  double value = 0.0;      ///< [Hz] or [-]
};

/// Measured modes with their names and channels.
struct Measured {
  modal::ModeSet modes;             ///< direction of a shape's dof: x … rz, or the name of a channel
  std::vector<std::string> labels;  ///< (n_modes) "7X"
  std::vector<Channel> channels;    ///< empty without channels.csv
  std::string source;               ///< folder, for messages
  std::vector<MeasuredRow> rows;    ///< all values with a standard deviation: frequencies, and shapes of a features folder
  Eigen::MatrixXd covariance;       ///< (n_rows × n_rows) from covariance.npy, else the squared deviations on the diagonal
};

}  // namespace twindeck::matching
