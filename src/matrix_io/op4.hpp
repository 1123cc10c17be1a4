#pragma once

#include <filesystem>

#include "linalg/sparse.hpp"

namespace twindeck::matrix_io {

/// Symmetric matrices that Nastran writes by OUTPUT4, formatted or binary: dense columns, strings of nonzeros, and BIGMAT.
///
/// The file holds one square real matrix (types 1 and 2). Both triangles are there as Nastran writes them, or one of a matrix
/// of form 6. Of both, the mean is taken; they must agree to 1e-9 of the larger of |a_ij| and sqrt(|a_ii a_jj|).
/// @return lower triangle (n × n)
/// @throws InputError with file and line (or byte) for a complex or rectangular matrix, a second matrix in the file,
///         a damaged record, an index outside the matrix, an entry that stands twice, a matrix that is not symmetric
[[nodiscard]] linalg::SparseMatrix read_op4(const std::filesystem::path& file);

/// Rows of the matrix by its header alone. @throws InputError as above
[[nodiscard]] Eigen::Index op4_rows(const std::filesystem::path& file);

/// Whether a file is OUTPUT4 by its ending, .op4.
[[nodiscard]] bool is_op4(const std::filesystem::path& file);

}  // namespace twindeck::matrix_io
