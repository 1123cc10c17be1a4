#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "records/array_choice.hpp"

/// MATLAB's files of versions 4 and 5, read without a library: sizes are checked before they are used, and data are walked
/// through in parts (docs/decisions/0012-mat-files-read-without-a-library.md). Version 7.3 is HDF5. Reference: The MathWorks,
/// "MAT-File Format", R2022b: Level 5 and Level 4 MAT-file format.
namespace twindeck::records {

/// An array of real numbers in the file, and where its values lie.
struct MatArray {
  NamedArray shape;                      ///< "field" of a structure "run": name "run.field"
  int storage = 0;                       ///< code of the numbers' type in the file: 1 int8 … 9 double, 12 int64, 13 uint64
  std::uint64_t offset = 0, length = 0;  ///< the variable's part of the file [bytes]
  bool compressed = false;
  std::uint64_t data = 0;  ///< begin of the values in that part, inflated [bytes]
  bool alone = false;      ///< the variable holds nothing else, so that reading it to its end costs nothing
};

struct MatFile {
  std::filesystem::path file;
  int version = 5;
  bool swapped = false;  ///< byte order other than that of this machine
  std::vector<MatArray> arrays;
  std::vector<std::vector<std::string>> texts;  ///< of each cell array that holds texts only
  std::vector<std::string> notes;               ///< arrays that are left out, and why: "'acc' is complex"
};

/// First bytes of a file of that version.
[[nodiscard]] bool is_mat_4(std::string_view beginning);
[[nodiscard]] bool is_mat_5(std::string_view beginning);

/// Which arrays there are: variables, and fields of single structures.
/// @throws InputError  for a file that breaks off, an array that is larger than its data, damaged compressed data
[[nodiscard]] MatFile read_mat_contents(const std::filesystem::path& file);

/// Values of an array column after column, `n` at a time at most.
using ValueVisitor = std::function<void(Eigen::Index first, const Eigen::VectorXd& values)>;
void visit_values(const MatFile& mat, const MatArray& array, Eigen::Index n, const ValueVisitor& visit);
/// All values of a small array (a scalar, a vector of times).
[[nodiscard]] Eigen::VectorXd values_of(const MatFile& mat, const MatArray& array);

}  // namespace twindeck::records
