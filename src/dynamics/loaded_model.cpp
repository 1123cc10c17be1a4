#include "dynamics/loaded_model.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/model_check.hpp"
#include "dynamics/unit_slips.hpp"

namespace twindeck::dynamics {

namespace {

LoadedModel prestressed(const ReadModel& read) {
  LoadedModel loaded;
  loaded.source = read.source;
  loaded.structure = read.structure;
  loaded.model = std::shared_ptr<const fe::Model>(loaded.structure, &loaded.structure->model());
  loaded.theta = fe::initial_parameters(*loaded.model);
  loaded.state = loaded.structure->prestress(loaded.theta);
  loaded.system = loaded.structure->system(loaded.state);
  // A prestress is found on the structure without its stays, which refuses a mechanism already.
  if (loaded.model->prestress.rule == fe::PullRule::none) fe::check_no_mechanism(loaded.system, loaded.theta, loaded.source);
  return loaded;
}

}  // namespace

ReadModel valid_model(fe::Model model) {
  ReadModel read;
  read.source = model.source;
  read.structure = std::make_shared<const fe::Structure>(std::move(model));
  return read;
}

LoadedModel from_model(fe::Model model) { return prestressed(valid_model(std::move(model))); }

LoadedModel solvable(const ReadModel& read) {
  if (read.structure) return with_sound_matrices(prestressed(read));
  LoadedModel loaded;
  loaded.source = read.source;
  loaded.system = read.matrices;
  loaded.theta = loaded.system.initial();
  return with_sound_matrices(std::move(loaded));
}

ReadModel with_displacements(ReadModel read, const std::string& displacements, int load_steps) {
  if (displacements == "as_model" || !read.structure) return read;
  fe::Model model = read.structure->model();
  model.prestress.displacements = displacements == "large" ? fe::Displacements::large : fe::Displacements::linear;
  model.prestress.load_steps = load_steps;
  return valid_model(std::move(model));
}

LoadedModel with_values(const LoadedModel& loaded, const Eigen::VectorXd& theta) {
  LoadedModel changed = loaded;
  changed.theta = theta;
  if (loaded.structure) {  // the matrices as the updating saw them: same parameters, prestress of the new values
    changed.state = loaded.structure->prestress(theta);
    changed.system = loaded.structure->system(changed.state);
  }
  return changed;
}

EigenModes available_modes(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, int n_modes) {
  return ModalSolver(system).solve_available(theta, n_modes);
}

int modes_for_band(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, int n_modes,
                   const Eigen::VectorXd& measured_Hz, double error) {
  constexpr int most = 200;  // what steps solve for at most
  ModalSolver solver(system);
  const double highest = highest_of_band(measured_Hz);
  double wanted = highest;
  for (int n = n_modes;; n = std::min(2 * n, most)) {
    const Eigen::VectorXd found = solver.solve_available(theta, n).frequency_Hz;
    const auto below = static_cast<int>((found.array() < wanted).count());
    if (n == n_modes && below < found.size()) return n_modes;
    wanted = (1.0 + error) * highest;
    if (found.size() < n || n >= most || found[found.size() - 1] >= wanted)
      return std::max(n_modes, static_cast<int>((found.array() < wanted).count()));
  }
}

}  // namespace twindeck::dynamics
