#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace twindeck::records {

/// Reads covariance.npy of a features folder: one row and column for each row of rows.csv, in its order and units.
/// @param n_rows  rows of rows.csv
/// @return (n_rows × n_rows), symmetric to the last bit
/// @throws InputError  naming the row of rows.csv: another size, an entry that is not finite, a variance that is not positive,
///         two entries that differ across the diagonal by more than 1e-9 of sqrt(c_ii c_jj), a matrix that is not positive
///         definite
[[nodiscard]] Eigen::MatrixXd read_covariance(const std::filesystem::path& file, Eigen::Index n_rows);

}  // namespace twindeck::records
