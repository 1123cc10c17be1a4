#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "records/record_clock.hpp"

/// Records of vibration in the formats that loggers and analysis programs write. The format is told from the content, not from
/// the name.
namespace twindeck::records {

/// What a file says of a channel; empty or 0 where it says nothing.
struct ChannelInfo {
  std::string name;
  std::vector<std::string> other_names;  ///< that also identify it uniquely
  std::string unit;                      ///< as written there
  std::string point;                     ///< node of a universal file
  std::string direction;                 ///< "+x" … of a universal file
  double rate_Hz = 0.0;                  ///< where it may differ between channels
  double start = 0.0;                    ///< [samples] on the clock of a universal file
  Eigen::Index samples = 0;
  Eigen::Index position = 0;   ///< position of its column or series in the file, from 1, with time columns counted
  Eigen::Index row_group = 0;  ///< channels of different groups never have values in one row of a text file
};

/// [standard deviations] Rates that differ from the rate of the time stamps by more are different rates.
constexpr double kDeviationsOfARate = 3.0;
/// [-] Rates that differ by less count as equal: the bias of a frequency is then below what hours of records resolve.
constexpr double kSameRate = 1e-3;

/// Everything but the samples.
struct RecordInfo {
  std::string format;  ///< for people: "CSV, separated by ';', decimal comma, latin-1"
  std::vector<ChannelInfo> channels;
  double rate_Hz = 0.0;                              ///< 0 if it is unknown or differs between channels
  std::string rate_source;                           ///< where the rate comes from
  RecordClock clock;                                 ///< clock from the time stamps, if the file has any
  bool clock_unit_known = true;                      ///< false if the unit of the stamps was guessed
  std::vector<std::pair<Eigen::Index, long>> lines;  ///< text files: row and line, where their difference changes
  std::vector<std::string> notes;                    ///< oddities, how they were read, and missing data
  std::vector<ChannelInfo>
      response_points;          ///< of a universal file with frequency response functions: see frequency_responses.hpp
  std::string functions;        ///< what they are, for people; empty for none
  bool apart = false;           ///< the channels are of several row groups, so that the clock is that of none
  bool names_channels = false;  ///< the file names its channels itself; otherwise they are called "column 3"
  bool has_header = true;       ///< the format has a place for names, so that missing names are reported
  std::vector<std::string>
      unaligned_header;     ///< cells of a header line of a text file whose number differs from that of the rows
  long unaligned_line = 0;  ///< that line
};

/// Whether a file begins as universal files do, with a line -1. @throws InputError  for a pipe, or a file that cannot be read
[[nodiscard]] bool is_universal_file(const std::filesystem::path& file);

/// How a file is to be read.
struct ReadOptions {
  /// Text files: a line below the header that is no row of numbers is left out and counted in a note, instead of refused.
  bool skip_stray_lines = false;
  /// Text files: positions in RecordInfo::channels. Rows in which none of these has a value are left out, with their times.
  std::vector<Eigen::Index> rows_of = {};
};

/// Called with parts of the record in the order of the file: first sample, first channel, values (samples × channels).
using Visitor = std::function<void(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block)>;

/// Walks through a file in bounded memory (some megabytes, whatever its size). Sizes that a header states are checked before
/// use, against the length of the file and, for compressed data, against the largest possible compression. Missing values
/// (empty cells) are NaN; rows are given as the file has them, and gaps of the clock are listed in RecordInfo::clock. A column
/// of time is no channel. Memory beside that: sixteen bytes a time stamp. Formats: CSV and its kin, NPY, MAT 4, 5 and 7.3,
/// HDF5, universal files with sets 58 and 58b.
/// @throws InputError  with file and line: an unknown format, no numbers, a file that breaks off, a line below the header that
///         is no row of numbers (see ReadOptions), a pipe or device
RecordInfo scan(const std::filesystem::path& file, const Visitor& visit, const ReadOptions& options = {});

/// A whole record, on its clock: gaps are rows of NaN, repeated rows appear once (on_the_clock).
struct Record {
  RecordInfo info;
  Eigen::MatrixXd samples;  ///< (n_samples × n_channels); NaN beyond the end of shorter channels
};
[[nodiscard]] Record read(const std::filesystem::path& file, const ReadOptions& options = {});

/// Some columns of a file that has been scanned. Memory: samples × chosen columns, however wide the file; see Samples.
/// @param columns  positions in RecordInfo::channels, ascending or not @param n_samples  number of rows that `scan` found
/// @return (n_samples with gaps × n_chosen) in the order asked for; NaN beyond the end of shorter channels
[[nodiscard]] Samples read(const std::filesystem::path& file, const std::vector<Eigen::Index>& columns, Eigen::Index n_samples,
                           const ReadOptions& options = {});

/// NPY, with the contract of `scan`.
RecordInfo scan_npy(const std::filesystem::path& file, const Visitor& visit);

}  // namespace twindeck::records
