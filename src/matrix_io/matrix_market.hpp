#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include "linalg/sparse.hpp"

namespace twindeck::matrix_io {

/// Symmetric matrices in Matrix Market coordinate form (Boisvert, Pozo and Remington 1996, NISTIR 5935).
///
/// Reads `matrix coordinate real|integer symmetric|general`. A general matrix must be symmetric in its numbers, to 1e-9 of
/// the larger of |a_ij| and sqrt(|a_ii a_jj|); the mean of the two entries is taken.
/// @return lower triangle (n × n)
/// @throws InputError with file and line for another kind of matrix, a bad or missing entry, an index outside the matrix,
///         an entry that stands twice, a symmetric file with entries above the diagonal, a general one that is not symmetric,
///         a size line that asks for more entries than the file has room for
[[nodiscard]] linalg::SparseMatrix read_matrix_market(const std::filesystem::path& file);

/// Called for an entry and its mirror that differ: throws.
using RefuseUnsymmetric = std::function<void(const std::pair<long, long>& at, double value, double mirrored)>;
/// Lower triangle of a matrix whose numbers are symmetric to 1e-9 as above: the mean of each two entries.
/// @param entries   by place (from 0)
/// @param triangle  only one triangle is given, and stands for both
[[nodiscard]] linalg::SparseMatrix symmetric_lower(const std::map<std::pair<long, long>, double>& entries, long n,
                                                   bool triangle, const RefuseUnsymmetric& refuse);

/// Rows of the square matrix in a file, and the line that says so: to be compared with what is expected before the matrix is
/// read, since a matrix of few entries may have any number of rows and takes memory for each.
struct MatrixMarketSize {
  Eigen::Index rows = 0;
  long line = 0;
};
/// @throws InputError as above
[[nodiscard]] MatrixMarketSize matrix_market_size(const std::filesystem::path& file);

/// Writes the lower triangle as `coordinate real symmetric` with 17 digits: what is read back is the same to the last bit.
/// Entries that are exactly zero are left out.
/// @param lower  lower triangle (n × n)
void write_matrix_market(const linalg::SparseMatrix& lower, const std::filesystem::path& file);

/// Writes a matrix of which both triangles are stored: as its lower triangle where it is symmetric to the last bit, else
/// `general`. 17 digits, no zeros.
void write_full_matrix_market(const linalg::SparseMatrix& full, const std::filesystem::path& file);

/// A small square matrix that need not be symmetric, for an element given by its matrices. Reads the same kinds; a symmetric
/// file is completed.
/// @return (n × n)
/// @throws InputError as above, but for the symmetry of a general file
[[nodiscard]] Eigen::MatrixXd read_square_matrix(const std::filesystem::path& file);
/// Writes `coordinate real general` with 17 digits.
void write_square_matrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix, const std::filesystem::path& file);

}  // namespace twindeck::matrix_io
