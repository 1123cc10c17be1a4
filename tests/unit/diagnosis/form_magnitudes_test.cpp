// Magnitudes of the screen. Oracles: e^-0.69 is a factor of a half, whose tenth in ln is 0.933; a tenth of 20 kg is 2 kg.
#include "diagnosis/form_magnitudes.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

TEST(FormMagnitudes, AFactorScalesInItsLogarithmAndAMassByItself) {
  const Chain chain({.masses = 10, .modes = 5});
  const Examined e = examine(chain, chain.measure(chain.as_modelled()), catalogue({"stiffness", "mass", "swap", "osc"}));
  const diagnosis::Candidate& factor = e.entry("stiffness@group:g3");
  EXPECT_NEAR(std::exp(diagnosis::scaled_magnitude(factor, std::log(0.5), 0.1)), 0.933, 1e-3);
  const diagnosis::Candidate& mass = e.entry("mass@node:4");
  EXPECT_NEAR(std::exp(diagnosis::scaled_magnitude(mass, std::log(200.0), 0.1)), 20.0, 1e-9);
  EXPECT_EQ(diagnosis::scaled_magnitude(mass, std::log(200.0), 1e-6), mass.low[0]);
  EXPECT_TRUE(diagnosis::is_a_size(mass));
  EXPECT_FALSE(diagnosis::is_a_size(e.entry("swap@channels:c3,c7")));
  EXPECT_EQ(diagnosis::magnitude_factors(e.entry("swap@channels:c3,c7")), std::vector<double>{1.0});
  EXPECT_EQ(diagnosis::magnitude_factors(mass).size(), 5u);
}

}  // namespace
}  // namespace twindeck::tests
