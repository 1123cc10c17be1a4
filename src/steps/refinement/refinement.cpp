#include "steps/refinement/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "dynamics/unit_slips.hpp"
#include "io/csv.hpp"
#include "matching/comparison.hpp"
#include "matching/solved_model.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/modes_io.hpp"
#include "ponte/change_study.hpp"
#include "runner/study.hpp"
#include "steps/measured/comparison_tables.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {

io::FieldTable RefinementConfig::fields() {
  io::FieldTable table;
  table
      .integer("n_modes", n_modes, {1, 1000},
               "number of computed modes that are written and compared; raised if measured modes with shapes lie above them")
      .integer("extra_modes", extra_modes, {0, 1000},
               "modes solved for beyond n_modes, so that a mode is still found when its frequency rises")
      .text("variant", variant, "variant of the generator that gives the refined model")
      .texts("pairs", pairs,
             "published pairs, measured-numerical (\"7X-8N\"), used if no shapes were measured; empty: pairs by order of "
             "frequency")
      .text("condition", condition,
            "condition of the measured features (--condition or --state override it); empty: the only condition, or the only "
            "one without dampers");
  add_pairing_keys(table, *this);
  return table;
}

namespace {

struct RefinementInputs {
  dynamics::ReadModel initial;
  std::optional<runner::Study> generated;  ///< the study whose generator writes the model; a model of the user's own has none
  std::optional<dynamics::ReadModel> refined;  ///< the generator's variant
  std::optional<matching::Measured> measured;
};

/// Measured modes that take part: those in a published list of pairs if one is used, otherwise all.
std::vector<bool> compared_modes(const matching::Measured& measured, const matching::Pairing& refined) {
  std::vector<bool> keep(measured.labels.size(), refined.method != "published");
  for (const matching::ModePair& pair : refined.pairs) keep[static_cast<std::size_t>(pair.experimental)] = true;
  return keep;
}

Place place_of_pairs(const runner::StepContext& context) {
  return {(context.study / "s4_refinement.toml").string(), 0, "pairs"};
}

matching::PairingAccount compare_with_measurement(runner::StepContext& context, const RefinementConfig& config,
                                                  const std::optional<matching::Measured>& measured,
                                                  const matching::SolvedModel& initial, const matching::SolvedModel& refined) {
  if (!measured) context.say("no measured modes: give --features DIR or --modes DIR to compare with");
  const matching::Measured some = measured.value_or(matching::Measured{});
  dynamics::warn_of_unit_slips(context, refined.loaded, refined.modes.frequency_Hz,
                               frequencies_of(measured, config, refined.loaded, refined.modes));
  matching::Pairing after, before;
  matching::PairingAccount account;
  if (measured) {
    after = matching::pair_as_configured(context, config, some, refined.loaded, refined.modes, place_of_pairs(context));
    account = matching::account_of(some, after, refined.modes.frequency_Hz);
    matching::warn_of_pairing(context, account, std::nullopt, "");
    before = some.modes.has_shapes()
                 ? matching::pair_at_sensors(some, initial.loaded, initial.modes, config, config.sensor_tolerance_m)
                 : matching::pair_by_order(some, initial.modes.frequency_Hz.size(), compared_modes(some, after));
  }
  std::vector<matching::ComparisonRow> rows = compare("initial", some, initial.modes.frequency_Hz, before);
  for (const matching::ComparisonRow& row : compare("refined", some, refined.modes.frequency_Hz, after)) rows.push_back(row);
  write_comparison(rows, context.out);
  write_mac(some, after, context.out);
  write_pairs(some, after, context.out);
  if (!rows.empty())
    context.say(fmt::format("mean |error| of {} pairs: initial {:.2f} %, refined {:.2f} % (pairs by {}){}", after.pairs.size(),
                            matching::mean_abs_error_pct(rows, "initial"), matching::mean_abs_error_pct(rows, "refined"),
                            after.method, matching::pairing_words(account)));
  return account;
}

/// changes.csv: effects are relative to the preliminary model; cumulative: this change and all before it. mac_cumulative is the
/// one with the state before.
void write_changes(const ponte::ChangeStudy& study, const std::filesystem::path& folder) {
  io::CsvWriter csv({"change", "paper_item", "meaning", "mode", "frequency_before_Hz", "frequency_alone_Hz", "effect_alone_pct",
                     "effect_cumulative_pct", "mac_alone", "mac_cumulative"});
  using matching::known;
  for (const ponte::ChangeEffect& effect : study.effects) {
    for (Eigen::Index i = 0; i < study.before_Hz.size(); ++i) {
      const double before = study.before_Hz[i], alone = effect.alone.frequency_Hz[i];
      csv.row({effect.change.name, effect.change.paper_item, effect.change.meaning, static_cast<long>(i + 1), before,
               known(alone), known(100.0 * (alone / before - 1.0)),
               known(100.0 * (effect.cumulative.frequency_Hz[i] / before - 1.0)), known(effect.alone.mac[i]),
               known(effect.cumulative.mac[i])});
    }
  }
  csv.save(folder / "changes.csv");
}

Status run_refinement(runner::StepContext& context, const RefinementConfig& config, const RefinementInputs& read) {
  // 1. Initial and refined model, with their modes. A model of the user's own is both.
  dynamics::LoadedModel initial_model = dynamics::solvable(read.initial);
  dynamics::LoadedModel refined_source = read.refined ? dynamics::solvable(*read.refined) : initial_model;
  auto n = static_cast<int>(
      std::min<Eigen::Index>(config.n_modes, std::min(initial_model.system.size(), refined_source.system.size())));
  if (read.measured && read.measured->modes.has_shapes() && !read.generated)  // a generator's tables have fixed modes
    n = dynamics::modes_for_band(refined_source.system, refined_source.theta, n, read.measured->modes.frequency_Hz,
                                 config.maximum_frequency_error);
  const matching::SolvedModel initial = matching::solve_modes(std::move(initial_model), n);
  const matching::SolvedModel refined = matching::solve_modes(std::move(refined_source), n);
  model_io::write_modes(model_io::published_modes(refined.loaded.fe_model(), refined.loaded.system, refined.modes),
                        context.out);
  model_io::save_model(refined.loaded, refined.loaded.theta, context.out / "model");

  // 2. Comparison with the measurement.
  const matching::PairingAccount account = compare_with_measurement(context, config, read.measured, initial, refined);

  // 3. Effect of each as-built change.
  ponte::ChangeStudy changes;
  if (read.generated)
    changes =
        ponte::study_changes(read.generated->model_file, read.generated->model_mesh, n, static_cast<int>(config.extra_modes),
                             [&](int done, int of) { context.progress("as-built changes", done, of); });
  write_changes(changes, context.out);
  for (const Status& status : {initial.modes.status, refined.modes.status, changes.status})
    if (!status.converged) return status;
  return outcome({}, account);
}

}  // namespace

runner::Computation read_refinement(runner::StepContext& context, const RefinementConfig& config) {
  RefinementInputs read;
  read.initial = load_model(context, context.results / "s1_model" / "model");
  if (!context.model && !context.study.empty()) {
    if (const runner::Study study = runner::read_study(context.study); !study.model_generator.empty()) {
      read.generated = study;
      read.refined = load_study_model(context, config.variant);
    }
  }
  read.measured = find_measured(context, config.condition);
  if (read.measured)
    matching::check_pairing(*read.measured, read.refined ? *read.refined : read.initial, config.pairs, place_of_pairs(context),
                            config.n_modes, config.sensor_tolerance_m);
  return [&context, &config, read = std::move(read)] { return run_refinement(context, config, read); };
}

}  // namespace twindeck::steps
