#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "records/measured_tables.hpp"

namespace twindeck::records {

/// A number of rows.csv (docs/my_records.md), in the units of its type.
struct FeatureRow {
  std::string type;  ///< one of `feature_types`
  std::string mode;  ///< name of the mode; of a stay frequency its harmonic
  std::string channel, condition;
  double value = 0.0;
  double std = 0.0;  ///< of the column, or the root of the covariance's diagonal
  bool held_out = false;
  long line = 0;  ///< of rows.csv

  [[nodiscard]] bool is_shape() const { return type == "shape" || type == "shape_imag"; }
  [[nodiscard]] bool is_static() const { return type.starts_with("static_"); }
  [[nodiscard]] bool is_modal() const { return is_shape() || type == "frequency_Hz" || type == "damping_ratio_pct"; }
};

/// The row types of the format.
[[nodiscard]] const std::vector<std::string>& feature_types();

struct FeatureRows {
  io::CsvTable table;            ///< rows.csv itself, for messages that name a line
  std::vector<FeatureRow> rows;  ///< in the order of the file
  Eigen::MatrixXd covariance;    ///< (n_rows × n_rows) of covariance.npy; empty without one
};

/// Reads rows.csv of a features folder, and covariance.npy if it exists. All steps use this reader.
/// @param conditions  of conditions.toml
/// @param channels    of channels.csv
/// @throws InputError  with file, line and column: an unknown type, condition or channel; a row without a standard deviation; a
///         value that its type cannot have; a mode number that is not a whole number from 1; `held_out` other than 0 and 1; two
///         rows of one quantity; a row of a load test without a load, or of a channel that cannot show it; a mode whose shape
///         is zero everywhere; an invalid covariance (read_covariance)
[[nodiscard]] FeatureRows read_feature_rows(const std::filesystem::path& folder,
                                            const std::vector<MeasuredCondition>& conditions,
                                            const std::vector<matching::Channel>& channels);

/// Reads covariance.npy of a features folder: one row and column for each row of rows.csv, in its order and units.
/// @param n_rows  rows of rows.csv
/// @return (n_rows × n_rows), symmetric to the last bit
/// @throws InputError  naming the row of rows.csv: another size, an entry that is not finite, a variance that is not positive,
/// two entries that differ across the diagonal by more than 1e-9 of sqrt(c_ii c_jj), a matrix that is not positive definite
[[nodiscard]] Eigen::MatrixXd read_covariance(const std::filesystem::path& file, Eigen::Index n_rows);

}  // namespace twindeck::records
