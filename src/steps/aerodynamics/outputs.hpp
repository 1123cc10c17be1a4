#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "aero/wind_study.hpp"
#include "steps/aerodynamics/aerodynamics.hpp"

/// What s7_aerodynamics writes; every row names the aerodynamic set it rests on.
namespace twindeck::steps {

/// What the step found.
struct WindOutcome {
  std::vector<aero::FittedSet> sets;
  aero::Instabilities instabilities;
  std::vector<aero::StaticResponse> statics;
};

/// What a set's level multiplies, in words.
[[nodiscard]] std::string fitted_quantity(const std::string& set);

/// sets.csv, critical.csv, damping.csv, nodes.csv, static.csv, rules.csv, equations.csv, galloping.csv, polars.csv,
/// summary.csv.
void write_tables(const AerodynamicsConfig& config, const aero::WindModel& model, const WindOutcome& found,
                  const std::filesystem::path& folder);

}  // namespace twindeck::steps
