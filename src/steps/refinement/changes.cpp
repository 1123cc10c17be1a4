#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "io/csv.hpp"
#include "modal/mac.hpp"
#include "modal/pairing.hpp"
#include "steps/refinement/refinement.hpp"
#include "steps/shared/measured.hpp"

namespace twindeck::steps {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

bool same_dofs(const fe::ParametricSystem& a, const fe::ParametricSystem& b) {
  if (a.dofs.size() != b.dofs.size()) return false;
  for (std::size_t i = 0; i < a.dofs.size(); ++i) {
    if (a.dofs[i].node != b.dofs[i].node || a.dofs[i].direction != b.dofs[i].direction || a.dofs[i].x_m != b.dofs[i].x_m)
      return false;
  }
  return true;
}

/// Nodes by position to the nearest 0.1 mm; of several at one place the first counts.
std::map<std::array<long, 3>, Index> nodes_by_place(const fe::Model& model) {
  std::map<std::array<long, 3>, Index> at;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Vector3d x = model.nodes[i].x_m * 1e4;
    at.try_emplace({std::lround(x[0]), std::lround(x[1]), std::lround(x[2])}, static_cast<Index>(i));
  }
  return at;
}

}  // namespace

SolvedModel solve_modes(LoadedModel loaded, int n_modes) {
  SolvedModel solved;
  solved.loaded = std::move(loaded);
  dynamics::ModalSolver solver(solved.loaded.system);
  solved.modes = solver.solve_available(solved.loaded.theta, n_modes);
  solved.mass = solver.mass();
  solved.mass_shapes = solved.mass.selfadjointView<Eigen::Lower>() * solved.modes.shapes;
  if (!solved.loaded.state.status.converged && solved.modes.status.converged) solved.modes.status = solved.loaded.state.status;
  return solved;
}

MatrixXd mac_between(const SolvedModel& a, const SolvedModel& b) {
  if (same_dofs(a.loaded.system, b.loaded.system)) {
    // b is normalised with its own mass; divided by its norm in a's, the entries are squared cosines.
    const Eigen::VectorXd norm =
        b.modes.shapes.cwiseProduct(a.mass.selfadjointView<Eigen::Lower>() * b.modes.shapes).colwise().sum();
    return modal::mass_weighted_mac(a.mass_shapes, b.modes.shapes) * norm.cwiseInverse().asDiagonal();
  }
  if (!a.loaded.model || !b.loaded.model) {
    throw InputError({b.loaded.source, 0, ""}, "has other degrees of freedom than " + a.loaded.source,
                     "compare models of the same degrees of freedom");
  }
  const MatrixXd full_a = a.loaded.system.expand(a.modes.shapes), full_b = b.loaded.system.expand(b.modes.shapes);
  const auto places_b = nodes_by_place(*b.loaded.model);
  std::vector<Index> rows_a, rows_b;
  for (const auto& [place, node_a] : nodes_by_place(*a.loaded.model)) {
    const auto at = places_b.find(place);
    if (at == places_b.end()) continue;
    for (Index d = 0; d < 3; ++d) {
      rows_a.push_back(6 * node_a + d);
      rows_b.push_back(6 * at->second + d);
    }
  }
  const MatrixXd common_a = full_a(rows_a, Eigen::all), common_b = full_b(rows_b, Eigen::all);
  return modal::mac(common_a, common_b);
}

FollowedModes follow(const SolvedModel& reference, const SolvedModel& changed, Index count) {
  const MatrixXd likeness = mac_between(reference, changed);
  // Every mode of the reference takes part in the assignment, so that a partner is not given to one and claimed by another.
  const std::vector<int> position = modal::follow_modes(likeness);
  FollowedModes followed{Eigen::VectorXd::Constant(count, kUnknown), Eigen::VectorXd::Constant(count, kUnknown), {}};
  for (Index i = 0; i < count; ++i) {
    const int at = position[static_cast<std::size_t>(i)];
    followed.position.push_back(at);
    if (at < 0) continue;
    followed.frequency_Hz[i] = changed.modes.frequency_Hz[at];
    followed.mac[i] = likeness(i, at);
  }
  return followed;
}

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
    for (Index i = 0; i < study.before_Hz.size(); ++i) {
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
