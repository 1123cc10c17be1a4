#include "steps/model/export_inp.hpp"

#include <string>

#include "core/error.hpp"
#include "model_io/inp.hpp"

namespace twindeck::steps {

void export_inp(const dynamics::LoadedModel& loaded, int n_modes, const runner::StepContext& context) {
  if (loaded.fe_model() == nullptr) {
    throw InputError({"command line", 0, "--export-inp"}, "a matrix model has no elements to export", "use --export-matrices");
  }
  const auto notes =
      model_io::write_inp(*loaded.model, loaded.state, model_io::InpFlavour::calculix, n_modes, context.out / "model.inp");
  for (const std::string& note : notes) context.say("model.inp: " + note);
  model_io::write_inp(*loaded.model, loaded.state, model_io::InpFlavour::abaqus, n_modes, context.out / "model_abaqus.inp");
}

}  // namespace twindeck::steps
