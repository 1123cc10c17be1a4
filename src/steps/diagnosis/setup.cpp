#include "steps/diagnosis/setup.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "diagnosis/null_calibration.hpp"
#include "io/csv.hpp"
#include "matching/mode_name.hpp"
#include "steps/diagnosis/catalogue.hpp"
#include "steps/diagnosis/features.hpp"
#include "steps/diagnosis/rows_in_use.hpp"
#include "steps/diagnosis/threshold_file.hpp"
#include "steps/measured/measured_tables.hpp"
#include "steps/shared/shipped_files.hpp"
#include "steps/shared/study.hpp"
#include "steps/shared/unit_slips.hpp"

namespace twindeck::steps {

namespace {

std::filesystem::path catalogue_folder(const DiagnosisConfig& config, const StepContext& context) {
  if (const auto given = context.flag("catalogue")) return *given;
  if (!config.catalogue.empty()) return config.catalogue;
  const std::filesystem::path catalogue = "workflows/common/hypotheses";
  if (!context.study.empty()) {  // of the tree that the study lies in
    const auto beside = context.study.parent_path() / "common/hypotheses";
    if (!std::filesystem::is_directory(catalogue) && std::filesystem::is_directory(beside)) return beside;
  }
  return shipped(catalogue);
}

/// @param model  null for a matrix model, which has no dampers
std::vector<diagnosis::DamperMove> read_damper_places(const std::filesystem::path& file, const fe::Model* model) {
  const auto table = io::CsvTable::read(file, {"alternative", "damper", "x_m", "y_m", "z_m"}, {});
  std::vector<std::string> known;
  if (model != nullptr)
    for (const fe::Spring& spring : model->springs)
      if (diagnosis::can_be_moved(spring)) known.push_back(spring.name);
  std::vector<diagnosis::DamperMove> moves;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::string name = table.text(r, "alternative"), damper = table.text(r, "damper");
    if (std::find(known.begin(), known.end(), damper) == known.end())
      table.fail(
          r, "damper",
          fmt::format("'{}' is no damper of the model between a node and the ground{}", damper, did_you_mean(damper, known)),
          known.empty() ? "the model has none: leave damper_places out"
                        : fmt::format("name one of its springs.csv: {}", fmt::join(known, ", ")));
    if (moves.empty() || moves.back().name != name) moves.push_back({name, {}, {}});
    moves.back().dampers.push_back(damper);
    moves.back().x_m.emplace_back(table.number(r, "x_m"), table.number(r, "y_m"), table.number(r, "z_m"));
  }
  return moves;
}

/// Measured frequencies of each condition.
std::vector<MeasuredFrequencies> frequencies_of(const diagnosis::FeatureSet& features) {
  std::vector<MeasuredFrequencies> conditions(features.conditions.size());
  for (const diagnosis::Row& row : features.rows) {
    if (row.type != diagnosis::RowType::frequency) continue;
    MeasuredFrequencies& found = conditions[static_cast<std::size_t>(row.condition)];
    found.names.push_back(fmt::format("{} of {}", row.mode, features.conditions[static_cast<std::size_t>(row.condition)].name));
    found.frequency_Hz.conservativeResize(found.frequency_Hz.size() + 1);
    found.frequency_Hz.tail<1>()[0] = row.value;
  }
  std::erase_if(conditions, [](const MeasuredFrequencies& found) { return found.names.empty(); });
  return conditions;
}

/// How many modes a basis takes up.
struct BasisSize {
  int modes = 0;      ///< of the structure as it stands
  int corrected = 0;  ///< least number of the lowest that corrections are made for
};

/// Places and reduced model of the model as it is now.
void reduce(const diagnosis::PlaceOptions& place_options, const BasisSize& size, DiagnosisInputs& inputs) {
  diagnosis::Structure& structure = inputs.structure;
  structure = inputs.model->structure();
  inputs.places = diagnosis::find_places(structure, place_options);
  structure.load_tests = load_tests_in_use(*inputs.model, structure, inputs.places, inputs.features, inputs.load_tests);
  diagnosis::ReductionOptions reduction;
  reduction.modes = size.modes;
  // Fits end far from where the basis is made (full_model): parameters on bounds, element scatter off by several deviations.
  reduction.parameter_vectors = 60;
  reduction.least_correction = 2.5e-4;
  reduction.element_change = 0.1;
  std::set<std::string> measured;
  for (const diagnosis::Row& row : inputs.features.rows)
    if (row.type == diagnosis::RowType::frequency) measured.insert(row.mode);
  reduction.corrected_modes = std::max({12, static_cast<int>(measured.size()) + 2, size.corrected});
  inputs.reduced = std::make_unique<diagnosis::ReducedModel>(structure, inputs.places, reduction);
}

/// Where measured modes are those of stays that swing, the model gets these stays as cables. It stays as it was where no more
/// modes are explained then, dampers and all conditions included.
void swing_stays(const DiagnosisConfig& config, const diagnosis::PlaceOptions& place_options,
                 const std::vector<diagnosis::Row>& stay_rows, DiagnosisInputs& inputs) {
  constexpr double alike = 0.6;  // MAC where least_mac says nothing: below it two shapes share less than they do not
  const diagnosis::BarStaysOptions options{config.least_mac > 0.0 ? config.least_mac : alike,
                                           2 * static_cast<int>(config.modes)};
  auto found = diagnosis::find_bar_stays(inputs.model->structure(), inputs.features, stay_rows, options);
  if (!found) return;
  const ModesExplained before = modes_explained(*inputs.reduced, inputs.features, config.scatter, found->rule);
  auto bars = inputs.model;
  inputs.model = std::make_shared<DiagnosedModel>(*bars);
  inputs.model->loaded = from_model(std::move(found->extended));
  const BasisSize as_bars{static_cast<int>(config.modes), 0};
  reduce(place_options, {std::max(as_bars.modes, found->modes_in_basis), found->modes_in_band + 2}, inputs);
  const ModesExplained after = modes_explained(*inputs.reduced, inputs.features, config.scatter, found->rule);
  if (after.explained > before.explained) {
    inputs.bar_stays.emplace(std::move(found->stays), found->log_odds, before, after);
    return;
  }
  inputs.model = bars;
  reduce(place_options, as_bars, inputs);
}

}  // namespace

DiagnosisInputs read_diagnosis_inputs(const DiagnosisConfig& config, StepContext& context) {
  DiagnosisInputs inputs;
  std::filesystem::path folder;
  if (context.features)
    folder = *context.features;
  else if (!context.study.empty())
    folder = read_study(context.study).features;
  if (folder.empty()) throw InputError({"", 0, ""}, "no features were given", "give --features DIR, or a study with features");
  context.input(folder);
  const MeasuredChoice choice = asked_choice(context);
  inputs.features = read_all_features(folder, choice);
  inputs.corrected = choice.corrections;
  std::vector<diagnosis::Row> stay_rows;
  for (const diagnosis::Row& row : inputs.features.rows)
    if (row.type == diagnosis::RowType::stay_frequency) stay_rows.push_back(row);
  choose_rows(config, inputs.features);
  const auto catalogue = catalogue_folder(config, context);
  inputs.catalogue = read_catalogue(std::filesystem::is_directory(catalogue) ? context.input(catalogue) : catalogue);
  if (!config.further_causes.empty())
    for (diagnosis::Hypothesis& h : read_catalogue(context.input(config.further_causes))) {
      const auto same = [&](const diagnosis::Hypothesis& other) { return other.id == h.id && other.set == h.set; };
      if (std::any_of(inputs.catalogue.begin(), inputs.catalogue.end(), same))
        throw InputError({h.file, 1, "id"}, fmt::format("'{}' stands at {} in the catalogue already", h.id, h.set),
                         "give it another set of places, or another id");
      inputs.catalogue.push_back(std::move(h));
    }
  std::vector<Channel> channels;
  if (std::filesystem::exists(folder / "channels.csv")) channels = read_channels(folder / "channels.csv");
  const auto updated = context.results / "s6_updating" / "model";
  // A study that updates nothing is diagnosed on its own model.
  const bool own = !context.model && !context.study.empty() && !std::filesystem::is_directory(updated) &&
                   !read_study(context.study).model_folder.empty();
  const LoadedModel loaded = own ? load_study_model(context, "") : load_model(context, updated);
  if (!loaded.state.status.converged) throw InputError({loaded.source, 0, ""}, loaded.state.status.message, "");
  refuse_unknown_loads(folder, loaded.source);
  inputs.load_tests = {loaded.source, folder / "channels.csv"};
  inputs.model = prepare_model(loaded, channels, config.sensor_tolerance_m);
  diagnosis::PlaceOptions place_options{static_cast<int>(config.zones), static_cast<int>(config.nodes), {}, {}, {}};
  if (!config.damper_places.empty())
    place_options.moves = read_damper_places(context.input(config.damper_places), loaded.fe_model());
  reduce(place_options, {static_cast<int>(config.modes), 0}, inputs);
  refuse_unknown_stays(inputs.features, inputs.places, folder);
  if (config.stays == "auto") swing_stays(config, place_options, stay_rows, inputs);
  inputs.account = account_of(read_claims(folder), inputs.features, channels, inputs.places);
  warn_of_unit_slips(context, loaded, inputs.reduced->frequency_Hz, frequencies_of(inputs.features));
  const std::size_t swinging = inputs.bar_stays ? inputs.bar_stays->stays() : 0;
  if (const auto unpaired = leave_out_unpaired(config, *inputs.reduced, swinging, inputs.features))
    inputs.account.push_back(*unpaired);
  hold_out(config, inputs.features);
  return inputs;
}

std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                       std::vector<std::string>* unmeasured) {
  std::map<std::string, int> bound;
  for (const matching::NamedPair& pair :
       matching::read_pairs(config.pairs, inputs.reduced->mode_coordinates.cols(), {"", 0, "pairs"}, "raise modes")) {
    const std::size_t before = bound.size();
    for (const diagnosis::Row& row : inputs.features.rows)
      if (matching::experimental_label(row.mode) == pair.experimental) bound[row.mode] = static_cast<int>(pair.numerical);
    if (bound.size() == before && unmeasured != nullptr) unmeasured->push_back(pair.experimental);
  }
  return bound;
}

Threshold find_threshold(const DiagnosisConfig& config, const DiagnosisInputs& inputs, const diagnosis::Inference& inference,
                         StepContext& context) {
  std::filesystem::path folder = config.threshold_cache;
  if (folder.empty()) folder = (context.results.empty() ? context.out.parent_path() : context.results) / "thresholds";
  const std::string key = threshold_key(config, inputs, inference, context.seed);
  const auto file = threshold_file(folder, key);
  // The same words whether they were kept or run now: a second run gives the same bytes.
  const std::string from = fmt::format("{} nulls, {}", config.nulls, file.filename().string());
  if (const auto kept = read_threshold(file, key)) {
    context.input(file);
    return {*kept, from};
  }
  if (config.nulls <= 0) return {diagnosis::analytic_threshold(inference, config.alpha), "analytic tail"};
  diagnosis::SearchOptions search = config.search;
  search.most_refined = static_cast<int>(config.most_refined);
  const auto nulls = diagnosis::run_null_calibration(
      *inputs.reduced, inputs.features, config.scatter, inputs.catalogue, search, static_cast<int>(config.nulls),
      context.seed + 17, [&](int done) { context.progress("null data sets", done, static_cast<double>(config.nulls)); },
      bound_modes(config, inputs));
  std::vector<double> sorted = nulls.log_odds;
  std::sort(sorted.begin(), sorted.end());
  const auto at = static_cast<std::size_t>(std::ceil((1.0 - config.alpha) * static_cast<double>(sorted.size()))) - 1;
  const double threshold = sorted[std::min(at, sorted.size() - 1)];
  write_threshold(threshold, config.nulls, 1.0 - config.alpha, file, key);
  context.input(file);
  return {read_threshold(file, key).value_or(threshold), from};  // as it is kept, to six decimals
}

}  // namespace twindeck::steps
