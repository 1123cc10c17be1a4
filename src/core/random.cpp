#include "core/random.hpp"

#include <cmath>
#include <numbers>

namespace twindeck {

double normal_number(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  const double u1 = 1.0 - uniform_number(seed, stream, 2 * index);
  const double u2 = uniform_number(seed, stream, 2 * index + 1);
  return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
}

}  // namespace twindeck
