#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>

namespace twindeck::io {

/// A part of an array: its first row and column, and its values.
using BlockVisitor = std::function<void(Eigen::Index first_row, Eigen::Index first_column, const Eigen::MatrixXd& block)>;

/// Rows and columns of an NPY file. @throws InputError  as read_npy
[[nodiscard]] std::pair<Eigen::Index, Eigen::Index> shape_of_npy(const std::filesystem::path& file);

/// Walks through an NPY file in parts of about one megabyte: whole rows in C order, pieces of columns in Fortran order. Types
/// as in read_npy. @return rows and columns
/// @throws InputError  as read_npy
std::pair<Eigen::Index, Eigen::Index> visit_npy(const std::filesystem::path& file, const BlockVisitor& visit);

/// Reads an array of NumPy's NPY format, versions 1 to 3: float64, float32, int16 or int32, little-endian, one or two
/// dimensions beside those of one, C or Fortran order. A one-dimensional array becomes a single column. Values may be NaN.
/// Memory: the matrix and one megabyte.
/// @return (rows × columns) as NumPy's shape has them
/// @throws InputError  for a missing or truncated file, another type, endianness or number of dimensions
/// Reference: NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays".
[[nodiscard]] Eigen::MatrixXd read_npy(const std::filesystem::path& file);

/// Writes an array in C order and single precision, NPY version 1: half the size, for records, whose converters have fewer
/// digits than that.
void write_npy_single(const Eigen::Ref<const Eigen::MatrixXd>& array, const std::filesystem::path& file);

}  // namespace twindeck::io
