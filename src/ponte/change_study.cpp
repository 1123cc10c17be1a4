#include "ponte/change_study.hpp"

#include <memory>
#include <utility>

#include "core/parallel.hpp"
#include "matching/measured.hpp"

namespace twindeck::ponte {

ChangeStudy study_changes(const std::filesystem::path& bridge_toml, const std::string& mesh, int n_modes, int extra_modes,
                          const std::function<void(int done, int of)>& progress) {
  const std::vector<Change> changes = ponte::as_built_changes(bridge_toml);
  const auto n_changes = static_cast<int>(changes.size());
  // Model 0 is the preliminary one; 1 … n each change alone; n + 1 … 2 n - 1 the first two, the first three, … together.
  std::vector<std::vector<std::string>> switched(1);
  for (const Change& change : changes) switched.push_back({change.name});
  for (int k = 1; k < n_changes; ++k) {
    std::vector<std::string> names;
    for (int i = 0; i <= k; ++i) names.push_back(changes[static_cast<std::size_t>(i)].name);
    switched.push_back(names);
  }
  const auto count = static_cast<int>(switched.size());
  std::vector<matching::SolvedModel> models(switched.size());
  const auto solve = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    matching::SolvedModel& solved = models[at];
    solved = matching::solve_modes(dynamics::from_model(ponte::generate_with_changes(bridge_toml, switched[at], mesh)),
                                   n_modes + extra_modes);
    // What following needs is kept; the assembled terms of sixteen models at once would fill the memory.
    solved.loaded.model = std::make_shared<const fe::Model>(*solved.loaded.model);
    solved.loaded.structure.reset();
    solved.loaded.system.stiffness_terms = solved.loaded.system.mass_terms = {};
  };
  parallel_for_told(count, solve, progress);

  ChangeStudy study;
  study.before_Hz = models[0].modes.frequency_Hz.head(n_modes);
  for (const matching::SolvedModel& model : models)
    if (!model.modes.status.converged && study.status.converged) study.status = model.modes.status;
  std::vector<int> position;  // of each preliminary mode in the last cumulative state
  for (int i = 0; i < n_modes; ++i) position.push_back(i);
  const matching::SolvedModel* last = &models[0];
  for (int k = 0; k < n_changes; ++k) {
    ChangeEffect effect{
        changes[static_cast<std::size_t>(k)], follow(models[0], models[static_cast<std::size_t>(k + 1)], n_modes), {}};
    const matching::SolvedModel& now = models[static_cast<std::size_t>(k == 0 ? 1 : n_changes + k)];
    const matching::TrackedModes step = follow(*last, now, last->modes.frequency_Hz.size());
    effect.cumulative = {
        Eigen::VectorXd::Constant(n_modes, matching::kUnknown), Eigen::VectorXd::Constant(n_modes, matching::kUnknown), {}};
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

}  // namespace twindeck::ponte
