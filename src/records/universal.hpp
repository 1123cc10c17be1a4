#pragma once

#include <Eigen/Core>
#include <complex>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// A mode shape or other result at nodes (set 55).
struct NodalResult {
  std::string title;  ///< first line of text
  int analysis = 2;   ///< 2 normal mode, 3 complex mode
  int mode = 0;
  double frequency_Hz = 0.0;
  std::complex<double> eigenvalue;  ///< analysis 3
  double damping_ratio = 0.0;
  bool complex = false;
  std::map<long, Eigen::VectorXcd> values;  ///< by node, 3 or 6 components
};

/// What universal files hold beside time series.
struct UniversalData {
  std::string title;                           ///< set 151
  bool has_header = false, has_units = false;  ///< sets 151, 164
  double length_factor = 1.0;                  ///< set 164: file lengths are metres times this
  std::map<long, Eigen::Vector3d> nodes;       ///< sets 15, 2411 [m]
  std::vector<std::vector<long>> lines;        ///< set 82: chains of nodes
  std::vector<NodalResult> results;            ///< set 55
  std::map<std::string, int> others;           ///< sets that are not read, by number
};

/// Reads a universal file: sets 15, 55, 58, 58b, 82, 151, 164, 2411. Accepts what programs get wrong: a newline too many before
/// or after binary data, a byte count that is not that of the values, Fortran's D exponents, numbers that touch, sets 151 and
/// 164 left out, lines cut short. @param visit  gets the samples of sets 58 of time, a channel a set
/// @throws InputError  with file and line for a file that breaks off or a field that is no number
/// Reference: University of Cincinnati, Structural Dynamics Research Laboratory, "Universal File Datasets Summary".
UniversalData scan_universal_sets(const std::filesystem::path& file, const Visitor& visit, RecordInfo& info);

/// Writes sets 151, 164 (SI), 2411, 82 and a set 55 a result, in text.
void write_universal(const UniversalData& data, const std::filesystem::path& file);

/// A time series as set 58 (text) or 58b (binary, little-endian): one channel after another.
/// @param samples (n_samples × n_channels)
void write_universal_series(const RecordInfo& info, const Eigen::MatrixXd& samples, bool binary,
                            const std::filesystem::path& file);

}  // namespace twindeck::records
