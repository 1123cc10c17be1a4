#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Measured features as the diagnosis takes them: every row of rows.csv with its condition (docs/my_records.md), nothing
/// computed.
namespace twindeck::diagnosis {

enum class RowType {
  frequency,
  damping,
  shape,
  shape_imag,
  stay_frequency,
  rms,
  psd_floor,
  static_displacement,
  static_rotation,
  static_strain,
  static_force
};

/// Whether a row is of a load test.
[[nodiscard]] constexpr bool is_static(RowType type) {
  return type == RowType::static_displacement || type == RowType::static_rotation || type == RowType::static_strain ||
         type == RowType::static_force;
}
/// Whether a row is compared in ln: all but components of shapes and rows of load tests, which may have either sign.
[[nodiscard]] constexpr bool is_logarithmic(RowType type) {
  return type != RowType::shape && type != RowType::shape_imag && !is_static(type);
}

/// Circumstances of a row's measurement; unknown ones are empty.
struct Condition {
  std::string name;
  std::string state = "reference";  ///< of the structure as it was then: conditions of one state share the structure
  std::optional<bool> dampers_on;
  std::optional<double> amplitude_m;  ///< RMS displacement at `amplitude_channel`
  std::string amplitude_channel;
  std::optional<double> temperature_C, wind_m_s, direction_deg, people;
  long line = 0;          ///< of conditions.toml: the order of the file
  std::string load = {};  ///< load case of a load test
};

/// A number of the measurement. Frequencies in Hz, damping ratios in per cent, the rest in SI units.
struct Row {
  RowType type = RowType::frequency;
  std::string mode;    ///< as in rows.csv; the harmonic of a stay frequency
  int channel = -1;    ///< position in FeatureSet::channels
  std::string stay;    ///< of a stay frequency, else empty
  int condition = -1;  ///< position in FeatureSet::conditions
  double value = 0.0, std = 0.0;
  bool held_out = false;
  long line = 0;  ///< of rows.csv, for messages
};

struct FeatureSet {
  std::vector<Row> rows;
  std::vector<Condition> conditions;
  std::vector<std::string> channels;             ///< names, in the order of channels.csv
  std::vector<Eigen::Vector3d> direction;        ///< (n_channels) direction cosines, zero where unknown
  Eigen::MatrixXd covariance;                    ///< (n_rows × n_rows) instead of std, or empty
  std::map<std::string, double> clipped, drift;  ///< by channel: share of samples, slope in rms (quality.csv)
  /// Condition of a row, or of a measured mode.
  template <typename Measured>
  [[nodiscard]] const Condition& condition_of(const Measured& of) const {
    return conditions[static_cast<std::size_t>(of.condition)];
  }
};

/// Divides the rows into training and held-out ones. If no row is marked, these are held out: the largest of three or more
/// amplitudes, the highest of three or more temperatures, the fastest of three or more winds, and the highest mode of each
/// condition with four or more modes.
void hold_out_by_rule(FeatureSet& features);

/// States of the structure in the rows. The first is the one that the others are compared with: "reference", or else the first
/// of the file. There is one name if the structure never changed.
[[nodiscard]] std::vector<std::string> states_of(const FeatureSet& features);

/// The last of these states, which is the one to repair.
[[nodiscard]] std::string last_state(const FeatureSet& features);

/// "frequency_Hz" and so on, as in rows.csv.
[[nodiscard]] const std::vector<std::string>& row_type_names();
[[nodiscard]] std::string name_of(RowType type);

}  // namespace twindeck::diagnosis
