#include "steps/model/exports.hpp"

#include "model_io/export_matrices.hpp"
#include "steps/model/export_inp.hpp"
#include "steps/model/export_unv.hpp"

namespace twindeck::steps {

std::vector<runner::Flag> export_flags() {
  return {{"export-matrices", false,
           "also write K.mtx, M.mtx, dofs.csv of the state whose modes are in modes.csv, and C.mtx where there are dampers"},
          {"export-inp", false, "also write the model for CalculiX (model.inp) and Abaqus (model_abaqus.inp)"},
          {"export-unv", false, "also write mesh and modes as a universal file, model.unv (sets 2411, 2412, 82, 55)"}};
}

void write_exports(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes, int n_modes,
                   const runner::StepContext& context) {
  if (context.has_flag("export-matrices")) {
    model_io::write_matrices(loaded.system, loaded.theta, context.out);
    if (const fe::Model* model = loaded.fe_model(); model != nullptr)
      model_io::write_damping(*model, loaded.system, loaded.theta, context.out);
  }
  if (context.has_flag("export-inp")) export_inp(loaded, n_modes, context);
  if (context.has_flag("export-unv")) export_unv(loaded, modes, context);
}

}  // namespace twindeck::steps
