#include "steps/model/export_inp.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model_io/inp.hpp"

namespace twindeck::steps {

void export_inp(const dynamics::LoadedModel& loaded, int n_modes, const runner::StepContext& context) {
  if (loaded.fe_model() == nullptr) {
    throw InputError({"command line", 0, "--export-inp"}, "a matrix model has no elements to export", "use --export-matrices");
  }
  const auto write = [&](model_io::InpFlavour flavour, const char* file) {
    return model_io::write_inp(*loaded.model, loaded.state, flavour, n_modes, context.out / file);
  };
  const auto calculix = write(model_io::InpFlavour::calculix, "model.inp");
  const auto abaqus = write(model_io::InpFlavour::abaqus, "model_abaqus.inp");
  const auto is_in = [](const std::vector<std::string>& notes, const std::string& note) {
    return std::find(notes.begin(), notes.end(), note) != notes.end();
  };
  for (const std::string& note : calculix)
    context.say((is_in(abaqus, note) ? "model.inp, model_abaqus.inp: " : "model.inp: ") + note);
  for (const std::string& note : abaqus)
    if (!is_in(calculix, note)) context.say("model_abaqus.inp: " + note);
}

}  // namespace twindeck::steps
