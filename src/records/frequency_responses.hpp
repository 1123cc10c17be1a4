#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "records/campaign.hpp"
#include "records/record.hpp"
#include "records/universal.hpp"

/// Frequency response functions of a hammer or shaker test: universal files of sets 58 of function type 4, motion over force.
namespace twindeck::records {

/// The frequency response functions of one setup. The points of a shape are the side of the test with more points. These are
/// the responses, or with a roving hammer the points of the hammer. By reciprocity H_ij = H_ji a shape is the same on both
/// sides.
struct FrequencyResponses {
  Eigen::VectorXd frequency_Hz;       ///< (n_lines) ascending, above 0; empty for a setup of time series
  std::vector<std::string> channels;  ///< (n_channels) names in channels.csv of the points of the shape
  std::vector<std::string> others;    ///< (n_others) node and direction of the other side: "1+z"
  /// (n_lines × n_channels n_others) column channel · n_others + other: `quantity` over force, gains applied
  Eigen::MatrixXcd values;
  std::string quantity;            ///< of the motion: acceleration, velocity or displacement
  std::vector<std::string> notes;  ///< for people
};

/// Reads the records of one setup, of one file or of many (a file for each point).
/// @param group  records of kind "frf"; their `channels` are the points of the shape (see above), found by node and direction
/// @throws InputError  with file and line: time series or other functions beside them (coherence is left out with a note), real
///         values, no reference node, another abscissa than Hz or than that of the first function, no motion over force, a
///         quantity that contradicts channels.csv, a function twice or missing, a value that is no number
/// Reference: University of Cincinnati, "Universal File Datasets Summary", set 58.
[[nodiscard]] FrequencyResponses read_frequency_responses(const Campaign& campaign, const RecordGroup& group);

/// Tells in `info` what frequency response functions a file holds: response_points are the points of a shape.
/// @param functions  of the file; without any frequency response function only a note is added
void list_response_points(const std::vector<UniversalFunction>& functions, RecordInfo& info);

}  // namespace twindeck::records
