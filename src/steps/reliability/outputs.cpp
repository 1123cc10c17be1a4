#include "steps/reliability/outputs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/distributions.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {
namespace {

std::string dampers(const Case& of) { return of.dampers ? "on" : "off"; }

/// Distance of the 5 and 95 % quantiles from the median [standard deviations].
double reach() { return two_sided_normal_quantile(0.9); }

}  // namespace

void write_random(const reliability::RandomVector& random, const std::filesystem::path& folder) {
  io::CsvWriter csv({"name", "law", "mean", "deviation", "low", "high", "label", "source"});
  for (const reliability::RandomInput& input : random.inputs())
    csv.row({input.name, reliability::law_name(input.kind), input.mean, input.deviation, input.low, input.high, input.label,
             input.source});
  csv.save(folder / "random.csv");
}

void write_fragility(const std::vector<FragilityRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter crossings({"limit_state", "model", "years", "dampers", "fault", "speed_m_s", "place", "limit", "deviation",
                           "unit", "crossing_rate_Hz", "poisson", "vanmarcke", "low", "high"});
  io::CsvWriter fragility({"limit_state", "model", "years", "dampers", "fault", "speed_m_s", "probability", "low", "high"});
  for (const FragilityRow& row : rows) {
    const reliability::Excursion& e = row.excursion;
    fragility.row(
        {row.limit_state, row.model, row.of.years, dampers(row.of), row.of.fault, row.speed_m_s, e.mean, e.low, e.high});
    if (row.place.empty()) continue;
    crossings.row({row.limit_state, row.model, row.of.years, dampers(row.of), row.of.fault, row.speed_m_s, row.place, row.limit,
                   row.deviation, row.unit, e.crossing_rate_Hz, e.poisson, e.mean, e.low, e.high});
  }
  crossings.save(folder / "crossings.csv");
  fragility.save(folder / "fragility.csv");
}

void write_responses(const std::vector<ResponseRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"model", "years", "dampers", "fault", "speed_m_s", "channel", "direction", "deviation", "unit",
                     "mean_rate_Hz", "bandwidth"});
  for (const ResponseRow& row : rows)
    csv.row({row.model, row.of.years, dampers(row.of), row.of.fault, row.speed_m_s, row.channel, row.direction,
             std::sqrt(row.moments.variance), row.unit, row.moments.mean_rate_Hz(), row.moments.bandwidth()});
  csv.save(folder / "responses.csv");
}

void write_critical(const std::vector<CriticalRow>& speeds, const reliability::RandomVector& random, double design_speed_m_s,
                    const std::filesystem::path& folder) {
  io::CsvWriter critical({"model", "years", "dampers", "fault", "speed_m_s", "low_m_s", "high_m_s", "deviation_pct",
                          "design_speed_m_s", "probability_below_design", "beta"});
  io::CsvWriter importance({"model", "years", "dampers", "fault", "input", "slope_per_deviation_pct", "importance"});
  for (const CriticalRow& row : speeds) {
    const std::optional<reliability::LogLinear>& found = row.speed.speed_m_s;
    std::optional<double> speed, low, high, deviation, probability, beta;
    if (found) {
      const double spread = found->deviation();
      speed = found->value;
      low = *speed * std::exp(-reach() * spread);
      high = *speed * std::exp(reach() * spread);
      deviation = 100.0 * spread;
      probability = row.speed.probability_below(design_speed_m_s);
      if (spread > 0.0) beta = std::log(*speed / design_speed_m_s) / spread;
      for (Eigen::Index i = 0; i < found->slope.size() && spread > 0.0; ++i) {
        const double slope = found->slope[i];
        importance.row({row.speed.model, row.of.years, dampers(row.of), row.of.fault, random.name(i), 100.0 * slope,
                        slope * slope / (spread * spread)});
      }
    }
    critical.row({row.speed.model, row.of.years, dampers(row.of), row.of.fault, speed, low, high, deviation, design_speed_m_s,
                  probability, beta});
  }
  critical.save(folder / "critical.csv");
  importance.save(folder / "importance.csv");
}

void write_years(const std::vector<YearRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"years", "dampers", "fault", "quantity", "place", "value", "low", "high", "unit"});
  for (const YearRow& row : rows) {
    std::optional<double> low, high;
    if (row.spread) {
      low = row.value * std::exp(-reach() * *row.spread);
      high = row.value * std::exp(reach() * *row.spread);
    }
    csv.row({row.of.years, dampers(row.of), row.of.fault, row.quantity, row.place, row.value, low, high, row.unit});
  }
  csv.save(folder / "years.csv");
}

void write_rare(const std::vector<RareRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"limit_state", "model", "years", "dampers", "fault", "speed_m_s", "method", "probability", "beta",
                     "variation", "calls", "note"});
  for (const RareRow& row : rows)
    csv.row({row.limit_state, row.model, row.of.years, dampers(row.of), row.of.fault, row.speed_m_s, row.method,
             row.probability, row.beta, row.variation, row.calls, row.note});
  csv.save(folder / "rare.csv");
}

void write_fatigue(const std::vector<FatigueRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"stay", "model", "years", "dampers", "fault", "speed_m_s", "stress_deviation_Pa", "damage_per_hour",
                     "narrow_band_per_hour"});
  for (const FatigueRow& row : rows)
    csv.row({row.stay, row.model, row.of.years, dampers(row.of), row.of.fault, row.speed_m_s, row.stress_deviation_Pa,
             row.damage_per_hour, row.narrow_band_per_hour});
  csv.save(folder / "fatigue.csv");
}

void write_annual(const std::vector<AnnualRow>& rows, const std::filesystem::path& folder) {
  io::CsvWriter csv({"quantity", "years", "dampers", "fault", "place", "value", "upper", "unit"});
  for (const AnnualRow& row : rows)
    csv.row({row.quantity, row.of.years, dampers(row.of), row.of.fault, row.place, row.value, row.upper, row.unit});
  csv.save(folder / "annual.csv");
}

void write_visible(const std::vector<reliability::VisibleLoss>& losses, const std::vector<reliability::Wall>& walls,
                   const std::vector<MonitoredName>& monitored, const std::filesystem::path& folder) {
  io::CsvWriter csv({"wall", "section", "wall_thickness_m", "smallest_loss_m", "share_pct", "years", "located_loss_m",
                     "distance", "mode", "change_pct"});
  io::CsvWriter modes({"wall", "experimental_mode", "numerical_mode", "deviation_pct", "change_pct"});
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const reliability::VisibleLoss& loss = losses[w];
    const long number = static_cast<long>(w) + 1;
    std::optional<double> share, years;
    if (loss.loss_m) {
      share = 100.0 * *loss.loss_m / loss.wall_m;
      years = walls[w].corrosion.years_until(*loss.loss_m);
    }
    std::size_t clearest = 0;
    for (std::size_t i = 0; i < monitored.size(); ++i) {
      const auto weight = [&](std::size_t k) {
        return std::abs(loss.change[static_cast<Eigen::Index>(k)]) / monitored[k].mode.deviation;
      };
      if (weight(i) > weight(clearest)) clearest = i;
      modes.row({number, monitored[i].measured, fmt::format("{}N", monitored[i].mode.mode + 1),
                 100.0 * monitored[i].mode.deviation, 100.0 * std::expm1(loss.change[static_cast<Eigen::Index>(i)])});
    }
    for (const std::string& section : walls[w].sections)
      csv.row({number, section, loss.wall_m, loss.loss_m, share, years, loss.located_m, loss.distance,
               monitored[clearest].measured, 100.0 * std::expm1(loss.change[static_cast<Eigen::Index>(clearest)])});
  }
  csv.save(folder / "visible.csv");
  modes.save(folder / "visible_modes.csv");
}

}  // namespace twindeck::steps
