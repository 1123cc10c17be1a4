#pragma once

#include <filesystem>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/field_statistics.hpp"
#include "buffeting/paper_statements.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "steps/validation/validation.hpp"

/// What s8_validation writes.
namespace twindeck::steps {

/// rms.csv:
/// `event,run,model,channel,direction,rms_m_s2,rms_low_m_s2,rms_high_m_s2,seed_deviation_m_s2,peak_m_s2,spectral_rms_m_s2,
/// spectral_rms_each_frequency_m_s2`: accelerations at the monitoring points, mean over seeds with its interval, what one seed
/// scatters, and the frequency domain's value, with derivatives frozen as in time and at each frequency's own; then
/// `measured_rms_m_s2,error_pct, error_low_pct,error_high_pct` of the vertical direction, Eq. (18), 100 (RMS_num / RMS_exp -
/// 1), empty without a measured side. The bounds are those of the mean over seeds. Where the bridge is unstable in an event and
/// a run, all that is simulated is empty.
void write_rms(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
               const buffeting::MeasuredRms& measured, const ValidationConfig& config, const std::filesystem::path& folder);

/// statements.csv: `statement,found,verdict`, hit or miss.
void write_statements(const std::vector<buffeting::PaperStatement>& statements, const std::filesystem::path& folder);

/// comfort.csv: `event,run,direction,deck,station_m,peak_m_s2,peak_low_m_s2,peak_high_m_s2,limit_m_s2,verdict`: the aerodynamic
/// node with the largest mean peak, against the comfort limits: "within", "exceeded", or "unstable", which has no peak.
void write_comfort(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
                   const ValidationConfig& config, const std::filesystem::path& folder);

/// wind_check.csv: `event,quantity,target,found,allowed,verdict`; no rows of an event in which all runs are unstable.
void write_wind_check(const std::vector<buffeting::FieldCheck>& checks, const std::filesystem::path& folder);

/// hybrid.csv: the zones of Table 14, `deck,theta_from_deg,theta_to_deg,zone,model,statics,lookup_cos_power,
/// block_inverse_cos_power,nodes`; the ends are the yaw at the decks' end stays. hybrid_nodes.csv:
/// `deck,node,station_m,x_m,y_m,yaw_deg, model,static_factor,block_factor` (Fig. 21).
void write_hybrid(const buffeting::BridgeInWind& bridge, const std::filesystem::path& folder);

/// checks.csv: `check,channel,reference_m_s2,found_m_s2,difference_pct,allowed_pct,verdict`, of the first event and run in
/// which the bridge is stable.
void write_time_checks(const std::vector<buffeting::TimeCheck>& checks, const std::filesystem::path& folder);

}  // namespace twindeck::steps
