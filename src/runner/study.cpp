#include "runner/study.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/config.hpp"

namespace twindeck::runner {

namespace {

/// study.toml in the words of the file.
struct StudyFile {
  Study study;
  std::string file, model_folder, inp, features;

  io::FieldTable fields() {
    io::FieldTable table;
    table.text("title", study.title, "one line that names the study in reports", true)
        .integer("seed", study.seed, io::non_negative(), "seed of everything random in the study")
        .choice("measured", study.measured, {"published", "virtual"}, "where the measured modes come from")
        .text("features", features, "folder of measured features: rows.csv, conditions.toml, channels.csv")
        .texts("steps", study.steps, "tokens of the steps in the order in which they run")
        .choice("model.generator", study.model_generator, {"ponte"}, "parametric generator that writes the model")
        .text("model.file", file, "what the generator reads")
        .text("model.mesh", study.model_mesh, "mesh of the generator by name (ponte: full, medium, coarse); empty: its own")
        .text("model.folder", model_folder, "a model folder, instead of a generator")
        .text("model.inp", inp, "a deck of CalculiX, Abaqus, Nastran, ANSYS or SAP2000, instead of a generator or a folder");
    return table;
  }
};

/// The steps there are (docs/method_and_limits.md).
const std::vector<std::string> known_steps = {"s0_campaign",   "s1_model",       "s2_sensors",     "s3_identification",
                                              "s4_refinement", "s5_sensitivity", "s6_updating",    "s7_aerodynamics",
                                              "s8_validation", "s9_diagnosis",   "s10_reliability"};

void check_steps(const std::vector<std::string>& steps, const std::filesystem::path& file) {
  for (const std::string& step : steps)
    if (!contains(known_steps, step))
      throw InputError({file.string(), 0, "steps"}, fmt::format("'{}' is no step{}", step, did_you_mean(step, known_steps)),
                       fmt::format("the steps are {}", fmt::join(known_steps, ", ")));
}

}  // namespace

std::string describe_study() { return StudyFile{}.fields().describe(); }

Study read_study(const std::filesystem::path& folder) {
  StudyFile entry;
  const std::filesystem::path path = folder / "study.toml";
  entry.fields().load(path);
  check_steps(entry.study.steps, path);
  auto& [study, file, model_folder, inp, features] = entry;
  const bool generated = !study.model_generator.empty() || !file.empty();
  const int sources = (generated ? 1 : 0) + (model_folder.empty() ? 0 : 1) + (inp.empty() ? 0 : 1);
  if (sources > 1)
    throw InputError({path.string(), 0, "model"}, "names more than one of generator, folder and inp", "keep one of them");
  if (generated && (study.model_generator.empty() || file.empty()))
    throw InputError({path.string(), 0, "model"}, "names only one of generator and file", "give both");
  study.model_file = file;
  study.model_folder = model_folder;
  study.model_inp = inp;
  study.features = features;
  return study;
}

}  // namespace twindeck::runner
