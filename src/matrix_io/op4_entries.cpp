#include "matrix_io/op4_entries.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "matrix_io/matrix_market.hpp"

namespace twindeck::matrix_io {

linalg::SparseMatrix Op4Entries::assembled(const std::string& file) const {
  bool below = false, above = false;
  for (const auto& [place, value] : at) {
    below = below || place.second > place.first;
    above = above || place.second < place.first;
  }
  const bool triangle = form == 6 && !(below && above);
  return symmetric_lower(at, rows, triangle, [&](const std::pair<long, long>& place, double value, double mirrored) {
    throw InputError({file, 0, ""},
                     fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}", place.second + 1,
                                 place.first + 1, value, mirrored),
                     "stiffness and mass matrices must be symmetric");
  });
}

}  // namespace twindeck::matrix_io
