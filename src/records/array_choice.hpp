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
  std::vector<std::size_t> scalars;   ///< single numbers; one of them may be the rate
  std::vector<std::size_t> left_out;  ///< further matrices of as many samples

  [[nodiscard]] bool is_matrix() const { return data.size() == 1; }
  [[nodiscard]] Eigen::Index channels(const std::vector<NamedArray>& arrays) const {
    return is_matrix() ? arrays[data.front()].shorter() : std::ssize(data);
  }
};

/// Chooses the record in a file of arrays. The largest matrix is the record; samples run along its longer side. Without a
/// matrix, vectors of one length are the channels. A vector of that length named t or time is the time.
/// @param others  other content of the file, "'acc' has 3 dimensions", for the message
/// @throws InputError  if no array has sixteen values or more
[[nodiscard]] ArrayChoice choose_arrays(const std::vector<NamedArray>& arrays, const std::vector<std::string>& others,
                                        const std::string& file);

/// The channels of the chosen arrays, and notes on further matrices.
void list_channels(const std::vector<NamedArray>& arrays, const ArrayChoice& choice, RecordInfo& info);

/// Names the channels by the texts of a cell array, if there is one for each; columns of time may have theirs.
/// @param columns  of the matrix
void name_channels(const std::vector<std::string>& texts, Eigen::Index columns, RecordInfo& info);

/// Rate [Hz] by a scalar's name (fs, rate, sampling frequency …, dt, ts, dt_ms …) and value; 0 for other names. If the name of
/// a time step has no unit, the unit is the one that gives 1 to 100,000 Hz.
[[nodiscard]] double rate_of(const std::string& name, double value);

/// Enters the rate from the vector of times and from the scalars. The unit of the times is the ending of their name
/// ("time_ms"), if there is one.
/// @param values_of  values of an array, NaN if they cannot be read
void read_rates(const std::vector<NamedArray>& arrays, const ArrayChoice& choice,
                const std::function<Eigen::VectorXd(std::size_t)>& values_of, RecordInfo& info);

}  // namespace twindeck::records
