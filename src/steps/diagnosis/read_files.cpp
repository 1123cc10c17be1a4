#include "steps/diagnosis/read_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "diagnosis/files/catalogue_files.hpp"
#include "diagnosis/files/claims_file.hpp"
#include "diagnosis/files/damper_places.hpp"
#include "diagnosis/files/feature_files.hpp"
#include "diagnosis/files/load_test_files.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "io/spreadsheet.hpp"
#include "matching/mode_name.hpp"
#include "matching/shapes_at_sensors.hpp"
#include "runner/shipped_files.hpp"
#include "runner/study.hpp"

namespace twindeck::steps {

namespace {

std::filesystem::path catalogue_folder(const DiagnosisConfig& config, const runner::StepContext& context) {
  if (const auto given = context.flag("catalogue")) return *given;
  if (!config.catalogue.empty()) return config.catalogue;
  const std::filesystem::path catalogue = "workflows/common/hypotheses";
  if (!context.study.empty()) {  // of the tree that the study lies in
    const auto beside = context.study.parent_path() / "common/hypotheses";
    if (!std::filesystem::is_directory(catalogue) && std::filesystem::is_directory(beside)) return beside;
  }
  return runner::shipped(catalogue);
}

void read_measurement(const DiagnosisConfig& config, runner::StepContext& context, DiagnosisFiles& files) {
  if (context.features)
    files.folder = *context.features;
  else if (!context.study.empty())
    files.folder = runner::read_study(context.study).features;
  if (files.folder.empty())
    throw InputError({"", 0, ""}, "no features were given", "give --features DIR, or a study with features");
  context.input(files.folder);
  const records::MeasuredChoice choice = asked_choice(context);
  files.features = diagnosis::read_all_features(files.folder, choice);
  files.corrected = choice.corrections;
  for (const diagnosis::Row& row : files.features.rows)
    if (row.type == diagnosis::RowType::stay_frequency) files.stay_rows.push_back(row);
  diagnosis::choose_rows(config.rows, files.features);
  if (io::has_table(files.folder / "channels.csv")) files.channels = records::read_channels(files.folder / "channels.csv");
  files.claims = diagnosis::read_claims(files.folder);
}

std::vector<diagnosis::Hypothesis> read_causes(const DiagnosisConfig& config, runner::StepContext& context) {
  const auto folder = catalogue_folder(config, context);
  std::vector<diagnosis::Hypothesis> causes =
      diagnosis::read_catalogue(std::filesystem::is_directory(folder) ? context.input(folder) : folder);
  if (config.further_causes.empty()) return causes;
  for (diagnosis::Hypothesis& h : diagnosis::read_catalogue(context.input(config.further_causes))) {
    const auto same = [&](const diagnosis::Hypothesis& other) { return other.id == h.id && other.set == h.set; };
    if (std::any_of(causes.begin(), causes.end(), same))
      throw InputError({h.file, 1, "id"}, fmt::format("'{}' stands at {} in the catalogue already", h.id, h.set),
                       "give it another set of places, or another id");
    causes.push_back(std::move(h));
  }
  return causes;
}

dynamics::ReadModel read_diagnosed_model(runner::StepContext& context) {
  const auto updated = context.results / "s6_updating" / "model";
  // A study that updates nothing is diagnosed on its own model.
  const bool own = !context.model && !context.study.empty() && !std::filesystem::is_directory(updated) &&
                   !runner::read_study(context.study).model_folder.empty();
  return own ? load_study_model(context, "") : load_model(context, updated);
}

/// Names in one file or the configuration that another file must have.
void refuse_unknown_names(const DiagnosisConfig& config, const DiagnosisFiles& files) {
  diagnosis::refuse_unknown_loads(files.folder, files.model.source);
  diagnosis::refuse_unplaced_load_tests(files.features, files.channels, files.model,
                                        {files.model.source, files.folder / "channels.csv"});
  diagnosis::refuse_unknown_stays(files.features, files.model.fe_model(), files.folder);
  refuse_unplaced_channels(diagnosis::channels_at_points(files.channels), files.model, config.sensor_tolerance_m);
  // How many modes the basis has is known once the model is reduced.
  static_cast<void>(
      matching::read_pairs(config.pairs, std::numeric_limits<Eigen::Index>::max(), {"", 0, "pairs"}, "raise modes"));
  if (config.hold_out.empty()) return;
  diagnosis::FeatureSet rows = files.features;
  diagnosis::hold_out(config.hold_out, rows);
}

}  // namespace

DiagnosisFiles read_diagnosis_files(const DiagnosisConfig& config, runner::StepContext& context) {
  DiagnosisFiles files;
  read_measurement(config, context, files);
  files.catalogue = read_causes(config, context);
  files.model = read_diagnosed_model(context);
  refuse_unknown_names(config, files);
  if (!config.damper_places.empty())
    files.moves = diagnosis::read_damper_places(context.input(config.damper_places), files.model.fe_model());
  return files;
}

}  // namespace twindeck::steps
