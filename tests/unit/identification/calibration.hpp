#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "chain.hpp"
#include "identification/identify.hpp"

namespace twindeck::identification::test {

/// Errors of a chain's modes over their standard deviations, pooled over seeds and modes: of unit deviation where sigmas are
/// right.
class NormalisedErrors {
 public:
  void add(const Identification& found, const Chain& chain, double zeta) {
    for (int r = 0; r < chain.size(); ++r, ++count_) {
      const auto m = static_cast<std::size_t>(r);
      frequency_ += std::pow((found.modes[m].frequency_Hz - chain.frequency_Hz(r)) / found.deviations[m].frequency_Hz, 2);
      damping_ += std::pow((found.modes[m].damping_ratio - zeta) / found.deviations[m].damping_ratio, 2);
    }
  }
  void expect_between(double low, double high) const {
    const double frequency = std::sqrt(frequency_ / count_), damping = std::sqrt(damping_ / count_);
    std::printf("normalised deviation: frequency %.3f, damping %.3f\n", frequency, damping);
    EXPECT_GT(frequency, low);
    EXPECT_LT(frequency, high);
    EXPECT_GT(damping, low);
    EXPECT_LT(damping, high);
  }

 private:
  double frequency_ = 0.0, damping_ = 0.0;
  int count_ = 0;
};

}  // namespace twindeck::identification::test
