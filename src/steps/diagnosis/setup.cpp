#include "steps/diagnosis/setup.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "diagnosis/same_modes.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "io/manifest.hpp"
#include "io/toml_value.hpp"
#include "modal/mode_name.hpp"
#include "steps/diagnosis/catalogue.hpp"
#include "steps/diagnosis/measurement_corrections.hpp"
#include "steps/diagnosis/outputs.hpp"
#include "steps/diagnosis/threshold_file.hpp"
#include "steps/shared/measured_tables.hpp"
#include "steps/shared/study.hpp"
#include "steps/shared/unit_slips.hpp"

namespace twindeck::steps {

namespace {

std::filesystem::path catalogue_folder(const DiagnosisConfig& config, const StepContext& context) {
  if (const auto given = context.flag("catalogue")) return *given;
  if (!config.catalogue.empty()) return config.catalogue;
  std::vector<std::filesystem::path> tried = {"workflows/common/hypotheses"};
  if (!context.study.empty()) tried.push_back(context.study.parent_path() / "common/hypotheses");
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!ignored) {
    tried.push_back(self.parent_path() / "../../workflows/common/hypotheses");
    tried.push_back(self.parent_path() / "../share/twindeck/hypotheses");
  }
  for (const auto& folder : tried)
    if (std::filesystem::is_directory(folder)) return folder;
  return tried.front();
}

void keep(diagnosis::FeatureSet& features, const std::vector<Eigen::Index>& kept) {
  std::vector<diagnosis::Row> rows;
  for (const Eigen::Index r : kept) rows.push_back(features.rows[static_cast<std::size_t>(r)]);
  features.rows = rows;
  if (features.covariance.size() > 0) features.covariance = features.covariance(kept, kept).eval();
}

/// Rows that the configuration leaves out, and one name for a mode in all conditions.
void choose_rows(const DiagnosisConfig& config, diagnosis::FeatureSet& features) {
  if (config.names_alike) diagnosis::name_modes_alike(features);
  const auto left_out = [&](const std::string& what) {
    return std::find(config.left_out.begin(), config.left_out.end(), what) != config.left_out.end();
  };
  for (const std::string& type : config.left_out) {
    const auto& known = diagnosis::row_type_names();
    if (type.starts_with("mode:")) {
      if (std::none_of(features.rows.begin(), features.rows.end(), [&](const auto& row) { return row.mode == type.substr(5); }))
        throw InputError({"", 0, "left_out"}, fmt::format("no row has the mode of '{}'", type), "");
      continue;
    }
    if (std::find(known.begin(), known.end(), type) == known.end())
      throw InputError({"", 0, "left_out"}, fmt::format("'{}' is no type of row{}", type, did_you_mean(type, known)), "");
  }
  std::set<std::pair<int, std::string>> high;
  for (const diagnosis::Row& row : features.rows)
    if (row.type == diagnosis::RowType::frequency && config.highest_Hz > 0.0 && row.value > config.highest_Hz)
      high.insert({row.condition, row.mode});
  std::vector<Eigen::Index> kept;
  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    const diagnosis::Row& row = features.rows[r];
    if (left_out(name_of(row.type))) continue;
    if (row.type != diagnosis::RowType::stay_frequency && left_out("mode:" + row.mode)) continue;
    if (row.type != diagnosis::RowType::stay_frequency && high.contains({row.condition, row.mode})) continue;
    kept.push_back(static_cast<Eigen::Index>(r));
  }
  if (kept.empty()) throw InputError({"", 0, "left_out"}, "no row is left", "leave fewer out");
  keep(features, kept);
}

/// Leaves out the modes of which the model has none with a MAC of `least_mac`: what it has no mode for, such as a stay that
/// swings by itself where stays are bars, cannot be a residual of it.
/// @param swinging  how many stays the model has as cables
std::optional<Finding> leave_out_unpaired(const DiagnosisConfig& config, const diagnosis::ReducedModel& model, std::size_t swinging,
                                          diagnosis::FeatureSet& features) {
  if (!(config.least_mac > 0.0)) return std::nullopt;
  const diagnosis::FeatureMap map(model, features, config.scatter);
  const auto base = map.base(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(map.nuisances().size())));
  const diagnosis::Prediction prediction = map.predict(base, {}, false);
  std::set<std::pair<int, std::string>> unpaired;
  Finding found{"unpaired", "", {}, {}, ""};
  const auto stays = model.sets.find("stays");
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const diagnosis::MeasuredMode& mode = map.measured_modes()[m];
    const bool other = prediction.paired[m] < 0 || prediction.mac[m] < config.least_mac;
    if (mode.real_rows.size() < 2 || !other) continue;
    unpaired.insert({mode.condition, mode.label});
    std::string name = fmt::format("{} of {} ({:.3f} Hz", mode.label,
                                   features.conditions[static_cast<std::size_t>(mode.condition)].name, mode.frequency_Hz);
    if (stays != model.sets.end())
      for (const diagnosis::ReducedPlace& stay : stays->second)
        for (int harmonic = 1; harmonic <= 2 && stay.attributes.contains("f_cable"); ++harmonic)
          if (std::abs(harmonic * stay.attributes.at("f_cable") / mode.frequency_Hz - 1.0) < 0.03)
            name += fmt::format(", {}x{}", harmonic, stay.id);
    found.names.push_back(name + ")");
  }
  std::vector<Eigen::Index> kept;
  for (std::size_t r = 0; r < features.rows.size(); ++r)
    if (!unpaired.contains({features.rows[r].condition, features.rows[r].mode}) ||
        features.rows[r].type == diagnosis::RowType::stay_frequency)
      kept.push_back(static_cast<Eigen::Index>(r));
  if (unpaired.empty()) return std::nullopt;
  if (kept.empty())
    throw InputError({"", 0, "least_mac"}, fmt::format("no measured mode has a MAC of {} with the model's", config.least_mac),
                     "");
  keep(features, kept);
  found.text = fmt::format(
      "{} of {} measured modes are like no mode of the model (MAC below {}) and are left out: {}", unpaired.size(),
      map.measured_modes().size(), config.least_mac, fmt::join(found.names, "; "));
  if (stays != model.sets.end() && !stays->second.empty())
    found.text += swinging > 0 ? fmt::format(". Stays whose own frequency this is are named; {} of the model's stays vibrate", swinging)
                               : ". Stays whose own frequency this is are named; the model's stays do not vibrate";
  return found;
}

/// Whether the model's form competes: asked for, or two states are compared, whose common error it takes out.
bool with_form(const DiagnosisConfig& config, const diagnosis::FeatureSet& features) {
  return config.form == "on" || (config.form == "auto" && diagnosis::states_of(features).size() > 1);
}

void hold_out(const DiagnosisConfig& config, diagnosis::FeatureSet& features) {
  if (config.hold_out.empty()) {
    if (!with_form(config, features)) diagnosis::hold_out_by_rule(features);  // with "on" whole modes are left out one after another
    return;
  }
  for (diagnosis::Row& row : features.rows) row.held_out = false;
  for (const std::string& rule : config.hold_out) {
    if (rule == "none") continue;
    const auto slash = rule.find('/'), second = slash == std::string::npos ? slash : rule.find('/', slash + 1);
    bool any = false;
    std::set<std::string> second_modes;  // "condition/every_second": those at even places in ascending frequency
    if (rule.ends_with("/every_second")) {
      std::map<double, std::string> ascending;
      for (const diagnosis::Row& row : features.rows)
        if (row.type == diagnosis::RowType::frequency &&
            features.conditions[static_cast<std::size_t>(row.condition)].name == rule.substr(0, slash))
          ascending[row.value] = row.mode;
      bool even = false;
      for (const auto& [frequency, mode] : ascending) {
        if (even) second_modes.insert(mode);
        even = !even;
      }
    }
    for (diagnosis::Row& row : features.rows) {
      const bool hit = features.conditions[static_cast<std::size_t>(row.condition)].name == rule.substr(0, slash) &&
                       (slash == std::string::npos || row.mode == rule.substr(slash + 1, second - slash - 1) ||
                        second_modes.contains(row.mode)) &&
                       (second == std::string::npos || name_of(row.type) == rule.substr(second + 1));
      row.held_out = row.held_out || hit;
      any = any || hit;
    }
    if (!any)
      throw InputError({"", 0, "hold_out"}, fmt::format("'{}' matches no row", rule),
                       "write \"condition\", \"condition/mode\", \"condition/mode/type\" or \"condition/every_second\"");
  }
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

/// Positions of the computed modes that the configuration gives to measured ones, by the mode's name in rows.csv.
/// @param unmeasured  gets those that no row names
std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                       std::vector<std::string>* unmeasured = nullptr) {
  std::map<std::string, int> bound;
  for (const modal::NamedPair& pair :
       modal::read_pairs(config.pairs, inputs.reduced->mode_coordinates.cols(), {"", 0, "pairs"}, "raise modes")) {
    const std::size_t before = bound.size();
    for (const diagnosis::Row& row : inputs.features.rows)
      if (modal::experimental_label(row.mode) == pair.experimental) bound[row.mode] = static_cast<int>(pair.numerical);
    if (bound.size() == before && unmeasured != nullptr) unmeasured->push_back(pair.experimental);
  }
  return bound;
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
  const diagnosis::Structure structure = inputs.model->structure();
  inputs.places = diagnosis::find_places(structure, place_options);
  diagnosis::ReductionOptions reduction;
  reduction.modes = size.modes;
  // Fits end far from where the basis is made (full_model): parameters on bounds, workmanship off by several deviations.
  reduction.parameter_vectors = 60;
  reduction.least_correction = 2.5e-4;
  reduction.element_change = 0.1;
  std::set<std::string> measured;
  for (const diagnosis::Row& row : inputs.features.rows)
    if (row.type == diagnosis::RowType::frequency) measured.insert(row.mode);
  reduction.corrected_modes = std::max({12, static_cast<int>(measured.size()) + 2, size.corrected});
  inputs.reduced = std::make_unique<diagnosis::ReducedModel>(structure, inputs.places, reduction);
}

/// Where measured modes are those of stays that swing, the model gets these stays as cables. It stays as it was where no more modes
/// are explained then, dampers and all conditions included.
void swing_stays(const DiagnosisConfig& config, const diagnosis::PlaceOptions& place_options,
                 const std::vector<diagnosis::Row>& stay_rows, DiagnosisInputs& inputs) {
  constexpr double alike = 0.6;  // MAC where least_mac says nothing: below it two shapes share less than they do not
  const diagnosis::BarStaysOptions options{config.least_mac > 0.0 ? config.least_mac : alike, 2 * static_cast<int>(config.modes)};
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

io::FieldTable DiagnosisConfig::fields() {
  io::FieldTable t;
  t.text("catalogue", catalogue, "folder of hypotheses (default: workflows/common/hypotheses)")
      .text("damper_places", damper_places, "CSV of places where dampers might stand instead: alternative, damper, x_m, y_m, z_m")
      .text("further_causes", further_causes,
            "folder of causes beside the catalogue: a study's own, or a family at other places")
      .texts("pairs", pairs, "measured and computed modes that belong together where no shape tells, \"7X-8N\"")
      .texts("left_out", left_out, "types of rows that are not used, such as shape_imag, or modes, \"mode:8\"")
      .number("least_mac", least_mac, "", {0.0, 1.0},
              "modes of which the model has none this alike are left out, and reported; 0: none is")
      .boolean("names_alike", names_alike,
               "give a mode one name in all conditions, by likeness of shapes (identifications number each condition from 1)")
      .number("highest_frequency", highest_Hz, "Hz", io::non_negative(), "modes above it are left out; 0: none is")
      .texts("hold_out", hold_out,
             "rows kept from the fit: \"condition\", \"condition/mode\", \"condition/mode/type\" or "
             "\"condition/every_second\", \"none\"; empty: marks, else the rule")
      .number("alpha", alpha, "", {1e-6, 0.5}, "false alarms that the threshold allows")
      .number("residual_alpha", residual_alpha, "", {1e-9, 0.5}, "level at which the residual test says that something is left")
      .number("either_within", either_within, "", io::positive(), "nats within which two causes are not told apart")
      .number("least_log_odds", least_log_odds, "", io::non_negative(), "log odds below which nothing is named")
      .integer("nulls", nulls, {0, 100000}, "null data sets run for the threshold where none is cached; 0: the analytic tail")
      .integer("most_refined", most_refined, {1, 50}, "entries of a search that are fitted together with all other unknowns")
      .number("refine_within", search.refine_within, "", io::positive(), "nats of the best, as weighed before, within which they are")
      .integer("most_causes", most_causes, {0, 8}, "causes put into the model one after another")
      .integer("modes", modes, {4, 200}, "modes in the reduced basis")
      .integer("zones", zones, {2, 200}, "zones that the elements are gathered in")
      .integer("nodes", nodes, {2, 200}, "nodes at which masses, oscillators and ties are looked for")
      .number("sensor_tolerance", sensor_tolerance_m, "m", io::positive(),
              "farthest that a sensor may lie from the node that stands for it")
      .choice("form", form, {"auto", "on", "off"},
              "on: the model's form may be wrong, its error is estimated and competes with every cause; off: the model is exact but for scatter; "
              "auto: on where two states are compared")
      .choice("stays", stays, {"auto", "as_modelled"},
              "auto: stays that the model has as bars become cables in several elements where that explains measured modes which the model "
              "resembles nowhere; their forces come from stay_frequency_Hz rows (left_out keeps these from the fit, not from here), else "
              "from the model; as_modelled: they stay bars")
      .text("threshold_cache", threshold_cache, "folder of thresholds by hash (default: <results>/thresholds, or beside --out)")
      .number("scatter.element_stiffness", scatter.element_stiffness, "", io::non_negative(),
              "relative deviation of an element's stiffness")
      .number("scatter.element_mass", scatter.element_mass, "", io::non_negative(), "of an element's mass")
      .number("scatter.node_mass", scatter.node_mass, "", io::non_negative(), "of the mass at a node of a matrix model")
      .number("scatter.stay_stiffness", scatter.stay_stiffness, "", io::non_negative(), "of a stay's stiffness")
      .number("scatter.stay_pull", scatter.stay_pull, "", io::non_negative(), "of a stay's pull")
      .number("scatter.gain", scatter.gain, "", io::non_negative(), "of a channel's gain")
      .number("scatter.frequency_floor", scatter.frequency_floor, "", io::non_negative(),
              "least relative deviation of a frequency")
      .number("scatter.damping_floor", scatter.damping_floor, "", io::non_negative(),
              "least relative deviation of a damping ratio")
      .number("scatter.shape_floor", scatter.shape_floor, "", io::non_negative(),
              "least deviation of a shape, of its largest value")
      .number("scatter.load_model", scatter.load_model, "", io::non_negative(),
              "of RMS values, for what a simple load model leaves open")
      .boolean("scatter.damping_by_dampers", scatter.damping_by_dampers,
               "structural damping is another unknown where dampers are on (stuck ones rub)")
      .number("scatter.model_form", scatter.model_form, "", io::non_negative(),
              "of a frequency, alike in all conditions of a mode: what a model that is known to be off leaves open");
  return t;
}

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
  inputs.model = prepare_model(loaded, channels, config.sensor_tolerance_m);
  diagnosis::PlaceOptions place_options{static_cast<int>(config.zones), static_cast<int>(config.nodes), {}, {}, {}};
  if (!config.damper_places.empty())
    place_options.moves = read_damper_places(context.input(config.damper_places), loaded.fe_model());
  reduce(place_options, {static_cast<int>(config.modes), 0}, inputs);
  refuse_unknown_stays(inputs.features, inputs.places, folder);
  if (config.stays == "auto") swing_stays(config, place_options, stay_rows, inputs);
  if (inputs.features.load_test_rows > 0)
    context.warn(fmt::format("{} rows of load tests are not used: no cause here is told by them", inputs.features.load_test_rows));
  inputs.account = account_of(read_claims(folder), inputs.features, channels, inputs.places);
  warn_of_unit_slips(context, loaded, inputs.reduced->frequency_Hz, frequencies_of(inputs.features));
  const std::size_t swinging = inputs.bar_stays ? inputs.bar_stays->stays() : 0;
  if (const auto unpaired = leave_out_unpaired(config, *inputs.reduced, swinging, inputs.features)) inputs.account.push_back(*unpaired);
  hold_out(config, inputs.features);
  return inputs;
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
  const auto nulls = diagnosis::run_nulls(
      *inputs.reduced, inputs.features, config.scatter, inputs.catalogue, search, static_cast<int>(config.nulls), context.seed + 17,
      [&](int done) { context.progress("null data sets", done, static_cast<double>(config.nulls)); },
      bound_modes(config, inputs));
  std::vector<double> sorted = nulls.log_odds;
  std::sort(sorted.begin(), sorted.end());
  const auto at = static_cast<std::size_t>(std::ceil((1.0 - config.alpha) * static_cast<double>(sorted.size()))) - 1;
  const double threshold = sorted[std::min(at, sorted.size() - 1)];
  write_threshold(threshold, config.nulls, 1.0 - config.alpha, file, key);
  context.input(file);
  return {read_threshold(file, key).value_or(threshold), from};  // as it is kept, to six decimals
}

namespace {

void say_form(const diagnosis::FormReport& form, StepContext& context) {
  context.say(fmt::format("  form error of the model: {:.2f} % in frequency ({:.2f} to {:.2f}), {:.2f} % in shape ({:.2f} to {:.2f})",
                          100.0 * form.frequency.level, 100.0 * form.frequency.low, 100.0 * form.frequency.high, 100.0 * form.shape.level,
                          100.0 * form.shape.low, 100.0 * form.shape.high));
  if (!form.gain.blocks.empty())
    context.say(fmt::format("  left out mode by mode ({} modes): gain {:.1f} nats ({:.1f} to {:.1f})", form.gain.blocks.size(),
                            form.gain.log_gain, form.gain.low, form.gain.high));
  for (const std::string& warning : form.warnings) context.say("  warning: " + warning);
}

/// The last lines of the step.
void say_sentences(const std::string& verdict, const Sentences& sentences, StepContext& context) {
  context.say("verdict: " + verdict);
  context.say("  what is wrong: " + sentences.what);
  context.say("  why: " + sentences.why);
  context.say("  how sure: " + sentences.how_sure);
  context.say("  how much better: " + sentences.how_much_better);
  context.say("  next: " + sentences.next);
}

diagnosis::DiagnoseOptions options_of(const DiagnosisConfig& config, const Threshold& threshold) {
  diagnosis::DiagnoseOptions options;
  options.alpha = config.alpha;
  options.threshold = threshold.value;
  options.least_log_odds = config.least_log_odds;
  options.either_within = config.either_within;
  options.residual_alpha = config.residual_alpha;
  options.search = config.search;
  options.search.most_refined = static_cast<int>(config.most_refined);
  options.most_causes = static_cast<int>(config.most_causes);
  return options;
}

void say_modes_explained(const diagnosis::Diagnosis& result, StepContext& context) {
  if (const auto gain = explained_gain(result))
    context.say(fmt::format("  modes explained: {} -> {} of {} measured", gain->before, gain->after, gain->measured));
}

}  // namespace

Status run_diagnosis(const DiagnosisConfig& config, StepContext& context) {
  Eigen::setNbThreads(1);  // small matrices, and sums must not depend on threads
  const auto begin = std::chrono::steady_clock::now();
  const DiagnosisInputs inputs = read_diagnosis_inputs(config, context);
  diagnosis::FeatureMap map(*inputs.reduced, inputs.features, config.scatter);
  std::vector<std::string> unmeasured;
  map.bind_modes(bound_modes(config, inputs, &unmeasured));
  if (!unmeasured.empty())
    context.warn(fmt::format("pairs: no row in use has the mode of {}", fmt::join(unmeasured, ", ")));
  diagnosis::Instantiated entries = diagnosis::instantiate(inputs.catalogue, *inputs.reduced, inputs.features);
  if (inputs.bar_stays) inputs.bar_stays->take_out_entries(entries);
  const diagnosis::Inference inference(map, entries.candidates);
  context.say(fmt::format("{} rows ({} held out), {} unknowns, {} entries of {} families, basis of {}",
                          inputs.features.rows.size(), inference.held_out().size(), map.nuisances().size(),
                          entries.candidates.size(), inputs.catalogue.size(), inputs.reduced->size()));
  if (context.has_flag("plan")) {
    write_plan(inference, entries.invisible, context.out / "plan.csv");
    context.say("plan.csv says what these rows would see");
    return {};
  }
  const bool form = with_form(config, inputs.features);  // its rules have thresholds of their own
  const Threshold threshold = form ? Threshold{0.0, "rules with a form error"} : find_threshold(config, inputs, inference, context);
  const diagnosis::DiagnoseOptions options = options_of(config, threshold);
  diagnosis::Diagnosis result = form ? diagnosis::diagnose_with_form(inference, options, context.seed + 1)
                                          : diagnosis::diagnose(inference, options, context.seed + 1);
  if (result.before.all.g.size() == 0) return {false, result.message};
  if (inputs.bar_stays) inputs.bar_stays->put_first(result);
  const PlaceWords places(inputs.model->loaded.fe_model(), inputs.model->loaded.system.dofs, inputs.model->channels, inputs.places);
  const IdsInWords ids = ids_in_words(places, inference);
  put_into_words(result, places, ids);
  result.scatter = diagnosis::scatter_scales(inference, result.after);
  write_residuals(inference, result, context.out / "residuals.csv");
  write_hypotheses(result, entries.invisible, context.out / "hypotheses.csv");
  write_gain(inference, result, context.out / "gain.csv");
  write_pairs(inference, result, context.out / "pairs.csv");
  write_misfit(inference, result, context.out / "misfit.csv");
  write_unknowns(inference, result, context.out / "parameters.csv");
  write_extended_model(*inputs.model, inputs.places, result, context.out / "extended_model");
  std::set<std::string> labels;
  for (const auto& mode : map.measured_modes()) labels.insert(mode.label);
  const diagnosis::FullCheck check = diagnosis::check_against_full(inputs.model->structure(), inputs.places, map, result.after,
                                                                   std::max(1, static_cast<int>(labels.size())));
  if (check.message.empty())
    context.say(fmt::format("reduced basis against the full model: the lowest {} frequencies agree to {:.4f} %",
                            check.full_Hz.size(), check.largest_pct));
  else
    context.warn("the extended model was not checked against the full one, which cannot be solved: " + check.message);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::vector<Correction> corrections = corrections_of(result, inputs.features.channels);
  const std::vector<std::string> next = measure_next(result, places, ids, entries.invisible);
  const Told told{places, ids, sentences_of(inference, result, places, ids, next), next, diagnosis::model_parameters(inference, result), corrections};
  std::vector<Finding> account = inputs.account;
  for (Finding& finding : account) finding.text = ids.in_text(finding.text);
  write_diagnosis(result, account, told, check, config.residual_alpha, seconds, threshold.from, context.out / "diagnosis.json");
  write_corrections(inputs.corrected, corrections, context.out / "corrections.toml");
  for (const Finding& finding : account) context.say(finding.text);
  say_modes_explained(result, context);
  if (result.form) say_form(*result.form, context);
  say_sentences(result.verdict, told.sentences, context);
  for (const std::string& line : correction_advice(corrections)) context.say(line);
  return {};
}

}  // namespace twindeck::steps
