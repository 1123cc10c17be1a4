#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reliability/bridge_reliability.hpp"

/// What s10_reliability writes.
namespace twindeck::steps {

/// random.csv: `name,law,mean,deviation,low,high,label,source`, each input in its own unit.
void write_random(const reliability::RandomVector& random, const std::filesystem::path& folder);

/// A probability of a limit state in a mean wind.
struct FragilityRow {
  std::string limit_state;  ///< comfort_vertical, comfort_lateral, stability
  std::string model;
  bool dampers = false;
  double speed_m_s = 0.0;
  std::string channel;                            ///< with the largest probability; empty for stability
  double limit_m_s2 = 0.0, deviation_m_s2 = 0.0;  ///< of the acceleration; 0 for stability
  reliability::Excursion excursion;
};
/// crossings.csv: `model,dampers,speed_m_s,channel,limit_m_s2,deviation_m_s2,crossing_rate_Hz,poisson,vanmarcke,low,high`: the
/// channel of each limit state with the largest probability. fragility.csv:
/// `limit_state,model,dampers,speed_m_s,probability,low,high`.
void write_fragility(const std::vector<FragilityRow>& rows, const std::filesystem::path& folder);

/// responses.csv: `model,dampers,speed_m_s,channel,direction,deviation_m_s2,mean_rate_Hz,bandwidth`: accelerations at all
/// inputs' medians, at the monitoring points in x, y, z and at every third aerodynamic node across the deck and vertically.
struct ResponseRow {
  std::string model;
  bool dampers = false;
  double speed_m_s = 0.0;
  std::string channel, direction;
  reliability::SpectralMoments moments;
};
void write_responses(const std::vector<ResponseRow>& rows, const std::filesystem::path& folder);

/// critical.csv: `model,dampers,speed_m_s,low_m_s,high_m_s,deviation_pct,design_speed_m_s,probability_below_design,beta`, low
/// and high the 5 and 95 % quantiles; empty where the bridge is stable. importance.csv:
/// `model,dampers,input,slope_per_deviation_pct,importance`: the share of the variance of ln V_cr, which is the squared
/// direction cosine of FORM's design point.
void write_critical(const std::vector<reliability::CriticalSpeed>& speeds, const reliability::RandomVector& random,
                    double design_speed_m_s, const std::filesystem::path& folder);

}  // namespace twindeck::steps
