#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aero/stability.hpp"
#include "steps/aerodynamics/aerodynamics.hpp"

/// What s7_aerodynamics writes; every row names the aerodynamic set it rests on.
namespace twindeck::steps {

/// One row of critical.csv: a set, a rule, a structure.
struct CriticalRow {
  std::string set, model, group, description;
  bool dampers = false;
  double structural_damping = 0.0;
  std::optional<aero::CriticalPoint> point;
  std::string lost;                       ///< of modes that could not be followed to the highest speed, or to `point`
  aero::GallopingCharacter character;     ///< of `point`
  std::optional<double> single_mode_m_s;  ///< mode 1 alone, without coupling to the others
  std::optional<double> den_hartog_m_s;   ///< mode 1 by quasi-steady galloping of the polars
  std::optional<double> divergence_m_s;
};
/// critical.csv; V_cr is empty where no mode becomes unstable up to `max_speed`. `ratio_to_A` and `f_cr_over_f1` within the
/// set.
void write_critical(const std::vector<CriticalRow>& rows, double max_speed_m_s, const std::filesystem::path& file);

struct DampingCurves {
  std::string set, model;
  bool dampers = false;
  double structural_damping = 0.0;
  std::vector<aero::Branch> branches;
};
/// damping.csv: total damping of each mode over the wind speed (Fig. 20).
void write_damping(const std::vector<DampingCurves>& curves, const std::filesystem::path& file);

/// nodes.csv: where and how each strip stands in the wind (Figs 16, 17, 21): yaw, B, B', L, L', angle of attack.
void write_nodes(const std::vector<aero::Strip>& strips, const std::vector<aero::SectionAero>& sections,
                 const std::filesystem::path& file);

/// Static response to the mean wind (Eq. 7) at the aerodynamic nodes.
struct StaticResponse {
  std::string set, model;
  std::vector<Eigen::Vector3d> force;         ///< (D, L, M) of each strip along its rule's axes [N, N, N m]
  std::vector<Eigen::Vector3d> displacement;  ///< [m]
  std::vector<double> rotation_rad;           ///< nose-up
};
void write_static(const std::vector<StaticResponse>& responses, const std::vector<aero::Strip>& strips,
                  const std::filesystem::path& file);

/// rules.csv: Table 11 (and 14) as data: what the text cells of the tables are made from.
void write_rules(const AerodynamicsConfig& config, const std::filesystem::path& file);

/// equations.csv: where the paper's equations cannot hold as printed.
void write_equations(const std::filesystem::path& file);

/// galloping.csv: Den Hartog's sum C_L' + C_D of each deck over the polar's angles, and h1* over reduced velocity (Fig. 19).
void write_galloping(const std::vector<std::string>& sets, const std::vector<std::vector<aero::SectionAero>>& sections,
                     const std::filesystem::path& file);
void write_polars(const std::vector<std::string>& sets, const std::vector<std::vector<aero::SectionAero>>& sections,
                  const std::filesystem::path& file);

}  // namespace twindeck::steps
