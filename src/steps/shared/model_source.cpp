#include "steps/shared/model_source.hpp"

#include <utility>

#include "fe/mass_words.hpp"
#include "model_io/ansys.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/nastran.hpp"
#include "model_io/printed_mass.hpp"
#include "ponte/generator.hpp"
#include "runner/study.hpp"

namespace twindeck::steps {

namespace {

/// Mass, centre and inertia: a lost part, a wrong density or unit shows there first.
dynamics::ReadModel with_mass_said(const runner::StepContext& context, const std::filesystem::path& file,
                                   dynamics::ReadModel read) {
  context.say(fe::mass_words(fe::mass_properties(*read.fe_model())));
  if (const std::string printed = model_io::printed_mass(file); !printed.empty())
    context.say("beside it, in the deck's units: " + printed);
  return read;
}

/// Reads an .inp file of CalculiX or Abaqus, or a deck of ANSYS, and reports what it cannot use, with the mass of the whole.
dynamics::ReadModel import_inp(runner::StepContext& context, const std::filesystem::path& file) {
  context.input(file);
  auto beside = file;
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) context.input(beside);
  model_io::InpModel imported = model_io::is_ansys_deck(file) ? model_io::read_ansys(file) : model_io::read_inp(file);
  for (const std::string& note : imported.notes) context.say(note);
  return with_mass_said(context, file, dynamics::valid_model(std::move(imported.model)));
}

/// Reads a Nastran deck, registers the files that it includes, and reports what it cannot use.
dynamics::ReadModel import_nastran(runner::StepContext& context, const std::filesystem::path& file) {
  auto beside = file;
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) context.input(beside);
  model_io::NastranModel imported = model_io::read_nastran(file);
  for (const std::filesystem::path& read : imported.files) context.input(read);
  for (const std::string& note : imported.notes) context.say(note);
  return with_mass_said(context, file, dynamics::valid_model(std::move(imported.model)));
}

dynamics::ReadModel import_file(runner::StepContext& context, const std::filesystem::path& file) {
  return model_io::is_nastran_file(file) ? import_nastran(context, file) : import_inp(context, file);
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
  if (context.study.empty()) {
    throw InputError({"", 0, ""}, "neither a study nor a model was given", "give --study workflows/<study> or --model DIR");
  }
  const runner::Study study = runner::read_study(context.study);
  if (!study.model_inp.empty()) return import_file(context, study.model_inp);
  if (study.model_folder.empty() && study.model_generator.empty()) {
    throw InputError({(context.study / "study.toml").string(), 0, "model"}, "names no model",
                     "give [model] generator and file, or folder, or a model folder by --model DIR");
  }
  if (study.model_generator.empty()) return model_io::read_model_folder(context.input(study.model_folder));
  return dynamics::valid_model(ponte::generate(context.input(study.model_file), variant, study.model_mesh));
}

}  // namespace twindeck::steps
