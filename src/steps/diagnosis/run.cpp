#include "steps/diagnosis/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "diagnosis/bar_stays_effect.hpp"
#include "diagnosis/causes/catalogue.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/files/catalogue_files.hpp"
#include "diagnosis/files/damper_places.hpp"
#include "diagnosis/files/feature_files.hpp"
#include "diagnosis/files/load_test_files.hpp"
#include "diagnosis/files/measurement_corrections.hpp"
#include "diagnosis/full_check.hpp"
#include "diagnosis/law_diagnosis.hpp"
#include "diagnosis/reduction/basis_modes.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "dynamics/unit_slips.hpp"
#include "io/spreadsheet.hpp"
#include "matching/mode_name.hpp"
#include "matching/shapes_at_sensors.hpp"
#include "runner/shipped_files.hpp"
#include "runner/study.hpp"
#include "steps/diagnosis/compared_frequencies.hpp"
#include "steps/diagnosis/outputs.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"

/// The step from its inputs to its files, and what it says at the end.
namespace twindeck::steps {
namespace {

struct DiagnosisFiles {
  std::filesystem::path folder;                ///< of the features
  diagnosis::FeatureSet features;              ///< the rows in use
  std::vector<diagnosis::Row> stay_rows;       ///< all frequencies of stays, in use or not
  std::vector<records::Correction> corrected;  ///< corrections that --correct made to the features
  std::vector<matching::Channel> channels;
  std::vector<diagnosis::Claim> claims;
  std::vector<diagnosis::Hypothesis> catalogue;
  dynamics::ReadModel model;
  std::vector<diagnosis::DamperMove> moves;
};

struct DiagnosisInputs {
  std::shared_ptr<diagnosis::DiagnosedModel> model;
  diagnosis::Structure structure;  ///< borrows from `model`
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
  long basis_modes = 0;  ///< number of modes that `reduced` was asked for
  diagnosis::FeatureSet features;
  std::vector<diagnosis::Finding> account;             ///< findings from claims and rows, without odds
  diagnosis::LoadTestFiles load_tests;                 ///< files of the load tests
  std::optional<diagnosis::BarStaysEffect> bar_stays;  ///< set if stays that the model has as bars swing
  /// The model that the causes are put into: `model`, with swinging stays as cables.
  std::shared_ptr<const diagnosis::DiagnosedModel> extended;
};

constexpr double kAlike = 0.6;  ///< [-] default MAC if least_mac is 0: less alike shapes are different modes

/// Refuses a highest measured frequency below which the model has more modes than a basis can hold.
void refuse_endless_basis(const diagnosis::BasisModes& basis, const dynamics::LoadedModel& loaded,
                          const diagnosis::FeatureSet& features, runner::StepContext& context) {
  if (basis.enough) return;
  warn_of_unit_slips(context, loaded, basis.frequency_Hz, frequencies_of(features));  // a slip of units may be the reason
  throw InputError(
      {loaded.source, 0, ""},
      fmt::format("has more than {} modes below {:.4g} Hz, the reach of the basis for the highest measured frequency",
                  basis.frequency_Hz.size(), basis.reach_Hz),
      "set highest_frequency below the measured modes that are too high, or take bodies and cables that swing by "
      "themselves out of the model");
}

/// Makes the locations and the reduced model of the current model.
void reduce(const diagnosis::PlaceOptions& place_options, const diagnosis::BasisModes& basis, DiagnosisInputs& inputs) {
  const diagnosis::Structure& structure = inputs.structure;
  inputs.places = diagnosis::find_places(structure, place_options);
  inputs.structure.load_tests =
      diagnosis::load_tests_in_use(*inputs.model, structure, inputs.places, inputs.features, inputs.load_tests);
  diagnosis::ReductionOptions reduction;
  reduction.modes = basis.modes;
  // Fits can end far from the values at which the basis is made: parameters on bounds, element scatter off by several
  // deviations.
  reduction.parameter_vectors = 60;
  reduction.least_correction = 2.5e-4;
  reduction.element_change = 0.1;
  std::set<std::string> measured;
  for (const diagnosis::Row& row : inputs.features.rows)
    if (row.type == diagnosis::RowType::frequency) measured.insert(row.mode);
  reduction.corrected_modes = std::max({12, static_cast<int>(measured.size()) + 2, basis.in_band + 2});
  inputs.reduced = std::make_unique<diagnosis::ReducedModel>(structure, inputs.places, reduction);
}

/// A reduced model that predicts modes. Its only locations are the dampers, because they change the modes.
diagnosis::ReducedModel reduced_for_modes(const diagnosis::DiagnosedModel& model, int modes, int corrected) {
  const diagnosis::Structure structure = model.structure();
  diagnosis::Places places = diagnosis::find_places(structure, {});
  std::erase_if(places.sets, [](const auto& set) { return set.first != "dampers"; });
  diagnosis::ReductionOptions reduction{.modes = modes, .corrected_modes = corrected};
  return {structure, places, reduction};
}

/// Finds measured modes that are modes of swinging stays. The searched model keeps its bars. Modes that only cables explain are
/// left out of the search, and the extended model gets the cables (decision 0014). Nothing is changed unless cables explain
/// more modes, with dampers and all conditions included.
void swing_stays(const DiagnosisConfig& config, const std::vector<diagnosis::Row>& stay_rows, DiagnosisInputs& inputs) {
  const diagnosis::BarStaysOptions options{config.least_mac > 0.0 ? config.least_mac : kAlike, 2 * config.modes};
  auto found = diagnosis::find_bar_stays(inputs.model->structure(), inputs.features, stay_rows, options);
  if (!found) return;
  const diagnosis::ModesExplained before =
      diagnosis::modes_explained(*inputs.reduced, inputs.features, config.scatter, found->rule);
  auto cables = std::make_shared<diagnosis::DiagnosedModel>(*inputs.model);
  cables->loaded = dynamics::from_model(std::move(found->extended));
  const diagnosis::ReducedModel reduced =
      reduced_for_modes(*cables, std::max(config.modes, found->modes_in_basis), found->modes_in_band + 2);
  const diagnosis::ModesExplained after = diagnosis::modes_explained(reduced, inputs.features, config.scatter, found->rule);
  if (after.explained <= before.explained) return;
  inputs.bar_stays.emplace(std::move(found->stays), found->log_odds, before, after);
  inputs.extended = std::move(cables);
}

std::filesystem::path catalogue_folder(const DiagnosisConfig& config, const runner::StepContext& context) {
  if (const auto given = context.flag("catalogue")) return *given;
  if (!config.catalogue.empty()) return config.catalogue;
  const std::filesystem::path catalogue = "workflows/common/hypotheses";
  if (!context.study.empty()) {  // beside the study's folder
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
    if (std::ranges::any_of(causes, same))
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
  // The number of modes in the basis is known only after the reduction; the pairs are checked against it there.
  static_cast<void>(
      matching::read_pairs(config.pairs, std::numeric_limits<Eigen::Index>::max(), {"", 0, "pairs"}, "raise modes"));
  if (config.hold_out.empty()) return;
  diagnosis::FeatureSet rows = files.features;
  diagnosis::hold_out(config.hold_out, rows);
}

/// Keys of earlier versions, and what has taken their place.
struct Retired {
  const char *name, *problem, *mend;
};

constexpr const char* kOneLaw = "is a key of an earlier method of diagnosis: scales and odds are now estimated from the rows";
constexpr const char* kTable = "leave it out: a verdict needs a probability of 95 % (docs/diagnosis.md)";
constexpr Retired retired[] = {
    {"form", "is a key of an earlier choice between methods of diagnosis: there is one method now",
     "leave it out; for a model that is exact, scales of its errors come out near zero"},
    {"alpha", kOneLaw, kTable},
    {"least_log_odds", kOneLaw, kTable},
    {"either_within", kOneLaw, kTable},
    {"residual_alpha", kOneLaw, kTable},
    {"residual_alpha_named", kOneLaw, kTable},
    {"nulls", "ran null data sets for a threshold that is no longer used", kTable},
    {"threshold_cache", "kept thresholds that are no longer used", kTable},
    {"most_refined", "set how an earlier search went on", "leave it out: the leading entries of every family are fitted"},
    {"refine_within", "set how an earlier search went on", "leave it out: the leading entries of every family are fitted"},
    {"refine_locations", "looked for places between those of the catalogue, which is no longer done",
     "raise nodes and zones instead, for more places"},
};

/// Positions of the computed modes that the configuration gives to measured ones, by the mode's name in rows.csv.
/// @param unmeasured  gets the measured modes of the pairs that no row names
std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                       std::vector<std::string>* unmeasured = nullptr) {
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

/// The reduced model with its locations, and the rows that it is compared with.
DiagnosisInputs prepare_diagnosis(const DiagnosisConfig& config, const DiagnosisFiles& files, runner::StepContext& context) {
  DiagnosisInputs inputs;
  inputs.features = files.features;
  const dynamics::LoadedModel loaded = dynamics::solvable(files.model);
  if (!loaded.state.status.converged) throw InputError({loaded.source, 0, ""}, loaded.state.status.message, "");
  inputs.load_tests = {loaded.source, files.folder / "channels.csv"};
  inputs.model = diagnosis::prepare_model(loaded, files.channels, config.sensor_tolerance_m);
  inputs.structure = inputs.model->structure();
  const diagnosis::BasisModes basis = diagnosis::modes_of_basis(inputs.structure, inputs.features, config.modes);
  refuse_endless_basis(basis, loaded, inputs.features, context);
  diagnosis::PlaceOptions place_options;
  place_options.moves = files.moves;
  if (config.zones > 0)
    place_options.max_zones = config.zones;
  else
    place_options.zone_spacing_m = basis.eighth_of_wave_m;
  if (config.nodes > 0)
    place_options.max_nodes = config.nodes;
  else
    place_options.node_spacing_m = basis.eighth_of_wave_m;
  inputs.basis_modes = basis.modes;
  reduce(place_options, basis, inputs);
  if (basis.eighth_of_wave_m > 0.0)
    context.say(fmt::format("looks at {} zones and {} nodes; an eighth of the shortest wave of the measured modes is {:.2g} m",
                            inputs.places.sets["elements"].size(), inputs.places.sets["nodes"].size(), basis.eighth_of_wave_m));
  diagnosis::refuse_slack_stays(inputs.features, inputs.places, files.folder);
  inputs.extended = inputs.model;
  if (config.stays == "auto") swing_stays(config, files.stay_rows, inputs);
  diagnosis::FeatureMap as_it_stands(*inputs.reduced, inputs.features, config.scatter);
  as_it_stands.bind_modes(bound_modes(config, inputs));
  inputs.account = diagnosis::account_of(files.claims, inputs.features, files.channels, inputs.places, &as_it_stands);
  judge_units(context, loaded, inputs.reduced->frequency_Hz,
              frequencies_of(inputs.features, inputs.reduced.get(), bound_modes(config, inputs)),
              dynamics::FactorWithinBounds::is_refused);
  const double least_mac = config.least_mac > 0.0 || !inputs.bar_stays ? config.least_mac : kAlike;
  if (const auto unpaired = diagnosis::leave_out_unpaired(least_mac, config.scatter, *inputs.reduced, inputs.features))
    inputs.account.push_back(*unpaired);
  if (const auto imaginary = diagnosis::leave_out_imaginary(*inputs.reduced, inputs.features))
    inputs.account.push_back(*imaginary);
  diagnosis::hold_out(config.hold_out, inputs.features);
  return inputs;
}

/// @throws InputError  for a file that is not sound, and for a name in one of them that the others do not have
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

void say_form(const diagnosis::FormReport& form, runner::StepContext& context) {
  context.say(
      fmt::format("  form error of the model: {:.2f} % in frequency ({:.2f} to {:.2f}), {:.2f} % in shape ({:.2f} to {:.2f})",
                  100.0 * form.frequency.level, 100.0 * form.frequency.low, 100.0 * form.frequency.high,
                  100.0 * form.shape.level, 100.0 * form.shape.low, 100.0 * form.shape.high));
  if (!form.gain.blocks.empty())
    context.say(fmt::format("  left out mode by mode ({} modes): gain {:.1f} nats ({:.1f} to {:.1f})", form.gain.blocks.size(),
                            form.gain.log_gain, form.gain.low, form.gain.high));
  for (const std::string& warning : form.warnings) context.say("  warning: " + warning);
}

void say_sentences(diagnosis::Verdict verdict, const diagnosis::Sentences& sentences, runner::StepContext& context) {
  context.say("verdict: " + name_of(verdict));
  context.say("  what is wrong: " + sentences.what);
  context.say("  why: " + sentences.why);
  context.say("  how sure: " + sentences.how_sure);
  context.say("  how much better: " + sentences.how_much_better);
  context.say("  next: " + sentences.next);
}

void say_modes_explained(const diagnosis::Diagnosis& result, runner::StepContext& context) {
  if (const auto gain = diagnosis::explained_gain(result))
    context.say(fmt::format("  modes explained: {} -> {} of {} measured", gain->before, gain->after, gain->measured));
}

/// Writes the model of the last state, without causes that act only in other states.
void write_extension(const DiagnosisInputs& inputs, const diagnosis::Diagnosis& result, runner::StepContext& context) {
  const std::string state = diagnosis::last_state(inputs.features);
  const bool several = diagnosis::states_of(inputs.features).size() > 1;
  const std::vector<std::string> others =
      write_extended_model(*inputs.extended, inputs.places, result, state, several, context.out / "extended_model");
  if (!others.empty())
    context.warn(fmt::format("the extended model is that of state {}: what acts in other states alone is not in it ({})", state,
                             fmt::join(others, ", ")));
}

/// Says how far the reduced basis and the full model agree, and warns where the basis is too small for the measured modes.
void say_check(const diagnosis::FullCheck& check, double allowed_pct, long modes, runner::StepContext& context) {
  if (!check.message.empty()) {
    context.warn("the extended model was not checked against the full one, which cannot be solved: " + check.message);
    return;
  }
  context.say(fmt::format("reduced basis against the full model: the {} paired frequencies agree to {:.4f} %",
                          check.full_Hz.size(), check.largest_pct));
  if (check.largest_pct > allowed_pct)
    context.warn(
        fmt::format("the reduced basis is too small for the measured modes: their frequencies are up to {:.2g} % off the "
                    "full model's (more than {:.2g} %); set modes above {}",
                    check.largest_pct, allowed_pct, modes));
}

Status run_diagnosis(const DiagnosisConfig& config, const DiagnosisFiles& files, runner::StepContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  DiagnosisInputs inputs = prepare_diagnosis(config, files, context);
  diagnosis::FeatureMap map(*inputs.reduced, inputs.features, config.scatter);
  std::vector<std::string> unmeasured;
  map.bind_modes(bound_modes(config, inputs, &unmeasured));
  if (!unmeasured.empty()) context.warn(fmt::format("pairs: no row in use has the mode of {}", fmt::join(unmeasured, ", ")));
  diagnosis::Instantiated entries = diagnosis::instantiate(files.catalogue, *inputs.reduced, inputs.features);
  if (inputs.bar_stays) inputs.bar_stays->take_out_entries(entries);
  const diagnosis::Inference inference(map, entries.candidates);
  context.say(fmt::format("{} rows ({} held out), {} unknowns, {} entries of {} families, basis of {}",
                          inputs.features.rows.size(), inference.held_out().size(), map.nuisances().size(),
                          entries.candidates.size(), files.catalogue.size(), inputs.reduced->size()));
  if (context.has_flag("plan")) {
    write_plan(inference, entries.invisible, context.out / "plan.csv");
    context.say("plan.csv says what these rows would see");
    return {};
  }
  diagnosis::DiagnoseOptions options;
  options.most_causes = config.most_causes;
  options.progress = [&](const char* what, int done, int of) { context.progress(what, done, of); };
  diagnosis::Diagnosis result = diagnosis::diagnose(inference, options, context.seed + 1);
  if (result.before.all.g.size() == 0) return {false, result.message};
  if (inputs.bar_stays) inputs.bar_stays->put_first(result);
  const diagnosis::PlaceWords places(inputs.model->loaded.fe_model(), inputs.model->loaded.system.dofs, inputs.model->channels,
                                     inputs.places);
  const diagnosis::IdsInWords ids = diagnosis::ids_in_words(places, inference, result.ranking);
  diagnosis::put_into_words(result, places, ids);
  const diagnosis::Inference judged(result.with_form ? *result.with_form : map, entries.candidates);
  write_tables(judged, entries, result, context.out);
  write_extension(inputs, result, context);
  const diagnosis::FullCheck check =
      check_paired_modes(inputs.model->structure(), inputs.places, map, result, diagnosis::last_state(inputs.features));
  say_check(check, diagnosis::allowed_basis_error_pct(result), inputs.basis_modes, context);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::vector<records::Correction> corrections = diagnosis::corrections_of(result, inputs.features.channels);
  const std::vector<std::string> next = diagnosis::measure_next(result, places, ids, entries.invisible);
  const Told told{places,
                  ids,
                  diagnosis::sentences_of(judged, result, places, ids, next),
                  next,
                  diagnosis::model_parameters(inference, result),
                  corrections};
  std::vector<diagnosis::Finding> account = inputs.account;
  for (diagnosis::Finding& finding : account) finding.text = ids.in_text(finding.text);
  write_diagnosis(result, account, told, check, seconds, context.out / "diagnosis.json");
  diagnosis::write_corrections(files.corrected, corrections, context.out / "corrections.toml");
  for (const diagnosis::Finding& finding : account) context.say(finding.text);
  say_modes_explained(result, context);
  if (result.form) say_form(*result.form, context);
  say_sentences(result.verdict, told.sentences, context);
  for (const std::string& line : diagnosis::correction_advice(corrections)) context.say(line);
  return {};
}

}  // namespace

runner::Computation read_diagnosis(const DiagnosisConfig& config, runner::StepContext& context) {
  return [&config, &context, files = read_diagnosis_files(config, context)] { return run_diagnosis(config, files, context); };
}

io::FieldTable DiagnosisConfig::fields() {
  io::FieldTable t;
  t.text("catalogue", catalogue, "folder of hypotheses (default: workflows/common/hypotheses)")
      .text("damper_places", damper_places, "CSV of alternative damper places: alternative, damper, x_m, y_m, z_m")
      .text("further_causes", further_causes,
            "folder of causes added to the catalogue: the study's own, or a family at other places")
      .texts("pairs", pairs, "pairs of measured and computed modes without a measured shape, \"7X-8N\"")
      .texts("left_out", rows.left_out, "rows that are not used: types such as shape_imag, or modes such as \"mode:8\"")
      .number(
          "least_mac", least_mac, "", {0.0, 1.0},
          "least MAC of a measured mode with any computed mode; modes below it are left out and reported; 0: none is left out")
      .boolean("names_alike", rows.names_alike,
               "gives a mode the same name in all conditions, by MAC (each identification numbers its modes from 1)")
      .number("highest_frequency", rows.highest_Hz, "Hz", io::non_negative(), "modes above this are left out; 0: no limit")
      .texts("hold_out", hold_out,
             "rows held out of the fit: \"condition\", \"condition/mode\", \"condition/mode/type\", \"condition/every_second\" "
             "or \"none\"; empty: the rows that the file marks; without marks, modes are left out in turn")
      .integer("most_causes", most_causes, {0, 3},
               "largest number of causes in one explanation; 0: causes are reported but not added to the model")
      .integer("modes", modes, {4, 200},
               "least number of modes in the reduced basis; raised if the highest measured frequency requires more")
      .integer("zones", zones, {0, 10000},
               "number of zones of elements; 0: eight per wavelength of the highest measured mode, at least 24")
      .integer("nodes", nodes, {0, 10000},
               "number of nodes at which added masses, oscillators and ties are searched for; 0: eight per wavelength of the "
               "highest measured mode, at least 24")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "largest distance between a sensor and its nearest node")
      .choice("stays", stays, {"auto", "as_modelled"},
              "auto: a stay modelled as one bar becomes a cable of several elements if measured modes that match no computed "
              "mode are then explained; its force comes from rows of stay_frequency_Hz (even if left_out names them), else "
              "from the model. as_modelled: the model is not changed")
      .number("scatter.element_stiffness", scatter.element_stiffness, "", io::non_negative(),
              "relative standard deviation of the stiffness of an element")
      .number("scatter.element_mass", scatter.element_mass, "", io::non_negative(),
              "relative standard deviation of the mass of an element")
      .number("scatter.node_mass", scatter.node_mass, "", io::non_negative(),
              "relative standard deviation of the mass at a node of a matrix model")
      .number("scatter.stay_stiffness", scatter.stay_stiffness, "", io::non_negative(),
              "relative standard deviation of the stiffness of a stay")
      .number("scatter.stay_pull", scatter.stay_pull, "", io::non_negative(), "relative standard deviation of a stay force")
      .number("scatter.support_stiffness", scatter.support_stiffness, "", io::non_negative(),
              "relative standard deviation of the stiffness of a bearing or foundation")
      .number("scatter.gain", scatter.gain, "", io::non_negative(), "relative standard deviation of the gain of a channel")
      .number("scatter.frequency_floor", scatter.frequency_floor, "", io::non_negative(),
              "least relative standard deviation of a measured frequency")
      .number("scatter.damping_floor", scatter.damping_floor, "", io::non_negative(),
              "least relative standard deviation of a measured damping ratio")
      .number("scatter.shape_floor", scatter.shape_floor, "", io::non_negative(),
              "least standard deviation of a measured shape component, relative to the largest")
      .number("scatter.load_model", scatter.load_model, "", io::non_negative(),
              "relative standard deviation of RMS values, for the uncertainty of a simple load model")
      .boolean("scatter.damping_by_dampers", scatter.damping_by_dampers,
               "separate structural damping for the conditions with dampers, because stuck dampers dissipate by friction")
      .number("scatter.model_form", scatter.model_form, "", io::non_negative(),
              "relative standard deviation of the model's error in frequency, the same in all conditions of a mode; for a "
              "model that is known to be inaccurate");
  for (const Retired& key : retired) t.retired(key.name, key.problem, key.mend);
  return t;
}

}  // namespace twindeck::steps
