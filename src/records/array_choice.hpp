#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// An array of numbers in a file of named arrays (MAT, HDF5).
struct NamedArray {
  std::string name;
  Eigen::Index rows = 0, columns = 0;
  [[nodiscard]] Eigen::Index longer() const { return std::max(rows, columns); }
  [[nodiscard]] Eigen::Index shorter() const { return std::min(rows, columns); }
};

/// Which arrays are the record.
struct ArrayChoice {
  std::vector<std::size_t> data;      ///< one matrix, or several vectors of one length
  bool transposed = false;            ///< channels × samples
  int time = -1;                      ///< vector of times
  std::vector<std::size_t> scalars;   ///< single numbers, that may say the rate
  std::vector<std::size_t> left_out;  ///< further matrices of as many samples
};

/// The largest matrix is the record, its longer side the samples; vectors of one length are channels of their own. A vector of
/// that length that is named t or time is the time.
/// @param others  what the file holds besides, "'acc' has 3 dimensions", for the message
/// @throws InputError  if no array has sixteen values or more
[[nodiscard]] ArrayChoice choose_arrays(const std::vector<NamedArray>& arrays, const std::vector<std::string>& others,
                                        const std::string& file);

/// The channels of the chosen arrays, and notes on further matrices.
void list_channels(const std::vector<NamedArray>& arrays, const ArrayChoice& choice, RecordInfo& info);

/// Names the channels by the texts of a cell array, if there is one for each; columns of time may have theirs.
/// @param columns  of the matrix
void name_channels(const std::vector<std::string>& texts, Eigen::Index columns, RecordInfo& info);

/// Rate [Hz] by a scalar's name (fs, rate, sampling frequency …, dt, ts, dt_ms …) and value; 0 for other names. Of a step whose
/// name has no unit, the unit that gives 1 to 100,000 Hz counts.
[[nodiscard]] double rate_of(const std::string& name, double value);

/// Enters what the vector of times says, in the unit at the end of its name ("time_ms") if it has one, and what scalars say.
/// @param values_of  an array's values, NaN where they cannot be had
void read_rates(const std::vector<NamedArray>& arrays, const ArrayChoice& choice,
                const std::function<Eigen::VectorXd(std::size_t)>& values_of, RecordInfo& info);

}  // namespace twindeck::records
