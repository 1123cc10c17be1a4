#pragma once

#include <filesystem>

#include "linalg/sparse.hpp"

/// Inside of the library: binary files of OUTPUT4.
///
/// They are Fortran's unformatted records, each between two lengths of four bytes. The first holds NCOL, NROW, form, type and
/// the name; its length of 24 or 48 bytes tells whether words have four or eight bytes, and in which order the bytes stand.
/// Every further record is a column: its number, the first row (0: strings of nonzeros), the count of words, the words. Numbers
/// of type 1 have a word, those of type 2 eight bytes. A string begins with one word, row + 65536 (words + 1), or with two in
/// BIGMAT (NROW below 0), words + 1 and row. The last record has the number of a column behind the last.
/// Source: NX Nastran User's Guide, "OUTPUT4 binary files"; as of formatted files otherwise (op4.hpp).
namespace twindeck::matrix_io {

/// Whether the file begins with a record of 24 or 48 bytes. False for a file that cannot be read.
[[nodiscard]] bool is_binary_op4(const std::filesystem::path& file);
/// @throws InputError  with the file and the byte, for what read_op4 refuses in formatted files
[[nodiscard]] linalg::SparseMatrix read_binary_op4(const std::filesystem::path& file);
/// Rows of the matrix by its header alone. @throws InputError as above
[[nodiscard]] Eigen::Index binary_op4_rows(const std::filesystem::path& file);

}  // namespace twindeck::matrix_io
