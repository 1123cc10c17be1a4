#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reliability/bridge_reliability.hpp"
#include "steps/reliability/inputs.hpp"

/// What s10_reliability writes. paper/twindeck_reference/columns.toml says what each column holds.
namespace twindeck::steps {

/// random.csv: each input in its own unit.
void write_random(const reliability::RandomVector& random, const std::filesystem::path& folder);

/// The structure of a row. Its columns are `years,dampers,fault`: dampers off or on, fault empty or "C1 held".
struct Case {
  double years = 0.0;
  bool dampers = false;
  std::string fault;
  /// "without dampers", "with dampers, C1 held".
  [[nodiscard]] std::string words() const {
    return (dampers ? "with dampers" : "without dampers") + (fault.empty() ? "" : ", " + fault);
  }
  [[nodiscard]] bool same_but_years(const Case& other) const { return dampers == other.dampers && fault == other.fault; }
};

/// A probability of exceeding a limit state in a mean wind.
struct FragilityRow {
  std::string limit_state;  ///< stability, comfort_vertical, comfort_lateral, further guidelines', stay_slack, damper_stroke
  std::string model;
  Case of;
  double speed_m_s = 0.0;
  std::string place;                    ///< location with the largest response; empty for stability
  double limit = 0.0, deviation = 0.0;  ///< of the response
  std::string unit;
  reliability::Excursion excursion;
};
/// crossings.csv: one row per limit state, at the location with the largest response. fragility.csv: its probability.
void write_fragility(const std::vector<FragilityRow>& rows, const std::filesystem::path& folder);

/// responses.csv, at all inputs' medians: accelerations at the monitoring points in x, y, z and at every third aerodynamic node
/// across the deck and vertically; forces of stays and strokes of dampers.
struct ResponseRow {
  std::string model;
  Case of;
  double speed_m_s = 0.0;
  std::string channel, direction, unit;
  reliability::SpectralMoments moments;
};
void write_responses(const std::vector<ResponseRow>& rows, const std::filesystem::path& folder);

struct CriticalRow {
  Case of;
  reliability::CriticalSpeed speed;
};
/// critical.csv: critical speeds, empty where the bridge is stable. importance.csv: what each input contributes to their
/// scatter.
void write_critical(const std::vector<CriticalRow>& speeds, const reliability::RandomVector& random, double design_speed_m_s,
                    const std::filesystem::path& folder);

/// years.csv: frequencies, critical speeds, static forces of stays, remaining share of each section. low and high are the 5 and
/// 95 % quantiles, empty where no spread was computed.
struct YearRow {
  Case of;
  std::string quantity, place, unit;
  double value = 0.0;
  std::optional<double> spread;  ///< deviation of the logarithm
};
void write_years(const std::vector<YearRow>& rows, const std::filesystem::path& folder);

/// rare.csv, where the configuration asks for it: FORM and subset simulation of an excursion, each with a note on its doubts.
struct RareRow {
  std::string limit_state, model;
  Case of;
  double speed_m_s = 0.0;
  std::string method;
  double probability = 0.0;
  std::optional<double> beta, variation;
  int calls = 0;
  std::string note;
};
void write_rare(const std::vector<RareRow>& rows, const std::filesystem::path& folder);

/// fatigue.csv: damage of stays. annual.csv, only where the configuration gives a wind law: hours and probabilities per year,
/// and damage of stays per year with its narrow-band bound in `upper`.
struct FatigueRow {
  std::string stay, model;
  Case of;
  double speed_m_s = 0.0, stress_deviation_Pa = 0.0, damage_per_hour = 0.0, narrow_band_per_hour = 0.0;
};
void write_fatigue(const std::vector<FatigueRow>& rows, const std::filesystem::path& folder);
struct AnnualRow {
  std::string quantity;
  Case of;
  std::string place, unit;
  double value = 0.0;
  std::optional<double> upper;
};
void write_annual(const std::vector<AnnualRow>& rows, const std::filesystem::path& folder);

/// visible.csv, a row a section of each wall: the smallest loss of a surface that two measurements of the frequencies show, the
/// year in which it is reached, the smallest loss that is distinguished from losses of other walls, and the mode with the
/// largest change. visible_modes.csv: the change of each mode.
void write_visible(const std::vector<reliability::VisibleLoss>& losses, const std::vector<reliability::Wall>& walls,
                   const std::vector<MonitoredName>& monitored, const std::filesystem::path& folder);

}  // namespace twindeck::steps
