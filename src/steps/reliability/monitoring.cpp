#include "steps/reliability/monitoring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/csv.hpp"
#include "steps/measured/measured_input.hpp"

namespace twindeck::steps {

std::vector<MonitoredName> read_monitored(runner::StepContext& context, const std::string& condition) {
  std::vector<MonitoredName> out;
  const std::filesystem::path file = context.results / "s6_updating" / "comparison.csv";
  const bool compared = !context.model && std::filesystem::exists(file);
  if (const auto measured = compared ? find_measured(context, condition) : std::nullopt) {
    const io::CsvTable table =
        io::CsvTable::read(context.input(file), {"stage", "experimental_mode", "numerical_mode"}, {}, true);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const auto at = std::find(measured->labels.begin(), measured->labels.end(), table.text(row, "experimental_mode"));
      const std::string& name = table.text(row, "numerical_mode");
      long mode = 0;  // "3N"
      std::from_chars(name.data(), name.data() + name.size(), mode);
      if (table.text(row, "stage") != "after" || at == measured->labels.end() || mode < 1) continue;
      const auto i = static_cast<Eigen::Index>(at - measured->labels.begin());
      const double deviation = measured->modes.frequency_std_Hz[i] / measured->modes.frequency_Hz[i];
      if (deviation > 0.0) out.push_back({*at, {mode - 1, deviation}});
    }
  }
  if (out.empty())
    context.warn(
        "no pair of step 6 has a measured frequency with a standard deviation: what monitoring would see of corrosion is not "
        "computed (visible.csv)");
  return out;
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
