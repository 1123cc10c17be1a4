#include "steps/refinement/change_table.hpp"

#include <cmath>
#include <optional>

#include "io/csv.hpp"

namespace twindeck::steps {

void write_changes(const ponte::ChangeStudy& study, const std::filesystem::path& folder) {
  io::CsvWriter csv({"change", "paper_item", "meaning", "mode", "frequency_before_Hz", "frequency_alone_Hz", "effect_alone_pct",
                     "effect_cumulative_pct", "mac_alone", "mac_cumulative"});
  const auto known = [](double value) { return std::isnan(value) ? std::nullopt : std::optional<double>(value); };
  for (const ponte::ChangeEffect& effect : study.effects) {
    for (Eigen::Index i = 0; i < study.before_Hz.size(); ++i) {
      const double before = study.before_Hz[i], alone = effect.alone.frequency_Hz[i];
      csv.row({effect.change.name, effect.change.paper_item, effect.change.meaning, static_cast<long>(i + 1), before,
               known(alone), known(100.0 * (alone / before - 1.0)),
               known(100.0 * (effect.cumulative.frequency_Hz[i] / before - 1.0)), known(effect.alone.mac[i]),
               known(effect.cumulative.mac[i])});
    }
  }
  csv.save(folder / "changes.csv");
}

}  // namespace twindeck::steps
