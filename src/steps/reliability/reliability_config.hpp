#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/config.hpp"

namespace twindeck::steps {

/// A random input as the configuration states it.
struct StatedInput {
  std::string name, law = "normal", label = "user", source;
  double mean = 0.0, deviation = 0.0;
  std::optional<double> low, high;
  double low_value = 0.0, high_value = 0.0;  ///< where `bounded` says that the law is cut
  bool bounded = false;
};

/// Configuration of s10_reliability. Decks, data and wind direction are those of s7_aerodynamics.toml; height, turbulence,
/// reduction and comfort limits those of s8_validation.toml.
struct ReliabilityConfig {
  std::vector<double> speed_m_s = {10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0};
  std::vector<std::string> models = {"A", "C", "D", "G", "H", "I"};
  std::string response_model = "A";
  double duration_s = 600.0;
  long samples = 2000;
  double damping_variation = 0.2, level_variation = 0.1, damper_variation = 0.05, turbulence_variation = 0.1;
  std::vector<StatedInput> random;

  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
