#include "steps/validation/outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/angle.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

using Eigen::Index;

namespace {

constexpr std::size_t kBeforeMeasured = 12;  ///< columns of rms.csv before the measured side

}  // namespace

void write_rms(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
               const buffeting::MeasuredRms& measured, const ValidationConfig& config, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "run", "model", "channel", "direction", "rms_m_s2", "rms_low_m_s2", "rms_high_m_s2",
                     "seed_deviation_m_s2", "peak_m_s2", "spectral_rms_m_s2", "spectral_rms_each_frequency_m_s2",
                     "measured_rms_m_s2", "error_pct", "error_low_pct", "error_high_pct"});
  const std::array<std::string, 3> axes = {"x", "y", "z"};
  for (const buffeting::RunResult& result : results) {
    for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) {
      for (Index d = 0; d < 3; ++d) {
        const Index row = 3 * static_cast<Index>(p) + d;
        const auto found = measured.find({result.event, bridge.sensors.points[p]});
        std::optional<double> there, error, low, high;
        if (d == 2 && found != measured.end()) there = found->second;
        std::vector<io::Cell> cells = {result.event, result.run, result.model, bridge.sensors.points[p],
                                       axes[static_cast<std::size_t>(d)]};
        if (result.status.converged) {
          const buffeting::Interval rms = buffeting::confidence_interval(result.rms.row(row).transpose(), config.level);
          if (there) {
            error = 100.0 * (rms.mean / *there - 1.0);
            low = 100.0 * (rms.low / *there - 1.0);
            high = 100.0 * (rms.high / *there - 1.0);
          }
          for (const double value : {rms.mean, rms.low, rms.high, rms.deviation, result.peak.row(row).mean(),
                                     result.spectral_rms[row], result.spectral_rms_each_frequency[row]})
            cells.emplace_back(value);
        } else {
          cells.resize(kBeforeMeasured, io::Cell(""));
        }
        for (const std::optional<double>& value : {there, error, low, high}) cells.emplace_back(value);
        csv.row(cells);
      }
    }
  }
  csv.save(folder / "rms.csv");
}

void write_statements(const std::vector<buffeting::PaperStatement>& statements, const std::filesystem::path& folder) {
  io::CsvWriter csv({"statement", "found", "verdict"});
  for (const buffeting::PaperStatement& said : statements) csv.row({said.statement, said.found, said.holds ? "hit" : "miss"});
  csv.save(folder / "statements.csv");
}

void write_comfort(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
                   const ValidationConfig& config, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "run", "direction", "deck", "station_m", "peak_m_s2", "peak_low_m_s2", "peak_high_m_s2",
                     "limit_m_s2", "verdict"});
  for (const buffeting::RunResult& result : results) {
    for (const bool vertical : {true, false}) {
      const double limit = vertical ? config.comfort_vertical_m_s2 : config.comfort_lateral_m_s2;
      const std::string direction = vertical ? "vertical" : "lateral";
      if (!result.status.converged) {
        csv.row({result.event, result.run, direction, "", "", "", "", "", limit, "unstable"});
        continue;
      }
      std::size_t worst = 0;
      double highest = -1.0;
      for (std::size_t i = 0; i < bridge.sensors.nodes.size(); ++i) {
        const Index row = vertical ? bridge.sensors.vertical_row(i) : bridge.sensors.lateral_row(i);
        if (const double mean = result.peak.row(row).mean(); mean > highest) {
          highest = mean;
          worst = i;
        }
      }
      const Index row = vertical ? bridge.sensors.vertical_row(worst) : bridge.sensors.lateral_row(worst);
      const aero::Strip& strip = bridge.model.strips[bridge.sensors.nodes[worst]];
      const buffeting::Interval peak = buffeting::confidence_interval(result.peak.row(row).transpose(), config.level);
      csv.row({result.event, result.run, direction, strip.deck, strip.station_m, peak.mean, peak.low, peak.high, limit,
               peak.high <= limit ? "within" : "exceeded"});
    }
  }
  csv.save(folder / "comfort.csv");
}

void write_wind_check(const std::vector<buffeting::FieldCheck>& checks, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "quantity", "target", "found", "allowed", "verdict"});
  for (const buffeting::FieldCheck& check : checks) {
    csv.row({check.event, check.quantity, check.target, check.found, check.allowed,
             std::abs(check.found - check.target) <= check.allowed ? "met" : "missed"});
  }
  csv.save(folder / "wind_check.csv");
}

void write_time_checks(const std::vector<buffeting::TimeCheck>& checks, const std::filesystem::path& folder) {
  io::CsvWriter csv({"check", "channel", "reference_m_s2", "found_m_s2", "difference_pct", "allowed_pct", "verdict"});
  for (const buffeting::TimeCheck& check : checks) {
    const double difference = 100.0 * (check.found_m_s2 / check.reference_m_s2 - 1.0);
    csv.row({check.name, check.channel, check.reference_m_s2, check.found_m_s2, difference, check.allowed_pct,
             std::abs(difference) <= check.allowed_pct ? "met" : "missed"});
  }
  csv.save(folder / "checks.csv");
}

void write_hybrid(const buffeting::BridgeInWind& bridge, const std::filesystem::path& folder) {
  io::CsvWriter zones({"deck", "theta_from_deg", "theta_to_deg", "zone", "model", "statics", "lookup_cos_power",
                       "block_inverse_cos_power", "nodes"});
  io::CsvWriter nodes({"deck", "node", "station_m", "x_m", "y_m", "yaw_deg", "model", "static_factor", "block_factor"});
  if (!bridge.aerodynamics.hybrid.empty()) {
    const aero::Deployment deployment = buffeting::deployment_of(bridge.aerodynamics, "hybrid");
    for (const aero::HybridZone& zone : bridge.aerodynamics.hybrid) {
      std::vector<double> yaw;
      for (const aero::Strip& strip : bridge.model.strips) {
        if (strip.deck != zone.deck) continue;
        const aero::YawRule& rule = deployment.at(strip.deck, strip.yaw_rad);
        yaw.push_back(strip.yaw_rad * degrees);
        nodes.row({strip.deck, yaw.size(), strip.station_m, strip.x_m.x(), strip.x_m.y(), yaw.back(), rule.name,
                   aero::static_factor(rule, strip.yaw_rad).force, aero::block_factor(rule, strip.yaw_rad)(1, 1)});
      }
      if (yaw.size() < 2) continue;
      std::sort(yaw.begin(), yaw.end());
      // The outermost strips end half a strip beyond their nodes: at the end stays.
      const double lowest = yaw[0] - 0.5 * (yaw[1] - yaw[0]), highest = yaw.back() + 0.5 * (yaw.back() - yaw[yaw.size() - 2]);
      const auto put = [&](const std::string& name, double from, double to) {
        const aero::YawRule& rule = deployment.at(zone.deck, 0.5 * (from + to) / degrees);
        const auto inside = std::count_if(yaw.begin(), yaw.end(), [&](double y) { return y >= from && y <= to; });
        zones.row({zone.deck, from, to, name, rule.name, name_of(rule.statics), rule.lookup_power, rule.inverse_power(1, 1),
                   static_cast<long>(inside)});
      };
      if (lowest < -zone.beyond_deg) put("end", lowest, -zone.beyond_deg);
      if (highest > zone.beyond_deg) put("end", zone.beyond_deg, highest);
      put("middle", std::max(lowest, -zone.beyond_deg), std::min(highest, zone.beyond_deg));
    }
  }
  zones.save(folder / "hybrid.csv");
  nodes.save(folder / "hybrid_nodes.csv");
}

}  // namespace twindeck::steps
