#include "steps/reliability/outputs.hpp"

#include <cmath>
#include <optional>

#include "core/distributions.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

void write_random(const reliability::RandomVector& random, const std::filesystem::path& folder) {
  io::CsvWriter csv({"name", "law", "mean", "deviation", "low", "high", "label", "source"});
  for (const reliability::RandomInput& input : random.inputs())
    csv.row({input.name, reliability::law_name(input.kind), input.mean, input.deviation, input.low, input.high, input.label,
             input.source});
  csv.save(folder / "random.csv");
}

void write_fragility(const std::vector<FragilityRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter crossings({"limit_state", "model", "dampers", "speed_m_s", "channel", "limit_m_s2", "deviation_m_s2",
                           "crossing_rate_Hz", "poisson", "vanmarcke", "low", "high"});
  io::CsvWriter fragility({"limit_state", "model", "dampers", "speed_m_s", "probability", "low", "high"});
  for (const FragilityRow& row : rows) {
    const reliability::Excursion& e = row.excursion;
    fragility.row({row.limit_state, row.model, row.dampers ? "on" : "off", row.speed_m_s, e.mean, e.low, e.high});
    if (row.channel.empty()) continue;
    crossings.row({row.limit_state, row.model, row.dampers ? "on" : "off", row.speed_m_s, row.channel, row.limit_m_s2,
                   row.deviation_m_s2, e.crossing_rate_Hz, e.poisson, e.mean, e.low, e.high});
  }
  crossings.save(folder / "crossings.csv");
  fragility.save(folder / "fragility.csv");
}

void write_responses(const std::vector<ResponseRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"model", "dampers", "speed_m_s", "channel", "direction", "deviation_m_s2", "mean_rate_Hz", "bandwidth"});
  for (const ResponseRow& row : rows) {
    csv.row({row.model, row.dampers ? "on" : "off", row.speed_m_s, row.channel, row.direction, std::sqrt(row.moments.variance),
             row.moments.mean_rate_Hz(), row.moments.bandwidth()});
  }
  csv.save(folder / "responses.csv");
}

void write_critical(const std::vector<reliability::CriticalSpeed>& speeds, const reliability::RandomVector& random,
                    double design_speed_m_s, const std::filesystem::path& folder) {
  const double reach = two_sided_normal_quantile(0.9);
  io::CsvWriter critical({"model", "dampers", "speed_m_s", "low_m_s", "high_m_s", "deviation_pct", "design_speed_m_s",
                          "probability_below_design", "beta"});
  io::CsvWriter importance({"model", "dampers", "input", "slope_per_deviation_pct", "importance"});
  for (const reliability::CriticalSpeed& each : speeds) {
    std::optional<double> speed, low, high, deviation, probability, beta;
    if (each.speed_m_s) {
      const double spread = each.speed_m_s->deviation();
      speed = each.speed_m_s->value;
      low = *speed * std::exp(-reach * spread);
      high = *speed * std::exp(reach * spread);
      deviation = 100.0 * spread;
      probability = each.probability_below(design_speed_m_s);
      if (spread > 0.0) beta = std::log(*speed / design_speed_m_s) / spread;
      for (Eigen::Index i = 0; i < each.speed_m_s->slope.size(); ++i) {
        const double slope = each.speed_m_s->slope[i];
        importance.row(
            {each.model, each.dampers ? "on" : "off", random.name(i), 100.0 * slope, slope * slope / (spread * spread)});
      }
    }
    critical.row({each.model, each.dampers ? "on" : "off", speed, low, high, deviation, design_speed_m_s, probability, beta});
  }
  critical.save(folder / "critical.csv");
  importance.save(folder / "importance.csv");
}

}  // namespace twindeck::steps
