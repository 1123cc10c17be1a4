#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "aero/wind_study.hpp"
#include "steps/aerodynamics/aerodynamics.hpp"

/// What s7_aerodynamics writes; every row names the aerodynamic set it rests on.
namespace twindeck::steps {

/// critical.csv; V_cr is empty where no mode becomes unstable up to `max_speed`. `ratio_to_A` and `f_cr_over_f1` within the
/// set: over model A without dampers at `structural_damping`, and empty where `models` has no A.
void write_critical(const std::vector<aero::CriticalRow>& rows, const AerodynamicsConfig& config,
                    const std::filesystem::path& file);

/// damping.csv: total damping of each mode over the wind speed (Fig. 20).
void write_damping(const std::vector<aero::DampingCurves>& curves, const std::filesystem::path& file);

/// nodes.csv: where and how each strip stands in the wind (Figs 16, 17, 21): yaw, B, B', L, L', angle of attack.
void write_nodes(const std::vector<aero::Strip>& strips, const std::vector<aero::SectionAero>& sections,
                 const std::filesystem::path& file);

void write_static(const std::vector<aero::StaticResponse>& responses, const std::vector<aero::Strip>& strips,
                  const std::filesystem::path& file);

/// rules.csv: Table 11 (and 14) as data: what the text cells of the tables are made from.
void write_rules(const AerodynamicsConfig& config, const std::filesystem::path& file);

/// equations.csv: where the paper's equations cannot hold as printed.
void write_equations(const std::filesystem::path& file);

/// galloping.csv: Den Hartog's sum C_L' + C_D of each deck over the polar's angles, and h1* over reduced velocity (Fig. 19).
/// From -4 to 4 degrees and from 1 to 20, as far as polar and table reach.
void write_galloping(const std::vector<std::string>& sets, const std::vector<std::vector<aero::SectionAero>>& sections,
                     const std::filesystem::path& file);
void write_polars(const std::vector<std::string>& sets, const std::vector<std::vector<aero::SectionAero>>& sections,
                  const std::filesystem::path& file);

}  // namespace twindeck::steps
