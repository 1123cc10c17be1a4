#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "modal/modes.hpp"
#include "steps/shared/run_step.hpp"
#include "steps/shared/unit_slips.hpp"

namespace twindeck::steps {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  ///< a number that a file leaves empty

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
  std::vector<MeasuredRow> rows;    ///< whatever has a standard deviation: frequencies, and shapes of a features folder
  Eigen::MatrixXd covariance;       ///< (n_rows × n_rows) of covariance.npy, else the squared deviations
};

struct MeasuredChoice;

/// Reads the modes of one condition out of a features folder (docs/my_records.md): rows.csv, conditions.toml and, where there
/// are shapes, channels.csv. Modes come in ascending frequency; held-out rows are not read.
/// @param choice  which condition (choose_condition), and the corrections to apply (corrections.hpp)
/// @throws InputError  with file, line, column: an unknown type, condition, state or channel, a row without a standard
/// deviation, a mode
///                     without a frequency, a mode without a shape where others have one. Channels that one mode lacks are NaN
///                     there
[[nodiscard]] Measured read_measured_features(const std::filesystem::path& folder, const MeasuredChoice& choice);

/// Reads modes.csv, and shapes.csv and channels.csv if they exist, from a folder (`--modes DIR`).
/// @throws InputError  as above
[[nodiscard]] Measured read_measured_modes(const std::filesystem::path& folder, const MeasuredChoice& choice);

/// The measured modes that a step works with: `--modes DIR`, else `--features DIR`, else the study's features, registered as
/// inputs. Empty if none of the three exists.
/// @param condition  of the step's configuration; --condition takes precedence
[[nodiscard]] std::optional<Measured> find_measured(StepContext& context, const std::string& condition);

/// Input of warn_of_unit_slips for a step that compares with one condition.
[[nodiscard]] std::vector<MeasuredFrequencies> frequencies_of(const std::optional<Measured>& measured);

}  // namespace twindeck::steps
