#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Records of vibration in the formats that loggers and analysis programs write. The format is told from the content, not from
/// the name.
namespace twindeck::records {

/// What a file says of a channel; empty or 0 where it says nothing.
struct ChannelInfo {
  std::string name;
  std::string unit;       ///< as written there
  std::string point;      ///< node of a universal file
  std::string direction;  ///< "+x" … of a universal file
  double rate_Hz = 0.0;   ///< where it may differ between channels
  Eigen::Index samples = 0;
};

/// Everything but the samples.
struct RecordInfo {
  std::string format;  ///< for people: "CSV, separated by ';', decimal comma, latin-1"
  std::vector<ChannelInfo> channels;
  double rate_Hz = 0.0;            ///< 0 where it is not known or not one
  std::string rate_source;         ///< where the rate comes from
  std::vector<std::string> notes;  ///< what was odd and how it was read; what is missing
};

/// Called with parts of the record in the order of the file: first sample, first channel, values (samples × channels).
using Visitor = std::function<void(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block)>;

/// Walks through a file in bounded memory (some megabytes, whatever its size; MAT and HDF5 one variable's part at a time).
/// Missing samples (empty cells, gaps in the time stamps) are NaN.
/// Formats: CSV and its kin, NPY, MAT 5 and 7.3, HDF5, universal files with sets 58 and 58b.
/// @throws InputError  with file and line: an unknown format, no numbers, a file that breaks off
RecordInfo scan(const std::filesystem::path& file, const Visitor& visit);

/// A whole record.
struct Record {
  RecordInfo info;
  Eigen::MatrixXd samples;  ///< (n_samples × n_channels); NaN beyond the end of shorter channels
};
[[nodiscard]] Record read(const std::filesystem::path& file);

/// Some columns of it. Memory: samples × chosen columns, however wide the file.
/// @param columns  positions in the file, ascending or not @return samples (n_samples × n_chosen) in the order asked for;
/// `info` of all
[[nodiscard]] Record read(const std::filesystem::path& file, const std::vector<Eigen::Index>& columns);

// The formats, each with the same contract as `scan`.
RecordInfo scan_text(const std::filesystem::path& file, const Visitor& visit);
RecordInfo scan_npy(const std::filesystem::path& file, const Visitor& visit);
RecordInfo scan_mat(const std::filesystem::path& file, const Visitor& visit);
RecordInfo scan_hdf5(const std::filesystem::path& file, const Visitor& visit);
RecordInfo scan_universal(const std::filesystem::path& file, const Visitor& visit);

}  // namespace twindeck::records
