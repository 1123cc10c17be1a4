/// Step 1 (paper section 2.2, Fig. 5): the finite element model, its dead load and prestress, its modes.
#include <fmt/format.h>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/model_check.hpp"
#include "dynamics/unit_slips.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/modes_io.hpp"
#include "model_io/vtu.hpp"
#include "ponte/generator.hpp"
#include "runner/run_step.hpp"
#include "runner/study.hpp"
#include "steps/model/channels_on_model.hpp"
#include "steps/model/exports.hpp"
#include "steps/model/model_config.hpp"
#include "steps/model/model_tables.hpp"
#include "steps/shared/model_source.hpp"

namespace {

using namespace twindeck;

Status run(const steps::ModelConfig& config, const dynamics::ReadModel& read, bool is_bridge, runner::StepContext& context) {
  // 1. The model, prestressed and assembled; a mechanism is refused here.
  const dynamics::LoadedModel loaded = dynamics::solvable(read);
  const fe::Model* model = loaded.fe_model();
  context.say(fmt::format("{}: {} degrees of freedom", loaded.source, loaded.system.size()));

  // 2. Its modes.
  dynamics::ModalSolver solver(loaded.system);
  const dynamics::EigenModes modes = solver.solve_available(loaded.theta, config.n_modes);
  const long found = modes.frequency_Hz.size();
  if (config.n_modes != steps::ModelConfig().n_modes || found == 0)
    dynamics::refuse_more_modes_than_there_are(config.n_modes, loaded, modes);
  else if (found < config.n_modes)
    context.say(
        fmt::format("the model has {} of the {} modes that are computed where n_modes is not set", found, config.n_modes));
  dynamics::warn_of_unit_slips(context, loaded, modes.frequency_Hz, {});

  // 3. Modes and shapes, a picture, tables of stays, members, dampers and sizes, the model as a folder for any other step.
  model_io::write_modes(model_io::published_modes(model, loaded.system, modes), context.out);
  if (model != nullptr) model_io::write_vtu(*model, loaded.system, modes, context.out / "model.vtu");
  steps::write_model_tables(loaded, is_bridge ? steps::PartOf(ponte::part_of) : steps::PartOf(), context.out);
  model_io::save_model(loaded, loaded.theta, context.out / "model");
  steps::write_exports(loaded, modes, config.n_modes, context);

  // 4. The same modes on other meshes, which show the discretisation error.
  if (!config.meshes.empty() && is_bridge)
    steps::write_mesh_convergence(runner::read_study(context.study), config.variant, config.meshes, config.n_modes,
                                  context.out / "mesh_convergence.csv");
  return loaded.state.status.converged ? modes.status : loaded.state.status;
}

runner::Computation read(const steps::ModelConfig& config, runner::StepContext& context) {
  const dynamics::ReadModel model =
      dynamics::with_displacements(steps::load_study_model(context, config.variant), config.displacements, config.load_steps);
  const bool is_bridge = !context.model && runner::read_study(context.study).model_generator == "ponte";
  steps::warn_of_channels_off_the_model(context, model);
  if (is_bridge) steps::refuse_unknown_meshes(runner::read_study(context.study), config.variant, config.meshes);
  return [&config, &context, model, is_bridge] { return run(config, model, is_bridge, context); };
}

}  // namespace

int main(int argc, char** argv) {
  steps::ModelConfig config;
  runner::Step step;
  step.token = "s1_model";
  step.summary = "Builds or reads the finite element model, finds its prestress and its modes.";
  step.examples = {"s1_model --study workflows/ponte_del_mare --out results/ponte_del_mare/s1_model --set variant=refined",
                   "s1_model --model my_bridge --out results/my_bridge/s1_model --export-matrices",
                   "s1_model --model frame.inp --out results/frame/s1_model --export-inp"};
  step.fields = config.fields();
  step.flags = steps::export_flags();
  step.read = [&config](runner::StepContext& context) { return read(config, context); };
  return runner::run_step(argc, argv, std::move(step));
}
