/// Times the wind field on the task of the benchmark: 60 points × 3 components × 600 s at 16 Hz, and the same samples as direct
/// sums of cosines (paper Eq. 15 as it stands), a share of them, scaled up. Prints `name seconds` lines for
/// tests/bench/wind_field.py.
///
///     wind_field REPEATS
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "wind/simulation.hpp"

namespace {

using namespace twindeck;
using Eigen::Index;

/// Processor time: one thread, and other programs on the machine do not count.
double seconds_since(std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

/// 30 points on each of two arcs, as in the bridge.
wind::FieldDefinition field_of(wind::Component component) {
  wind::FieldDefinition field;
  field.component = component;
  field.position_m.resize(60, 3);
  for (Index i = 0; i < 60; ++i) {
    const double part = (static_cast<double>(i % 30) + 0.5) / 15.0 - 1.0, radius = i < 30 ? 80.0 : 100.0;
    const double angle = (i < 30 ? 0.9495 : 0.6381) * part;
    field.position_m.row(i) << radius * std::cos(angle) - radius + (i < 30 ? 0.0 : 16.0), radius * std::sin(angle),
        i < 30 ? 12.0 : 13.0;
  }
  field.speed_m_s = Eigen::VectorXd::Constant(60, 19.1);
  field.sigma_m_s = Eigen::VectorXd::Constant(60, 2.0 / (1.0 + static_cast<double>(component)));
  field.length_m = Eigen::VectorXd::Constant(60, 103.0 / std::pow(3.0, static_cast<double>(component)));
  field.decay = {3.0, 6.5, 3.0};
  return field;
}

/// Preparation and one sample of all three components.
double fast(int anchors, std::uint64_t seed, double& check) {
  const auto start = std::clock();
  for (const wind::Component component : wind::components) {
    const wind::Simulator simulator(field_of(component), {.anchors = anchors});
    check += simulator.sample(seed)(100, 59);
  }
  return seconds_since(start);
}

/// `pairs` waves (m, l) of Eq. (15), each over all 9600 samples.
double direct(int pairs, double& check) {
  std::vector<double> velocity(9600, 0.0);
  const auto start = std::clock();
  for (int p = 0; p < pairs; ++p) {
    const double omega = 2.0 * std::numbers::pi * static_cast<double>(p + 1) / 600.0, phase = 0.1 * static_cast<double>(p);
    for (std::size_t t = 0; t < velocity.size(); ++t)
      velocity[t] += 0.01 * std::cos(omega * static_cast<double>(t) / 16.0 + phase);
  }
  check += velocity[77];
  return seconds_since(start);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int repeats = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  double check = 0.0;
  for (int r = 0; r < repeats; ++r) {
    double seconds = 0.0;
    if (what == "interpolated" || what == "every_frequency") {
      seconds = fast(what == "interpolated" ? 40 : 0, static_cast<std::uint64_t>(r), check);
    } else if (what == "direct_cosine_sum") {
      const int measured = 2000;
      seconds = direct(measured, check) * 3.0 * 4799.0 * 60.0 * 61.0 / 2.0 / measured;  // pairs (m, l), points, components
    } else {
      std::fprintf(stderr, "usage: bench_wind_field interpolated|every_frequency|direct_cosine_sum [REPEATS]\n");
      return 2;
    }
    std::printf("%.6f\n", seconds);
  }
  std::fprintf(stderr, "checksum %g\n", check);
  return 0;
}
