#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "io/csv.hpp"
#include "steps/refinement/refinement.hpp"

namespace twindeck::steps {

ChangeStudy study_changes(const std::filesystem::path& bridge_toml, const std::string& mesh, int n_modes, int extra_modes,
                          const std::function<void(int done, int of)>& progress) {
  const std::vector<ponte::Change> changes = ponte::as_built_changes(bridge_toml);
  const auto n_changes = static_cast<int>(changes.size());
  // Model 0 is the preliminary one; 1 … n each change alone; n + 1 … 2 n - 1 the first two, the first three, … together.
  std::vector<std::vector<std::string>> switched(1);
  for (const ponte::Change& change : changes) switched.push_back({change.name});
  for (int k = 1; k < n_changes; ++k) {
    std::vector<std::string> names;
    for (int i = 0; i <= k; ++i) names.push_back(changes[static_cast<std::size_t>(i)].name);
    switched.push_back(names);
  }
  const auto count = static_cast<int>(switched.size());
  std::vector<SolvedModel> models(switched.size());
  std::mutex counting;
  int done = 0;
  parallel_for(count, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    SolvedModel& solved = models[at];
    solved = solve_modes(from_model(ponte::generate_with_changes(bridge_toml, switched[at], mesh)), n_modes + extra_modes);
    // What following needs is kept; the assembled terms of sixteen models at once would fill the memory.
    solved.loaded.model = std::make_shared<const fe::Model>(*solved.loaded.model);
    solved.loaded.structure.reset();
    solved.loaded.system.stiffness_terms = solved.loaded.system.mass_terms = {};
    const std::scoped_lock lock(counting);
    progress(++done, count);
  });

  ChangeStudy study;
  study.before_Hz = models[0].modes.frequency_Hz.head(n_modes);
  for (const SolvedModel& model : models) {
    if (!model.modes.status.converged && study.status.converged) study.status = model.modes.status;
  }
  std::vector<int> position;  // of each preliminary mode in the last cumulative state
  for (int i = 0; i < n_modes; ++i) position.push_back(i);
  const SolvedModel* last = &models[0];
  for (int k = 0; k < n_changes; ++k) {
    ChangeEffect effect{
        changes[static_cast<std::size_t>(k)], follow(models[0], models[static_cast<std::size_t>(k + 1)], n_modes), {}};
    const SolvedModel& now = models[static_cast<std::size_t>(k == 0 ? 1 : n_changes + k)];
    const FollowedModes step = follow(*last, now, last->modes.frequency_Hz.size());
    effect.cumulative = {Eigen::VectorXd::Constant(n_modes, kUnknown), Eigen::VectorXd::Constant(n_modes, kUnknown), {}};
    for (int i = 0; i < n_modes; ++i) {
      int& at = position[static_cast<std::size_t>(i)];
      if (at >= 0) {
        effect.cumulative.frequency_Hz[i] = step.frequency_Hz[at];
        effect.cumulative.mac[i] = step.mac[at];
        at = step.position[static_cast<std::size_t>(at)];
      }
      effect.cumulative.position.push_back(at);
    }
    study.effects.push_back(std::move(effect));
    last = &now;
  }
  return study;
}

void write_changes(const ChangeStudy& study, const std::filesystem::path& folder) {
  io::CsvWriter csv({"change", "paper_item", "meaning", "mode", "frequency_before_Hz", "frequency_alone_Hz", "effect_alone_pct",
                     "effect_cumulative_pct", "mac_alone", "mac_cumulative"});
  const auto known = [](double value) { return std::isnan(value) ? std::nullopt : std::optional<double>(value); };
  for (const ChangeEffect& effect : study.effects) {
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
