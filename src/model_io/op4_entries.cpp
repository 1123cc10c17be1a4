#include "model_io/op4_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace twindeck::model_io {

linalg::SparseMatrix Op4Entries::assembled(const std::string& file) const {
  constexpr double most_unsymmetric = 1e-9;  ///< [-] as of Matrix Market files
  bool below = false, above = false;
  std::vector<double> diagonal(static_cast<std::size_t>(rows), 0.0);
  for (const auto& [place, value] : at) {
    below = below || place.second > place.first;
    above = above || place.second < place.first;
    if (place.first == place.second) diagonal[static_cast<std::size_t>(place.first) - 1] = value;
  }
  const bool triangle = form == 6 && !(below && above);
  std::vector<Eigen::Triplet<double, int>> lower;
  for (const auto& [place, value] : at) {
    const auto [column, row] = place;
    const auto mirrored = at.find({row, column});
    const double other = triangle ? value : mirrored == at.end() ? 0.0 : mirrored->second;
    const double scale = std::max(
        {std::abs(value), std::abs(other),
         std::sqrt(std::abs(diagonal[static_cast<std::size_t>(row) - 1] * diagonal[static_cast<std::size_t>(column) - 1]))});
    if (std::abs(value - other) > most_unsymmetric * scale)
      throw InputError(
          {file, 0, ""},
          fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}", row, column, value, other),
          "stiffness and mass matrices must be symmetric");
    const bool alone = triangle || mirrored == at.end();
    if (row >= column || alone)
      lower.emplace_back(static_cast<int>(std::max(row, column)) - 1, static_cast<int>(std::min(row, column)) - 1,
                         0.5 * (value + other));
  }
  linalg::SparseMatrix matrix(static_cast<int>(rows), static_cast<int>(rows));
  matrix.setFromTriplets(lower.begin(), lower.end());
  return matrix;
}

}  // namespace twindeck::model_io
