#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace twindeck::blind::form {

/// Random numbers of one trial: the same on every machine for one seed, whatever the number of threads.
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : random_(seed * 6364136223846793005ULL + 1442695040888963407ULL) { random_.discard(20); }
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform())), angle = 2.0 * std::numbers::pi * uniform();
    return radius * std::cos(angle);
  }
  bool chance(double probability) { return uniform() < probability; }
  int below(int n) { return static_cast<int>(uniform() * n) % n; }

 private:
  std::mt19937_64 random_;
};

}  // namespace twindeck::blind::form
