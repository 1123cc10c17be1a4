#include "steps/shared/model_source.hpp"

#include <utility>

#include "fe/mass_properties.hpp"
#include "model_io/ansys.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/nastran.hpp"
#include "model_io/printed_mass.hpp"
#include "model_io/sap2000.hpp"
#include "ponte/generator.hpp"
#include "runner/study.hpp"

namespace twindeck::steps {

namespace {

/// Reads a file of CalculiX, Abaqus, ANSYS, Nastran or SAP2000, registers it with the files that belong to it, and reports what
/// it cannot use, and the mass, centre and inertia of the whole: a lost part, a wrong density or unit shows there first.
dynamics::ReadModel import_file(runner::StepContext& context, const std::filesystem::path& file) {
  context.input(file);
  auto beside = file;
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) context.input(beside);
  model_io::ImportedModel imported = model_io::is_sap2000_file(file)   ? model_io::read_sap2000(file)
                                     : model_io::is_nastran_file(file) ? model_io::read_nastran(file)
                                     : model_io::is_ansys_deck(file)   ? model_io::read_ansys(file)
                                                                       : model_io::read_inp(file);
  for (const std::filesystem::path& read : imported.files) context.input(read);
  for (const std::string& note : imported.notes) context.say(note);
  dynamics::ReadModel model = dynamics::valid_model(std::move(imported.model));
  context.say(fe::mass_words(fe::mass_properties(*model.fe_model())));
  if (const std::string printed = model_io::printed_mass(file); !printed.empty())
    context.say("beside it, in the deck's units: " + printed);
  return model;
}

}  // namespace

dynamics::ReadModel load_model(runner::StepContext& context, const std::filesystem::path& default_folder) {
  const std::filesystem::path folder = context.model.value_or(default_folder);
  if (std::filesystem::is_regular_file(folder)) return import_file(context, folder);
  if (!std::filesystem::is_directory(folder)) {
    const std::string step = default_folder.parent_path().filename().string();
    throw InputError({folder.string(), 0, ""}, "is not there, expected a model folder",
                     context.model ? "give --model (or the key `model`) the folder that holds model.toml"
                                   : "run " + step + " first, or give a model folder by --model DIR");
  }
  return model_io::read_model_folder(context.input(folder));
}

dynamics::ReadModel load_study_model(runner::StepContext& context, const std::string& variant) {
  if (context.model) return load_model(context, *context.model);
  if (context.study.empty())
    throw InputError({"", 0, ""}, "neither a study nor a model was given", "give --study workflows/<study> or --model DIR");
  const runner::Study study = runner::read_study(context.study);
  if (!study.model_inp.empty()) return import_file(context, study.model_inp);
  if (study.model_folder.empty() && study.model_generator.empty())
    throw InputError({(context.study / "study.toml").string(), 0, "model"}, "names no model",
                     "give [model] generator and file, or folder, or a model folder by --model DIR");
  if (study.model_generator.empty()) return model_io::read_model_folder(context.input(study.model_folder));
  return dynamics::valid_model(ponte::generate(context.input(study.model_file), variant, study.model_mesh));
}

}  // namespace twindeck::steps
